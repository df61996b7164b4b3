#pragma once

#include "ClassicLocale.h"
#include "FileFailure.h"
#include "VtkErrorTrap.h"

#include <Eigen/Core>
#include <vtkAlgorithm.h>
#include <vtkErrorCode.h>
#include <vtkPointSet.h>

#include <string>
#include <vector>

namespace sinew {

/// Runs a VTK reader. @param kind  what the file should be, for the message
inline void update(vtkAlgorithm* reader, const std::filesystem::path& file, const char* kind) {
  const ClassicLocale locale;
  const VtkErrorTrap trap;
  reader->Update();
  if (trap.failed()) fail(file, std::string("damaged or not ") + kind + " (" + trap.firstError() + ")");
  if (reader->GetErrorCode() != vtkErrorCode::NoError)
    fail(file, vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode()));
}

inline std::vector<Eigen::Vector3d> nodesOf(vtkPointSet* points, const std::filesystem::path& file) {
  std::vector<Eigen::Vector3d> nodes(static_cast<std::size_t>(points->GetNumberOfPoints()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    points->GetPoint(static_cast<vtkIdType>(i), nodes[i].data());
    if (!nodes[i].allFinite()) fail(file, "node " + std::to_string(i) + " has no finite coordinates");
  }
  return nodes;
}

}  // namespace sinew
