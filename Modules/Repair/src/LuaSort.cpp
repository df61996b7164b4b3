#include "SandboxMachine.h"

namespace sinew::repair {
namespace {

using Precedes = bool (*)(lua_State* state, int a, int b);

/// Sinks entry `root` of a heap of `count` entries to its place.
void sink(lua_State* state, int list, lua_Integer root, lua_Integer count, Precedes precedes) {
  for (lua_Integer child = 2 * root; child <= count; root = child, child = 2 * root) {
    lua_rawgeti(state, list, child);
    if (child < count) {
      lua_rawgeti(state, list, child + 1);
      if (precedes(state, -2, -1)) {
        ++child;
        lua_remove(state, -2);
      } else {
        lua_pop(state, 1);
      }
    }
    lua_rawgeti(state, list, root);
    if (!precedes(state, -1, -2)) {
      lua_pop(state, 2);
      return;
    }
    lua_rawseti(state, list, child);
    lua_rawseti(state, list, root);
  }
}

}  // namespace

void sortList(lua_State* state, int list, lua_Integer count, Precedes precedes) {
  luaL_checkstack(state, 8, nullptr);
  for (lua_Integer root = count / 2; root >= 1; --root) sink(state, list, root, count, precedes);
  for (lua_Integer end = count; end > 1; --end) {
    lua_rawgeti(state, list, 1);
    lua_rawgeti(state, list, end);
    lua_rawseti(state, list, 1);
    lua_rawseti(state, list, end);
    sink(state, list, 1, end - 1, precedes);
  }
}

}  // namespace sinew::repair
