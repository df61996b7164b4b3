#pragma once

#include <span>
#include <string_view>

namespace sinew::fuzz {

/// What is fuzzed: a function of bytes that may come from anywhere.
struct Target {
  std::string_view name;  ///< also of its corpus, its dictionary and its program fuzz-<name>

  /// @return whether the bytes were taken; else they were refused as they should be, in one line.
  /// @throws std::logic_error when a law is broken; whatever else escapes is a bug, too
  bool (*run)(std::string_view bytes);
};

std::span<const Target> targets();

// One per kind of input; `extension` as in `.obj`.
bool runSegmentation(std::string_view bytes);
bool runDicom(std::string_view bytes);
bool runLabelTable(std::string_view bytes);
bool runTriangleMesh(std::string_view bytes, std::string_view extension);
bool runTetMesh(std::string_view bytes, std::string_view extension);
bool runRepairScript(std::string_view bytes);

}  // namespace sinew::fuzz
