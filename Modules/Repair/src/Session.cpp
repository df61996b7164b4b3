#include "Session.h"

#include "sinew/LevelSet/ShapeMeasures.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>

namespace sinew::repair {
namespace {

/// Settings are texts on the command line: numbers become numbers, true and false become booleans.
Value settingValue(const std::string& text) {
  if (text == "true" || text == "false") return text == "true";
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (!text.empty() && error == std::errc() && end == text.data() + text.size()) return number;
  return text;
}

/// Whether a shape is one of the arguments.
bool holds(const Values& arguments, const Shape* shape) {
  return std::ranges::any_of(arguments, [&](const Value& value) {
    const ShapePtr* argument = std::get_if<ShapePtr>(&value);
    return argument != nullptr && argument->get() == shape;
  });
}

void checkSettings(const std::map<std::string, std::string>& settings) {
  for (const auto& [name, value] : settings)
    for (const Binding& binding : allBindings())
      if (name == binding.name)
        throw std::invalid_argument("--set " + name + ": the name belongs to the script language");
}

/// The shape that a binding made, or the first one of its list.
const Shape* madeShape(const Values& results) {
  if (results.empty()) return nullptr;
  if (const ShapePtr* shape = std::get_if<ShapePtr>(&results.front())) return shape->get();
  const TablePtr* list = std::get_if<TablePtr>(&results.front());
  return list == nullptr ? nullptr : madeShape((*list)->items);
}

}  // namespace

Session::Session(const Segmentation& input, const std::string& script, const RepairOptions& options,
                 std::unique_ptr<ShapeEngine> engine)
    : input_(input), options_(options), engine_(std::move(engine)) {
  checkSettings(options.settings);
  lines_ = 1 + static_cast<double>(std::count(script.begin(), script.end(), '\n'));
}

Units Session::units() const { return {input_.geometry.meanSpacing(), input_.geometry.voxelVolume(), ras_}; }

Values Session::call(const Binding& binding, Values arguments, int line) {
  progress(line, spokenName(binding));
  const auto start = std::chrono::steady_clock::now();
  Call call(*this, binding, arguments, line);
  const Values results = binding.body(call);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  record(binding, arguments, results, line, time.count());
  return results;
}

std::optional<Value> Session::setting(const std::string& name) {
  const auto found = options_.settings.find(name);
  if (found == options_.settings.end()) return std::nullopt;
  settingsRead_.insert(name);
  return settingValue(found->second);
}

void Session::heartbeat(int line) { progress(line, "script"); }

void Session::progress(int line, const std::string& operation) {
  done_ = std::max(done_, std::min(1., line / lines_));
  if (!options_.progress) return;
  try {
    options_.progress(line, operation, done_);
  } catch (...) {
    throw ScriptStopped{std::current_exception()};
  }
}

std::optional<ShapeSummary> Session::summaryOf(const Value& value) {
  const ShapePtr* shape = std::get_if<ShapePtr>(&value);
  if (shape == nullptr) return std::nullopt;
  return engine_->summary(*shape);
}

void Session::record(const Binding& binding, const Values& arguments, const Values& results, int line,
                     double seconds) {
  const Shape* made = madeShape(results);
  if (made == nullptr || !made->levelSet || holds(arguments, made)) return;
  RepairOperation operation{line, spokenName(binding), made->name, seconds, {}, {}};
  if (!arguments.empty()) operation.before = summaryOf(arguments.front());
  if (results.size() == 1) operation.after = summaryOf(results.front());
  operations.push_back(std::move(operation));
}

void Session::tell(const std::string& message) {
  if (std::find(messages.begin(), messages.end(), message) == messages.end()) messages.push_back(message);
}

void Session::print(const std::string& text) {
  if (options_.print) options_.print(text);
}

void Session::tellUnusedSettings() {
  for (const auto& [name, value] : options_.settings)
    if (!settingsRead_.contains(name)) tell("--set " + name + ": the script does not use it");
}

Call::Call(Session& session, const Binding& binding, Values arguments, int line)
    : session(session),
      binding(binding),
      line(line),
      arguments_(std::move(arguments)),
      reader_(spokenName(binding), binding.usage, session.units()) {}

const Value& Call::operator[](int n) const {
  static const Value nothing;
  return n < count() ? arguments_[n] : nothing;
}

void Call::atMost(int most) const {
  if (count() > most) reader_.refuse("too many arguments; usage: " + reader_.usage());
}

const ShapePtr& Call::shape(int n) const {
  return reader_.shape(n == 0 ? "the first argument" : "argument " + std::to_string(n + 1), (*this)[n]);
}

Fields Call::fields(int n, std::initializer_list<const char*> known) const {
  atMost(n + 1);
  return Fields(reader_, (*this)[n], known);
}

std::string spokenName(const Binding& binding) {
  static const std::map<std::string, std::string> operators{{"__add", "+"}, {"__sub", "-"}, {"__mul", "*"}};
  const auto found = operators.find(binding.name);
  return found == operators.end() ? binding.name : found->second;
}

}  // namespace sinew::repair
