#pragma once

#include "ArgumentReader.h"
#include "Sandbox.h"
#include "ShapeEngine.h"
#include "sinew/Repair/RepairSegmentation.h"

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace sinew::repair {

/// What a script wants to become of one tissue of the result.
struct Saving {
  std::string name;
  int tissue = -1;  ///< index in the input; -1: a new one
  std::optional<std::array<double, 3>> color;
  ShapePtr shape;
  int line = 0;  ///< of the script
};

/// What a script asks of the result.
struct Wishes {
  std::vector<Saving> savings;        ///< oldest first, one per name
  std::set<int> removed;              ///< indices in the input
  std::vector<std::string> priority;  ///< names, first wins
  int priorityLine = 0;               ///< of the script
  bool layers = false;                ///< keep overlaps
};

/// One run of a script: what its bindings work on, and what they leave.
class Session : public ScriptHost {
 public:
  /// `script` only tells how far a line is from the end.
  Session(const Segmentation& input, const std::string& script, const RepairOptions& options,
          std::unique_ptr<ShapeEngine> engine);

  Values call(const Binding& binding, Values arguments, int line) override;
  std::optional<Value> setting(const std::string& name) override;
  void heartbeat(int line) override;

  const Segmentation& input() const { return input_; }
  const RepairOptions& options() const { return options_; }
  ShapeEngine& engine() { return *engine_; }
  Units units() const;

  void tell(const std::string& message);  ///< once for each message
  void print(const std::string& text);
  void useCoordinates(bool ras) { ras_ = ras; }

  Wishes wishes;
  std::vector<RepairOperation> operations;
  std::vector<std::string> messages;

  /// Tells about settings that the script has not read.
  void tellUnusedSettings();

 private:
  void progress(int line, const std::string& operation);
  void record(const Binding& binding, const Values& arguments, const Values& results, int line,
              double seconds);
  std::optional<ShapeSummary> summaryOf(const Value& value);

  const Segmentation& input_;
  const RepairOptions& options_;
  std::unique_ptr<ShapeEngine> engine_;
  std::set<std::string> settingsRead_;
  double lines_ = 1;  ///< of the script
  double done_ = 0;
  bool ras_ = false;
};

/// One call of a binding.
class Call {
 public:
  Call(Session& session, const Binding& binding, Values arguments, int line);

  Session& session;
  const Binding& binding;
  const int line;

  const ArgumentReader& reader() const { return reader_; }
  ShapeEngine& engine() const { return session.engine(); }
  int count() const { return static_cast<int>(arguments_.size()); }
  /// Argument n from 0 on; nil beyond the last.
  const Value& operator[](int n) const;
  /// @throws ScriptError when there are more arguments
  void atMost(int count) const;
  bool has(int n) const { return !std::holds_alternative<std::monostate>((*this)[n]); }

  const ShapePtr& shape(int n) const;
  /// The table of named arguments at n. @throws ScriptError when there are unknown ones
  Fields fields(int n, std::initializer_list<const char*> known) const;

 private:
  Values arguments_;
  ArgumentReader reader_;
};

/// All functions of the language.
std::span<const Binding> allBindings();

/// Name of a binding as a person writes it: `+` for `__add`.
std::string spokenName(const Binding& binding);

}  // namespace sinew::repair
