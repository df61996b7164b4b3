// Where Lua and C++ meet. Lua leaves C functions by longjmp, which skips destructors; C++ must not throw
// through frames of Lua. So every way in has two halves:
//   - enter...(): C++. Reads the stack by functions that raise no error, catches everything, and leaves
//   results or
//     the failure in the Machine.
//   - the C function above it: pushes results or raises the failure. It holds no object with a destructor.
#include "SandboxMachine.h"
#include "sinew/Segmentation/NearestNames.h"

#include <cmath>
#include <cstring>
#include <new>

namespace sinew::repair {
namespace {

using Machine = Sandbox::Machine;

constexpr const char* kShape = "shape";
constexpr int kDeepestTable = 8;
constexpr int kMostValues = 2'000'000;
constexpr std::size_t kMostTextBytes = std::size_t{16} << 20;

/// Reads values off the stack. Raises no Lua error; throws ScriptError.
class StackReader {
 public:
  explicit StackReader(lua_State* state) : state_(state) {}

  Value at(int index, int depth = 0) {
    if (++read_ > kMostValues)
      throw ScriptError("more than " + std::to_string(kMostValues) + " values in one call");
    switch (lua_type(state_, index)) {
      case LUA_TNIL:
        return std::monostate{};
      case LUA_TBOOLEAN:
        return lua_toboolean(state_, index) != 0;
      case LUA_TNUMBER:
        return static_cast<double>(lua_tonumber(state_, index));
      case LUA_TSTRING:
        return text(index);
      case LUA_TUSERDATA:
        return *static_cast<const ShapePtr*>(lua_touserdata(state_, index));  // the only kind
      case LUA_TTABLE:
        return table(lua_absindex(state_, index), depth);
      default:
        return Foreign{lua_typename(state_, lua_type(state_, index))};
    }
  }
  int read() const { return read_; }

 private:
  std::string text(int index) {
    std::size_t size = 0;
    const char* bytes = lua_tolstring(state_, index, &size);
    textBytes_ += size;
    if (textBytes_ > kMostTextBytes)
      throw ScriptError("more than " + std::to_string(kMostTextBytes >> 20) + " MB of texts in one call");
    return {bytes, size};
  }

  TablePtr table(int index, int depth) {
    if (depth >= kDeepestTable) throw ScriptError("tables inside of tables, too many or without an end");
    if (lua_checkstack(state_, 4) == 0) throw ScriptError("too many values");
    auto table = std::make_shared<Table>();
    const auto length = static_cast<lua_Integer>(lua_rawlen(state_, index));
    if (length > kMostValues)
      throw ScriptError("a table of " + std::to_string(length) + " entries is too long");
    for (lua_Integer n = 1; n <= length; ++n) {
      lua_rawgeti(state_, index, n);
      table->items.push_back(at(-1, depth + 1));
      lua_pop(state_, 1);
    }
    for (lua_pushnil(state_); lua_next(state_, index) != 0; lua_pop(state_, 1)) {
      if (lua_type(state_, -2) == LUA_TSTRING)
        table->fields.insert_or_assign(text(-2), at(-1, depth + 1));
      else if (!isItem(-2, length))
        throw ScriptError("a table with a hole, or with a key that is no name");
    }
    return table;
  }

  bool isItem(int index, lua_Integer length) {
    if (lua_isinteger(state_, index) == 0) return false;
    const lua_Integer key = lua_tointeger(state_, index);
    return key >= 1 && key <= length;
  }

  lua_State* state_;
  int read_ = 0;
  std::size_t textBytes_ = 0;
};

// The half in C++.

/// Calls `action`, and keeps what it throws. @return whether it threw nothing
template <class Action>
bool guarded(Machine& machine, Action&& action) noexcept {
  try {
    action();
    return true;
  } catch (const ScriptStopped& stop) {
    machine.stopped = stop.reason;
  } catch (const std::bad_alloc&) {
    machine.failure = "out of memory";
  } catch (const std::exception& error) {
    machine.failure = error.what();
  } catch (...) {
    machine.stopped = std::current_exception();
  }
  return false;
}

bool enterBinding(lua_State* state, const Binding& binding, int& valuesRead) noexcept {
  Machine& machine = Machine::of(state);
  return guarded(machine, [&] {
    StackReader reader(state);
    Values arguments;
    for (int n = 1; n <= lua_gettop(state); ++n) arguments.push_back(reader.at(n));
    valuesRead = reader.read();
    machine.results = machine.host.call(binding, std::move(arguments), currentLine(state));
  });
}

bool enterToText(lua_State* state) noexcept {
  Machine& machine = Machine::of(state);
  return guarded(machine, [&] { machine.results = {toText(StackReader(state).at(1))}; });
}

bool enterGlobal(lua_State* state, const char* name) noexcept {
  Machine& machine = Machine::of(state);
  return guarded(machine, [&] {
    std::optional<Value> value = machine.host.setting(name);
    if (!value) {
      if (const char* reason = whyRefused(name)) throw ScriptError(reason);
      std::vector<std::string> names{"math",   "string", "table",    "pairs",
                                     "ipairs", "print",  "tostring", "tonumber"};
      for (const Binding& binding : machine.bindings)
        if (binding.as == Binding::As::Function || binding.as == Binding::As::Both)
          names.push_back(binding.name);
      throw ScriptError("unknown name " + quoted(name) + "; the nearest are " + nearestNames(name, names));
    }
    machine.results = {std::move(*value)};
  });
}

bool enterUnknownMember(lua_State* state, const char* name) noexcept {
  Machine& machine = Machine::of(state);
  return guarded(machine, [&] {
    const auto& shape = *static_cast<const ShapePtr*>(lua_touserdata(state, 1));
    if (std::strcmp(name, "name") == 0) {
      machine.results = {shape->name};
      return;
    }
    std::vector<std::string> names{"name"};
    for (const Binding& binding : machine.bindings)
      if (binding.as == Binding::As::Method || binding.as == Binding::As::Both) names.push_back(binding.name);
    throw ScriptError("a shape has no " + quoted(name) + "; the nearest are " + nearestNames(name, names));
  });
}

// The half in C.

int releaseShape(lua_State* state) {
  static_cast<ShapePtr*>(lua_touserdata(state, 1))->~ShapePtr();
  return 0;
}

void pushShape(lua_State* state, const ShapePtr& shape) {
  // Empty until the metatable, which may fail to come, takes care of its end.
  auto* slot = new (lua_newuserdatauv(state, sizeof(ShapePtr), 0)) ShapePtr;
  luaL_setmetatable(state, kShape);
  *slot = shape;
}

void pushNumber(lua_State* state, double number) {
  lua_Integer whole = 0;
  if (lua_numbertointeger(number, &whole) && static_cast<double>(whole) == number)
    lua_pushinteger(state, whole);
  else
    lua_pushnumber(state, number);
}

void pushValue(lua_State* state, const Value& value);

void pushTable(lua_State* state, const Table& table) {
  luaL_checkstack(state, 4, nullptr);
  lua_newtable(state);
  lua_Integer n = 0;
  for (const Value& item : table.items) {
    pushValue(state, item);
    lua_rawseti(state, -2, ++n);
  }
  for (const auto& field : table.fields) {
    lua_pushlstring(state, field.first.data(), field.first.size());
    pushValue(state, field.second);
    lua_rawset(state, -3);
  }
}

void pushValue(lua_State* state, const Value& value) {
  if (const auto* number = std::get_if<double>(&value))
    pushNumber(state, *number);
  else if (const auto* flag = std::get_if<bool>(&value))
    lua_pushboolean(state, *flag);
  else if (const auto* text = std::get_if<std::string>(&value))
    lua_pushlstring(state, text->data(), text->size());
  else if (const auto* shape = std::get_if<ShapePtr>(&value))
    pushShape(state, *shape);
  else if (const auto* table = std::get_if<TablePtr>(&value))
    pushTable(state, **table);
  else
    lua_pushnil(state);
}

/// Ends a C function whose other half is done.
int leave(lua_State* state, bool fine) {
  Machine& machine = Machine::of(state);
  if (!fine) return raise(state, machine.stopped ? "stopped" : machine.failure.c_str());
  const auto count = static_cast<int>(machine.results.size());
  luaL_checkstack(state, count + 4, nullptr);
  for (int n = 0; n < count; ++n) pushValue(state, machine.results[n]);
  machine.results.clear();  // a shape must not live on here
  return count;
}

int callBinding(lua_State* state) {
  const auto& binding = *static_cast<const Binding*>(lua_touserdata(state, lua_upvalueindex(1)));
  luaL_checkstack(state, kDeepestTable * 4, nullptr);
  int valuesRead = 0;
  const bool fine = enterBinding(state, binding, valuesRead);
  if (fine) charge(state, valuesRead);
  return leave(state, fine);
}

/// C function (shape, name): a method (upvalue 1 holds them) or another member.
int readMember(lua_State* state) {
  if (lua_type(state, 2) != LUA_TSTRING) return raise(state, "a shape has members with names only");
  lua_pushvalue(state, 2);
  if (lua_rawget(state, lua_upvalueindex(1)) != LUA_TNIL) return 1;
  return leave(state, enterUnknownMember(state, lua_tostring(state, 2)));
}

int refuseMember(lua_State* state) { return raise(state, "a shape is a value and cannot be changed"); }

}  // namespace

void pushBinding(lua_State* state, const Binding& binding) {
  lua_pushlightuserdata(state, const_cast<Binding*>(&binding));
  lua_pushcclosure(state, callBinding, 1);
}

void makeShapeMetatable(lua_State* state) {
  using As = Binding::As;
  luaL_newmetatable(state, kShape);  // __name makes Lua say `shape` in its messages
  lua_newtable(state);
  for (const Binding& binding : Machine::of(state).bindings) {
    if (binding.as == As::Function) continue;
    pushBinding(state, binding);
    lua_setfield(state, binding.as == As::Operator ? -3 : -2, binding.name);
  }
  lua_pushcclosure(state, readMember, 1);
  lua_setfield(state, -2, "__index");
  lua_pushcfunction(state, refuseMember);
  lua_setfield(state, -2, "__newindex");
  lua_pushcfunction(state, releaseShape);
  lua_setfield(state, -2, "__gc");
  lua_pop(state, 1);
}

int readUnknownGlobal(lua_State* state) {
  if (lua_type(state, 2) != LUA_TSTRING) return raise(state, "names of globals are texts");
  return leave(state, enterGlobal(state, lua_tostring(state, 2)));
}

int typeOfValue(lua_State* state) {
  luaL_checkany(state, 1);
  const int type = lua_type(state, 1);
  lua_pushstring(state, type == LUA_TUSERDATA ? kShape : lua_typename(state, type));
  return 1;
}

int textOfValue(lua_State* state) {
  luaL_checkany(state, 1);
  return leave(state, enterToText(state));
}

}  // namespace sinew::repair
