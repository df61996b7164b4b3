#pragma once

#include "Option.h"

#include <string>
#include <utility>
#include <vector>

namespace sinew {

/// A row of a module's window: an option, and what Slicer has to know about it.
struct ModuleParameter {
  enum class Channel { None, Input, Output };

  Option option;
  std::string element = {};  ///< Slicer's kind: `image`, `file`; empty: by the type of the option's target
  std::vector<std::pair<std::string, std::string>> attributes = {};  ///< of that element
  std::string label = {};                                            ///< empty: from the option's name
  Channel channel = Channel::None;

  /// `--edge-length` as Slicer wants names: `edgeLength`.
  std::string name() const;
  /// Only told after the run, in the file of results.
  bool result() const { return element.empty() && channel == Channel::Output; }
  /// Given behind the flags, in the order of the rows, without a name.
  bool positional() const { return !result() && !option.flags.starts_with("-"); }
};

/// Rows that stand together; advanced ones are folded at first.
struct ModuleGroup {
  std::string label, description;
  bool advanced = false;
  std::vector<ModuleParameter> parameters;
};

/// A Slicer module: what `--xml` tells, and what its command line takes.
struct ModuleDescription {
  std::string program;  ///< name of the executable, which is the module's
  std::string title, category, description;
  std::vector<ModuleGroup> groups;
};

/// Options of the program as rows of a window. Slicer itself, unseen, gives `--lut` the colour table of a
/// label map in inputParameter.
std::vector<ModuleParameter> asParameters(const std::vector<Option>& options);

// Rows that all modules have.
inline constexpr const char* kInputSegmentation = "inputSegmentation";  ///< name of inputParameter
ModuleParameter inputParameter(std::string& file);
ModuleParameter threadsParameter(int& threads);
ModuleParameter resultParameter(const std::string& name, std::int64_t& value, const std::string& help);

/// The description that 3D Slicer asks for with `--xml`.
/// Source: ModuleDescriptionParser.cxx of the SlicerExecutionModel.
std::string toXml(const ModuleDescription& description);

}  // namespace sinew
