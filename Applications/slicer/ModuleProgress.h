#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace sinew {

/// Tells Slicer on standard output how a run advances: lines `<filter-progress>x</filter-progress>`, x from 0
/// to 1 and never back, each flushed, one at least every second as long as the object lives. Other lines of
/// the run go through `say`.
class ModuleProgress {
 public:
  /// @param name  of the module
  explicit ModuleProgress(const std::string& name);
  ~ModuleProgress();
  ModuleProgress(const ModuleProgress&) = delete;
  ModuleProgress& operator=(const ModuleProgress&) = delete;

  /// @param done  of all work, in [0, 1]
  /// @param step  what is being done, for the window
  void show(double done, const std::string& step);
  void say(const std::string& line);
  /// All is done.
  void finish();

 private:
  void print();  ///< with the lock held
  void beat();

  std::mutex lock_;
  std::condition_variable ended_;
  bool end_ = false;
  std::string name_;
  double done_ = 0;
  double shown_ = 0;
  std::thread heart_;
};

}  // namespace sinew
