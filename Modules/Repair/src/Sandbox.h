#pragma once

#include "Binding.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::repair {

/// What a script reaches of the program, through the sandbox.
class ScriptHost {
 public:
  virtual ~ScriptHost() = default;

  /// Calls a binding; the line is that of the script. @throws ScriptError, ScriptStopped, or anything else:
  /// an exception that is no std::exception ends the script.
  virtual Values call(const Binding& binding, Values arguments, int line) = 0;
  /// A global that the command line has set.
  virtual std::optional<Value> setting(const std::string& name) = 0;
  /// Called every few milliseconds. @throws ScriptStopped to end the script
  virtual void heartbeat(int line) = 0;
};

struct SandboxOptions {
  std::string scriptName;
  std::int64_t instructions = 0;  ///< of Lua's machine, see RepairLimits
  std::int64_t bytes = 0;         ///< that the script's own values may take
};

/// A machine of Lua 5.4 that holds nothing but numbers, texts, tables, functions, loops, a part of the
/// libraries `math`, `string` and `table`, and the bindings. It cannot read or write files, load code, or see
/// addresses, clocks and the order of hash tables: a script does the same wherever and whenever it runs.
///
/// C++ and Lua meet in one function only (LuaGate.cpp): no C++ exception passes through a frame of Lua, and
/// no longjmp of Lua skips a destructor.
class Sandbox {
 public:
  Sandbox(std::span<const Binding> bindings, ScriptHost& host, SandboxOptions options);
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  /// @throws std::invalid_argument `NAME:LINE: message`, one line; the reason of a ScriptStopped; exceptions
  /// that are no std::exception.
  void run(const std::string& script);

  /// Lets go of values that the script cannot reach any more. Safe inside of a call.
  void collect();

  struct Machine;  ///< for the files of the sandbox

 private:
  std::unique_ptr<Machine> machine_;
};

}  // namespace sinew::repair
