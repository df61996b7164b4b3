#include "ModuleProgress.h"

#include "TextTable.h"

#include <algorithm>
#include <chrono>
#include <iostream>

namespace sinew {
namespace {

constexpr std::chrono::seconds kBeat{1};
constexpr double kSmallestStep = 0.002;       // a window has no finer bar
constexpr std::size_t kLongestComment = 200;  // bytes; Slicer holds 1023

/// Text that Slicer does not take for one of its marks.
std::string plain(std::string text) {
  text = printable(std::move(text));
  std::replace(text.begin(), text.end(), '<', '(');
  std::replace(text.begin(), text.end(), '>', ')');
  return text;
}

}  // namespace

ModuleProgress::ModuleProgress(const std::string& name) : name_(name) {
  std::cout << "<filter-start>\n<filter-name>" << name_ << "</filter-name>\n</filter-start>\n";
  print();
  heart_ = std::thread([this] { beat(); });
}

ModuleProgress::~ModuleProgress() {
  {
    const std::lock_guard guard(lock_);
    end_ = true;
  }
  ended_.notify_all();
  heart_.join();
}

void ModuleProgress::show(double done, const std::string& step) {
  const std::lock_guard guard(lock_);
  done_ = std::clamp(done, done_, 1.);
  if (done_ - shown_ < kSmallestStep) return;
  std::cout << "<filter-comment>" << plain(step).substr(0, kLongestComment) << "</filter-comment>\n";
  print();
}

void ModuleProgress::say(const std::string& line) {
  const std::lock_guard guard(lock_);
  std::cout << plain(line) << std::endl;
}

void ModuleProgress::finish() {
  const std::lock_guard guard(lock_);
  done_ = 1;
  print();
  std::cout << "<filter-end>\n<filter-name>" << name_ << "</filter-name>\n</filter-end>" << std::endl;
}

void ModuleProgress::print() {
  shown_ = done_;
  std::cout << "<filter-progress>" << fixed(done_, 4) << "</filter-progress>" << std::endl;
}

void ModuleProgress::beat() {
  std::unique_lock guard(lock_);
  while (!ended_.wait_for(guard, kBeat, [this] { return end_; })) print();
}

}  // namespace sinew
