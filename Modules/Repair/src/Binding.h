#pragma once

#include "Value.h"

#include <stdexcept>

namespace sinew::repair {

/// What is wrong with a script, without the place: the sandbox puts script and line before it.
struct ScriptError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Ends a script because somebody outside of it wants so.
struct ScriptStopped {
  std::exception_ptr reason;
};

class Call;

/// A function that scripts can call.
struct Binding {
  enum class As { Function, Method, Both, Operator };
  const char* name;   ///< operators: the metamethod
  const char* usage;  ///< one line, for messages
  As as;
  Values (*body)(Call& call);
};

}  // namespace sinew::repair
