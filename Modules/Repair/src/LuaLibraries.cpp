#include "SandboxMachine.h"

#include <cstring>

namespace sinew::repair {
namespace {

struct Refused {
  const char* name;
  const char* reason;
};

constexpr Refused kRefusedGlobals[] = {
    {"io", "a repair script cannot open files (io)"},
    {"os", "a repair script cannot reach the system (os)"},
    {"debug", "a repair script has no library debug"},
    {"package", "a repair script cannot load modules (package)"},
    {"require", "a repair script cannot load modules (require)"},
    {"load", "a repair script cannot load code (load)"},
    {"loadstring", "a repair script cannot load code (loadstring)"},
    {"loadfile", "a repair script cannot open files (loadfile)"},
    {"dofile", "a repair script cannot open files (dofile)"},
    {"pcall", "a repair script has no pcall: it ends at its first error"},
    {"xpcall", "a repair script has no xpcall: it ends at its first error"},
    {"coroutine", "a repair script has no coroutines"},
    {"getmetatable", "a repair script has no metatables (getmetatable)"},
    {"setmetatable", "a repair script has no metatables (setmetatable)"},
    {"next", "a repair script has no next; use pairs, which goes through a table in the order of its keys"},
    {"collectgarbage", "a repair script has no collectgarbage"},
    {"utf8", "a repair script has no library utf8"},
};

constexpr const char* kPatterns =
    "a repair script has no text patterns (string.find, match, gmatch, gsub); tissues \"left*\" finds by "
    "name";
constexpr Refused kRefusedText[] = {
    {"find", kPatterns},
    {"match", kPatterns},
    {"gmatch", kPatterns},
    {"gsub", kPatterns},
    {"dump", "a repair script has no string.dump"},
    {"pack", "a repair script has no string.pack"},
    {"unpack", "a repair script has no string.unpack"},
    {"packsize", "a repair script has no string.packsize"},
};
constexpr Refused kRefusedTable[] = {{"move", "a repair script has no table.move"}};
constexpr Refused kRefusedMath[] = {
    {"randomseed",
     "a repair script has no math.randomseed: math.random gives the same numbers in every run"}};

/// Of the basic library; what shows addresses or the order of hash tables is replaced.
constexpr const char* kBasics[] = {"assert", "error", "ipairs", "rawequal", "rawlen", "select", "tonumber"};
/// Functions with loops over a table that the count of instructions does not see.
constexpr const char* kTableLoops[] = {"concat", "insert", "remove", "unpack"};

int refuse(lua_State* state) {
  return raise(state, static_cast<const char*>(lua_touserdata(state, lua_upvalueindex(1))));
}

/// C function (...): calls upvalue 1 with the same arguments.
int forward(lua_State* state) {
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, LUA_MULTRET);
  return lua_gettop(state);
}

/// Length of the list at a place of the stack. Raises an error where a sparse table seems to have as many
/// entries as there are integers.
lua_Integer boundedLength(lua_State* state, int list) {
  constexpr lua_Unsigned most = 10'000'000;
  const lua_Unsigned length = lua_rawlen(state, list);
  if (length > most) raise(state, "the table is too long");
  return static_cast<lua_Integer>(length);
}

int boundedTableLoop(lua_State* state) {
  if (lua_type(state, 1) == LUA_TTABLE) charge(state, boundedLength(state, 1) / 4);
  return forward(state);
}

bool isLess(lua_State* state, int a, int b) { return lua_compare(state, a, b, LUA_OPLT) != 0; }

/// By the function at place 2.
bool isLessForScript(lua_State* state, int a, int b) {
  a = lua_absindex(state, a);
  b = lua_absindex(state, b);
  lua_pushvalue(state, 2);
  lua_pushvalue(state, a);
  lua_pushvalue(state, b);
  lua_call(state, 2, 1);
  const bool less = lua_toboolean(state, -1) != 0;
  lua_pop(state, 1);
  return less;
}

/// table.sort, whose own one asks the clock where to cut.
int sort(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  const bool own = !lua_isnoneornil(state, 2);
  if (own) luaL_checktype(state, 2, LUA_TFUNCTION);
  const lua_Integer count = boundedLength(state, 1);
  charge(state, 8 * count);
  sortList(state, 1, count, own ? isLessForScript : isLess);
  return 0;
}

/// string.format, without what would show an address.
int format(lua_State* state) {
  const char* text = luaL_checkstring(state, 1);
  for (const char* c = text; (c = std::strchr(c, '%')) != nullptr;) {
    c += 1 + std::strspn(c + 1, "-+ #0123456789.");
    if (*c == 'p') return raise(state, "string.format: there is no %p in a repair script");
    if (*c != '\0') ++c;
  }
  for (int n = 2; n <= lua_gettop(state); ++n)
    if (const int type = lua_type(state, n); type >= LUA_TTABLE || type == LUA_TLIGHTUSERDATA)
      return luaL_error(state, "string.format: value %d is a %s; use tostring", n - 1,
                        type == LUA_TUSERDATA ? "shape" : lua_typename(state, type));
  return forward(state);
}

/// Numbers before texts before booleans, ascending.
bool precedes(lua_State* state, int a, int b) {
  const int typeA = lua_type(state, a), typeB = lua_type(state, b);
  if (typeA != typeB) return typeA == LUA_TNUMBER || (typeA == LUA_TSTRING && typeB == LUA_TBOOLEAN);
  if (typeA == LUA_TBOOLEAN) return lua_toboolean(state, a) < lua_toboolean(state, b);
  if (typeA == LUA_TNUMBER) return lua_compare(state, a, b, LUA_OPLT) != 0;
  std::size_t sizeA = 0, sizeB = 0;  // by bytes: lua_compare would ask the locale
  const char* textA = lua_tolstring(state, a, &sizeA);
  const char* textB = lua_tolstring(state, b, &sizeB);
  const int order = std::memcmp(textA, textB, std::min(sizeA, sizeB));
  return order != 0 ? order < 0 : sizeA < sizeB;
}

/// C function: the next key that is still there, and its value. Upvalues: table, keys, position.
int nextPair(lua_State* state) {
  for (lua_Integer n = lua_tointeger(state, lua_upvalueindex(3)) + 1;; ++n) {
    if (lua_rawgeti(state, lua_upvalueindex(2), n) == LUA_TNIL) return 1;
    lua_pushinteger(state, n);
    lua_replace(state, lua_upvalueindex(3));
    lua_pushvalue(state, -1);
    if (lua_rawget(state, lua_upvalueindex(1)) != LUA_TNIL) return 2;
    lua_pop(state, 2);
  }
}

/// C function (table): pairs in the order of the keys.
int sortedPairs(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  lua_settop(state, 1);
  lua_newtable(state);
  lua_Integer count = 0;
  for (lua_pushnil(state); lua_next(state, 1) != 0;) {
    lua_pop(state, 1);
    const int type = lua_type(state, -1);
    if (type != LUA_TNUMBER && type != LUA_TSTRING && type != LUA_TBOOLEAN)
      return luaL_error(state, "pairs: a %s as a key has no place in an order", luaL_typename(state, -1));
    lua_pushvalue(state, -1);
    lua_rawseti(state, 2, ++count);
  }
  charge(state, 8 * count);
  sortList(state, 2, count, precedes);
  lua_pushinteger(state, 0);
  lua_pushcclosure(state, nextPair, 3);
  return 1;
}

template <std::size_t N>
void replaceRefused(lua_State* state, const Refused (&refused)[N]) {
  for (const Refused& function : refused) {
    lua_pushlightuserdata(state, const_cast<char*>(function.reason));
    lua_pushcclosure(state, refuse, 1);
    lua_setfield(state, -2, function.name);
  }
}

/// Puts a C function that knows the one that it replaces into the table on top.
void wrap(lua_State* state, const char* name, lua_CFunction wrapper) {
  lua_getfield(state, -1, name);
  lua_pushcclosure(state, wrapper, 1);
  lua_setfield(state, -2, name);
}

void makeDeterministic(lua_State* state) {
  lua_getfield(state, -1, "randomseed");
  lua_pushinteger(state, 1);
  lua_call(state, 1, 0);
}

void addBasics(lua_State* state, int globals) {
  luaL_requiref(state, LUA_GNAME, luaopen_base, 0);
  for (const char* name : kBasics) {
    lua_getfield(state, -1, name);
    lua_setfield(state, globals, name);
  }
  lua_pop(state, 1);
  constexpr luaL_Reg own[] = {{"pairs", sortedPairs}, {"type", typeOfValue}, {"tostring", textOfValue}};
  for (const luaL_Reg& function : own) {
    lua_pushcfunction(state, function.func);
    lua_setfield(state, globals, function.name);
  }
}

void addLibraries(lua_State* state, int globals) {
  luaL_requiref(state, LUA_STRLIBNAME, luaopen_string, 0);  // also what s:upper() reaches
  replaceRefused(state, kRefusedText);
  wrap(state, "format", format);
  lua_setfield(state, globals, LUA_STRLIBNAME);
  luaL_requiref(state, LUA_TABLIBNAME, luaopen_table, 0);
  replaceRefused(state, kRefusedTable);
  for (const char* name : kTableLoops) wrap(state, name, boundedTableLoop);
  lua_pushcfunction(state, sort);
  lua_setfield(state, -2, "sort");
  lua_setfield(state, globals, LUA_TABLIBNAME);
  luaL_requiref(state, LUA_MATHLIBNAME, luaopen_math, 0);
  makeDeterministic(state);
  replaceRefused(state, kRefusedMath);
  lua_setfield(state, globals, LUA_MATHLIBNAME);
}

}  // namespace

const char* whyRefused(const char* global) {
  for (const Refused& refused : kRefusedGlobals)
    if (std::strcmp(refused.name, global) == 0) return refused.reason;
  return nullptr;
}

void pushGlobals(lua_State* state) {
  lua_newtable(state);
  const int globals = lua_gettop(state);
  addBasics(state, globals);
  addLibraries(state, globals);
  makeShapeMetatable(state);
  for (const Binding& binding : Sandbox::Machine::of(state).bindings) {
    if (binding.as != Binding::As::Function && binding.as != Binding::As::Both) continue;
    pushBinding(state, binding);
    lua_setfield(state, globals, binding.name);
  }
  lua_newtable(state);
  lua_pushcfunction(state, readUnknownGlobal);
  lua_setfield(state, -2, "__index");
  lua_setmetatable(state, globals);
}

}  // namespace sinew::repair
