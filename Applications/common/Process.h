#pragma once

#include "Option.h"

#include <tbb/global_control.h>

namespace sinew {

/// The number of threads of TBB's loops, as long as it lives.
class ThreadLimit {
 public:
  /// @param threads  0: all processors
  explicit ThreadLimit(int threads);

 private:
  tbb::global_control control_;
};

/// Keeps freed memory for the next stage: to give it back and to fault it in again takes up to a third of the
/// time in the kernel.
void keepFreedMemory();

/// A text as the one line that a failure prints.
std::string asOneLine(std::string text);

}  // namespace sinew
