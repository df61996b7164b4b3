# Every foreign library, found once. The modules name the targets they need; the installed package repeats the search.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(DCMTK 3.6.7 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(ZLIB REQUIRED)
find_package(ISAL REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Qhull REQUIRED)
find_package(Lua 5.4 EXACT REQUIRED)
if(NOT TARGET Lua::Lua)  # CMake's module defines none
  add_library(Lua::Lua INTERFACE IMPORTED)
  set_target_properties(Lua::Lua PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${LUA_INCLUDE_DIR}" INTERFACE_INCLUDE_DIRECTORIES "${LUA_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${LUA_LIBRARIES}")
endif()
set(CMAKE_MESSAGE_LOG_LEVEL WARNING)  # notices of Imath and gdcm about parts that nobody needs
find_package(OpenVDB 10 REQUIRED)
find_package(ITK 5.2 REQUIRED COMPONENTS ITKCommon ITKIOImageBase ITKIONRRD ITKIOMeta ITKIONIFTI)
unset(CMAKE_MESSAGE_LOG_LEVEL)
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel CommonMisc IOLegacy IOXML pugixml utf8)

if(CMAKE_FIND_PACKAGE_NAME STREQUAL "Sinew")
  return()  # a consumer: the rest is for building Sinew itself
endif()

find_package(CLI11 REQUIRED)

if(SINEW_BUILD_TESTING)  # VTK's own target searches for HDF5
  find_library(VTK_IOEXODUS_LIBRARY vtkIOExodus-${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION} REQUIRED)
  mark_as_advanced(VTK_IOEXODUS_LIBRARY)
  add_library(VTKIOExodus::VTKIOExodus UNKNOWN IMPORTED)
  set_target_properties(VTKIOExodus::VTKIOExodus PROPERTIES
    IMPORTED_LOCATION "${VTK_IOEXODUS_LIBRARY}" INTERFACE_LINK_LIBRARIES "VTK::CommonExecutionModel")
endif()

# ITK 5.2 has no usable namespaced targets, and carries an Eigen of its own.
add_library(sinew_itk INTERFACE)
target_include_directories(sinew_itk SYSTEM INTERFACE "$<BUILD_INTERFACE:${ITK_INCLUDE_DIRS}>")
target_link_libraries(sinew_itk INTERFACE ${ITK_LIBRARIES} Eigen3::Eigen)
target_compile_definitions(sinew_itk INTERFACE ITK_USE_SYSTEM_EIGEN)
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  target_compile_options(sinew_itk INTERFACE "$<BUILD_INTERFACE:SHELL:-include ${PROJECT_SOURCE_DIR}/cmake/ItkUnderClang.h>")
endif()
install(TARGETS sinew_itk EXPORT SinewTargets)
