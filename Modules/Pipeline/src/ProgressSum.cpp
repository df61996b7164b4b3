#include "ProgressSum.h"

#include <algorithm>
#include <numeric>

namespace sinew {

ProgressSum::ProgressSum(std::vector<double> work, const TissueProgress& progress)
    : work_(std::move(work)),
      fraction_(work_.size()),
      total_(std::accumulate(work_.begin(), work_.end(), 0.)),
      progress_(progress) {}

void ProgressSum::report(std::size_t tissue, const std::string& name, const std::string& stage,
                         double fraction) {
  const std::lock_guard lock(mutex_);
  if (cause_) throw Stopped{};
  if (!progress_) return;
  fraction_[tissue] = std::clamp(fraction, fraction_[tissue], 1.);
  const double done = std::inner_product(work_.begin(), work_.end(), fraction_.begin(), 0.);
  try {
    progress_(name, stage, total_ > 0 ? std::min(1., done / total_) : 1);
  } catch (...) {
    cause_ = std::current_exception();
    throw Stopped{};
  }
}

bool ProgressSum::stopped() const {
  const std::lock_guard lock(mutex_);
  return cause_ != nullptr;
}

void ProgressSum::rethrow() const {
  const std::lock_guard lock(mutex_);
  if (cause_) std::rethrow_exception(cause_);
}

}  // namespace sinew
