# cmake -D SOURCE_DIR=... -D SCRATCH_DIR=... -P LayeringTest.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/Layering.cmake)

# A row: file | include | bad or fine. The test that cannot fail is no test.
set(seeds
  "Modules/Segmentation/src/A.cpp|<itkImage.h>|fine"
  "Modules/Segmentation/include/sinew/Segmentation/A.h|<itkImage.h>|bad"
  "Modules/Segmentation/src/DicomFile.cpp|<dcmtk/dcmdata/dctk.h>|fine"
  "Modules/Segmentation/src/DicomGeometry.cpp|<dcmtk/dcmdata/dctk.h>|bad"
  "Modules/Segmentation/include/sinew/Segmentation/B.h|<dcmtk/dcmdata/dctk.h>|bad"
  "Modules/Segmentation/src/B.cpp|\"sinew/LevelSet/LevelSet.h\"|bad"
  "Modules/LevelSet/src/A.cpp|\"sinew/Segmentation/Segmentation.h\"|fine"
  "Modules/LevelSet/src/B.cpp|<openvdb/openvdb.h>|fine"
  "Modules/LevelSet/src/C.cpp|<vtkPoints.h>|bad"
  "Modules/LevelSet/src/D.cpp|\"sinew/Mesher/TetMesh.h\"|bad"
  "Modules/LevelSet/src/ConvexHull.cpp|<libqhull_r/libqhull_r.h>|fine"
  "Modules/LevelSet/src/E.cpp|<libqhull_r/libqhull_r.h>|bad"
  "Modules/LevelSet/include/sinew/LevelSet/LevelSetGrid.h|<openvdb/openvdb.h>|fine"
  "Modules/LevelSet/include/sinew/LevelSet/LevelSet.h|<openvdb/openvdb.h>|bad"
  "Modules/LevelSet/include/sinew/LevelSet/B.h|\"sinew/LevelSet/LevelSetGrid.h\"|bad"
  "Modules/Mesher/src/A.cpp|<tbb/parallel_for.h>|fine"
  "Modules/Mesher/src/B.cpp|<Eigen/Core>|fine"
  "Modules/Mesher/src/C.cpp|<vector>|fine"
  "Modules/Mesher/src/D.cpp|\"sinew/LevelSet/LevelSet.h\"|bad"
  "Modules/Mesher/src/E.cpp|<nlohmann/json.hpp>|bad"
  "Modules/Mesher/src/F.cpp|<CGAL/Mesh_3.h>|bad"
  "Modules/Mesher/src/G.cpp|\"../../LevelSet/src/Private.h\"|bad"
  "Modules/Mesher/src/H.cpp|\"sinew/TestSupport/LatticeMesh.h\"|bad"
  "Modules/Mesher/test/A.cpp|\"sinew/TestSupport/LatticeMesh.h\"|fine"
  "Modules/MeshIO/src/A.cpp|\"sinew/Mesher/TetMesh.h\"|fine"
  "Modules/MeshIO/src/B.cpp|<vtkPoints.h>|fine"
  "Modules/MeshIO/src/C.cpp|\"sinew/Segmentation/Segmentation.h\"|bad"
  "Modules/MeshIO/include/sinew/MeshIO/A.h|<vtkPoints.h>|bad"
  "Modules/Repair/src/A.cpp|<lua.hpp>|fine"
  "Modules/Repair/src/B.cpp|\"sinew/LevelSet/Csg.h\"|fine"
  "Modules/Repair/src/C.cpp|\"sinew/Pipeline/Length.h\"|bad"
  "Modules/Repair/test/A.cpp|<lauxlib.h>|bad"
  "Modules/Repair/include/sinew/Repair/A.h|<lua.hpp>|bad"
  "Modules/Simulation/src/A.cpp|\"sinew/Elasticity/Muscle.h\"|fine"
  "Modules/Simulation/src/B.cpp|\"sinew/MeshIO/WriteMesh.h\"|bad"
  "Modules/Simulation/src/BsplineSolidFile.cpp|<nlohmann/json.hpp>|fine"
  "Modules/Simulation/src/C.cpp|<nlohmann/json.hpp>|bad"
  "Modules/Elasticity/src/A.cpp|\"sinew/Simulation/MeshTrial.h\"|bad"
  "Modules/LevelSet/src/F.cpp|<lua.h>|bad"
  "Modules/Pipeline/src/F.cpp|\"sinew/Repair/RepairSegmentation.h\"|bad"
  "Applications/sinew/d.cpp|\"sinew/Repair/RepairSegmentation.h\"|fine"
  "Modules/Pipeline/src/A.cpp|\"sinew/MeshIO/WriteMesh.h\"|fine"
  "Modules/Pipeline/src/B.cpp|<nlohmann/json.hpp>|fine"
  "Modules/Pipeline/src/LevelSetSurface.cpp|<openvdb/openvdb.h>|bad"
  "Modules/Pipeline/src/C.cpp|\"sinew/LevelSet/LevelSetGrid.h\"|bad"
  "Modules/Pipeline/src/D.cpp|<openvdb/openvdb.h>|bad"
  "Modules/Pipeline/include/sinew/Pipeline/A.h|<nlohmann/json.hpp>|bad"
  "Modules/Pipeline/src/E.cpp|<CLI/CLI.hpp>|bad"
  "Applications/sinew/a.cpp|<CLI/CLI.hpp>|fine"
  "Applications/sinew/b.cpp|\"sinew/Pipeline/MeshTissues.h\"|fine"
  "Applications/sinew/c.cpp|<itkImage.h>|bad")

file(REMOVE_RECURSE ${SCRATCH_DIR})
set(expected)
foreach(seed IN LISTS seeds)
  string(REPLACE "|" ";" seed "${seed}")
  list(GET seed 0 file)
  list(GET seed 1 include)
  list(GET seed 2 verdict)
  file(WRITE ${SCRATCH_DIR}/${file} "#pragma once\n#  include ${include}  // seeded\n")
  if(verdict STREQUAL bad)
    list(APPEND expected ${file})
  endif()
endforeach()
violations(${SCRATCH_DIR} found)
list(TRANSFORM found REPLACE ": .*" "")
list(SORT expected)
list(SORT found)
if(NOT "${found}" STREQUAL "${expected}")
  message(FATAL_ERROR "The check itself is broken.\n  expected ${expected}\n  found    ${found}")
endif()

violations(${SOURCE_DIR} found)
list(JOIN found "\n  " report)
if(found)
  message(FATAL_ERROR "Includes that cross a border (CONVENTIONS.md, section 1):\n  ${report}")
endif()
