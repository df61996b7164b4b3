#include "VtkErrorTrap.h"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <mutex>
#include <string_view>

namespace sinew {
namespace {

thread_local VtkErrorTrap* currentTrap = nullptr;

/// Stands in front of the process's window and hands on what no trap of the calling thread wants.
class TrapWindow : public vtkOutputWindow {
 public:
  static TrapWindow* New();
  vtkTypeMacro(TrapWindow, vtkOutputWindow)

      void DisplayText(const char* text) override {
    pass(text, &vtkOutputWindow::DisplayText);
  }
  void DisplayWarningText(const char* text) override { pass(text, &vtkOutputWindow::DisplayWarningText); }
  void DisplayGenericWarningText(const char* text) override {
    pass(text, &vtkOutputWindow::DisplayGenericWarningText);
  }
  void DisplayDebugText(const char* text) override { pass(text, &vtkOutputWindow::DisplayDebugText); }
  void DisplayErrorText(const char* text) override {
    if (currentTrap != nullptr) currentTrap->keepError(text);
    pass(text, &vtkOutputWindow::DisplayErrorText);
  }

 private:
  void pass(const char* text, void (vtkOutputWindow::*display)(const char*)) {
    if (currentTrap == nullptr) (previous_->*display)(text);
  }

  vtkSmartPointer<vtkOutputWindow> previous_ = vtkOutputWindow::GetInstance();
};
vtkStandardNewMacro(TrapWindow);

/// VTK's logger prints every message to stderr before any window sees it: it is quiet while some trap lives.
class LoggerSilence {
 public:
  void begin() {
    const std::lock_guard lock(mutex_);
    if (traps_++ > 0) return;
    verbosity_ = vtkLogger::GetCurrentVerbosityCutoff();
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  void end() {
    const std::lock_guard lock(mutex_);
    if (--traps_ == 0) vtkLogger::SetStderrVerbosity(verbosity_);
  }

 private:
  std::mutex mutex_;
  int traps_ = 0;
  vtkLogger::Verbosity verbosity_ = vtkLogger::VERBOSITY_ERROR;
};

LoggerSilence loggerSilence;

void installTrapWindow() {
  const auto window = vtkSmartPointer<TrapWindow>::New();
  vtkOutputWindow::SetInstance(window);
}

/// `ERROR: In file, line n\nvtkClass (0x...): what happened\n\n` -> `what happened`
std::string whatHappened(std::string_view text) {
  if (const auto location = text.find('\n'); text.starts_with("ERROR: In ") && location != text.npos)
    text.remove_prefix(location + 1);
  if (const auto object = text.find("): "); object != text.npos) text.remove_prefix(object + 3);
  text = text.substr(0, text.find('\n'));
  return text.empty() ? "unknown VTK error" : std::string(text);
}

}  // namespace

VtkErrorTrap::VtkErrorTrap() : outer_(currentTrap) {
  static std::once_flag installed;
  std::call_once(installed, installTrapWindow);
  loggerSilence.begin();
  currentTrap = this;
}

VtkErrorTrap::~VtkErrorTrap() {
  currentTrap = outer_;
  loggerSilence.end();
}

void VtkErrorTrap::keepError(const char* text) {
  if (firstError_.empty()) firstError_ = whatHappened(text);
}

}  // namespace sinew
