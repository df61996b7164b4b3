#pragma once

#include <string>

namespace sinew {

/// While it lives, what VTK would print from this thread (errors and warnings, also of objects deep inside a
/// reader) is kept instead. Other threads, and code without a trap, keep VTK's own window.
class VtkErrorTrap {
 public:
  VtkErrorTrap();
  ~VtkErrorTrap();
  VtkErrorTrap(const VtkErrorTrap&) = delete;
  VtkErrorTrap& operator=(const VtkErrorTrap&) = delete;

  /// Was an error reported? Warnings do not count.
  bool failed() const { return !firstError_.empty(); }
  /// The first error, one line, without VTK's source location and object address; empty when there was none.
  const std::string& firstError() const { return firstError_; }

  void keepError(const char* text);

 private:
  VtkErrorTrap* outer_;
  std::string firstError_;
};

}  // namespace sinew
