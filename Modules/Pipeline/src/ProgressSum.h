#pragma once

#include "sinew/Pipeline/MeshTissues.h"

#include <exception>
#include <mutex>

namespace sinew {

/// Adds up the progress of tissues that run at the same time, and passes on the wish to stop.
class ProgressSum {
 public:
  /// Thrown by report() once the callback has thrown. Not derived from std::exception, so that nobody on the
  /// way takes it for the failure of one tissue.
  struct Stopped {};

  /// @param work  of each tissue, any unit
  ProgressSum(std::vector<double> work, const TissueProgress& progress);

  /// @param fraction  of the tissue's work done, in [0, 1]
  void report(std::size_t tissue, const std::string& name, const std::string& stage, double fraction);
  bool stopped() const;
  /// Throws what the callback threw, if it has.
  void rethrow() const;

 private:
  std::vector<double> work_, fraction_;
  double total_ = 0;
  const TissueProgress& progress_;
  mutable std::mutex mutex_;
  std::exception_ptr cause_;
};

}  // namespace sinew
