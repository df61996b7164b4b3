#pragma once

#include "Sandbox.h"

#include <exception>
#include <lua.hpp>

namespace sinew::repair {

/// What the C functions of one Lua state share; lua_getextraspace points to it.
struct Sandbox::Machine {
  Machine(std::span<const Binding> bindings, ScriptHost& host, SandboxOptions options)
      : bindings(bindings), host(host), options(std::move(options)) {}

  static Machine& of(lua_State* state) { return **static_cast<Machine**>(lua_getextraspace(state)); }

  std::span<const Binding> bindings;
  ScriptHost& host;
  SandboxOptions options;
  lua_State* state = nullptr;

  std::int64_t bytes = 0;  ///< that Lua holds
  std::int64_t allocated =
      0;  ///< in all: what copies of long texts cost, the count of instructions does not show
  std::int64_t longestText = 0;  ///< bytes; what one instruction may touch
  std::int64_t work = 0;         ///< instructions, and what C functions add for their loops
  int line = 0;                  ///< where the last error was raised

  // What a C++ function leaves for the C function above it, whose frame may be left by a longjmp.
  Values results;
  std::string failure;
  std::exception_ptr stopped;
};

/// Line of the innermost function of the script that runs; 0 for none.
int currentLine(lua_State* state);

/// Adds to the work done. Raises a Lua error, by longjmp, when that is too much.
void charge(lua_State* state, std::int64_t work);

/// Raises "NAME:LINE: message". The message is copied first.
int raise(lua_State* state, const char* message);

// LuaGate.cpp: the way from Lua into C++ and back.
/// Pushes the C function of a binding.
void pushBinding(lua_State* state, const Binding& binding);
/// Makes the metatable of shapes from the methods and operators among the bindings.
void makeShapeMetatable(lua_State* state);
/// C function (table, name): a setting, or an error that names the nearest.
int readUnknownGlobal(lua_State* state);
/// C functions in place of Lua's own, which would show addresses.
int typeOfValue(lua_State* state);
int textOfValue(lua_State* state);

// LuaSort.cpp
/// Sorts entries 1 to `count` of the list at a place of the stack; precedes(state, a, b) compares two places.
/// Heap sort, on Lua's stack alone: it ends whatever `precedes` says, and there is nothing that a longjmp
/// could skip.
void sortList(lua_State* state, int list, lua_Integer count,
              bool (*precedes)(lua_State* state, int a, int b));

// LuaLibraries.cpp
/// Leaves a table with all globals of a script on the stack.
void pushGlobals(lua_State* state);
/// Why a script cannot have a global of Lua; nullptr for other names.
const char* whyRefused(const char* global);

}  // namespace sinew::repair
