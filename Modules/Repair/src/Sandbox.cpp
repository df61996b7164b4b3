#include "Sandbox.h"

#include "SandboxMachine.h"

#include <cstdlib>
#include <cstring>
#include <string_view>

namespace sinew::repair {
namespace {

constexpr int kInstructionsPerBeat = 1'000;
/// Bytes allocated, or of a text that an instruction may go through, that count as one instruction.
constexpr std::int64_t kBytesPerInstruction = 64;
/// Shorter texts cost nothing.
constexpr std::int64_t kLongText = 4096;

/// Lua's allocator: fails beyond the limit, upon which Lua collects garbage and tries once more.
void* allocate(void* user, void* block, std::size_t oldSize, std::size_t newSize) {
  auto& machine = *static_cast<Sandbox::Machine*>(user);
  const auto before = block == nullptr ? 0 : static_cast<std::int64_t>(oldSize);
  if (newSize == 0) {
    std::free(block);
    machine.bytes -= before;
    return nullptr;
  }
  const auto growth = static_cast<std::int64_t>(newSize) - before;
  if (growth > machine.options.bytes - machine.bytes) {
    if (machine.state != nullptr) machine.line = currentLine(machine.state);
    return nullptr;
  }
  void* moved = std::realloc(block, newSize);
  if (moved == nullptr) return nullptr;
  machine.bytes += growth;
  machine.allocated += std::max<std::int64_t>(growth, 0);
  if (block == nullptr && oldSize == LUA_TSTRING)  // so Lua tells what it makes
    machine.longestText = std::max(machine.longestText, growth);
  return moved;
}

void beat(lua_State* state, lua_Debug*) {
  Sandbox::Machine& machine = Sandbox::Machine::of(state);
  const std::int64_t text = machine.longestText > kLongText ? machine.longestText / kBytesPerInstruction : 0;
  charge(state, kInstructionsPerBeat * (1 + text));
  try {
    machine.host.heartbeat(currentLine(state));
  } catch (const ScriptStopped& stop) {
    machine.stopped = stop.reason;
  } catch (...) {
    machine.stopped = std::current_exception();
  }
  if (machine.stopped) raise(state, "stopped");
}

/// The message handler: notes the line, keeps the message.
int noteLine(lua_State* state) {
  Sandbox::Machine::of(state).line = currentLine(state);
  return 1;
}

struct Source {
  const char* text;
  std::size_t size;
};

/// C function (source): opens the libraries, compiles, runs.
int runProtected(lua_State* state) {
  const auto& source = *static_cast<const Source*>(lua_touserdata(state, 1));
  const Sandbox::Machine& machine = Sandbox::Machine::of(state);
  pushGlobals(state);
  const char* name = lua_pushfstring(state, "@%s", machine.options.scriptName.c_str());
  if (luaL_loadbufferx(state, source.text, source.size, name, "t") != LUA_OK) return lua_error(state);
  lua_pushvalue(state, -3);
  lua_setupvalue(state, -2, 1);  // _ENV
  lua_sethook(state, beat, LUA_MASKCOUNT, kInstructionsPerBeat);
  lua_call(state, 0, 0);
  return 0;
}

std::string millions(std::int64_t count) { return std::to_string(count / 1'000'000); }

/// One line, `NAME:LINE: message`.
std::string placed(const Sandbox::Machine& machine, std::string message) {
  for (char& c : message)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  // As Lua shortens a long name.
  char place[LUA_IDSIZE];
  const std::string& name = machine.options.scriptName;
  if (name.size() + 1 <= sizeof place)
    std::snprintf(place, sizeof place, "%s", name.c_str());
  else
    std::snprintf(place, sizeof place, "...%s", name.c_str() + (name.size() + 4 - sizeof place));
  const std::string prefix = std::string(place) + ":";
  if (message.starts_with(prefix)) return message;
  return prefix + (machine.line > 0 ? std::to_string(machine.line) + ": " : " ") + message;
}

}  // namespace

int currentLine(lua_State* state) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(state, level, &frame) == 1; ++level) {
    lua_getinfo(state, "l", &frame);
    if (frame.currentline > 0) return frame.currentline;
  }
  return 0;
}

int raise(lua_State* state, const char* message) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(state, level, &frame) == 1; ++level) {
    lua_getinfo(state, "Sl", &frame);
    if (frame.currentline <= 0) continue;
    lua_pushfstring(state, "%s:%d: %s", frame.short_src, frame.currentline, message);
    return lua_error(state);
  }
  lua_pushstring(state, message);
  return lua_error(state);
}

void charge(lua_State* state, std::int64_t work) {
  Sandbox::Machine& machine = Sandbox::Machine::of(state);
  machine.work += work;
  if (machine.work + machine.allocated / kBytesPerInstruction <= machine.options.instructions) return;
  const auto limit = static_cast<int>(machine.options.instructions / 1'000'000);
  lua_pushfstring(state, "the script was stopped after %d million instructions; is there an endless loop?",
                  limit);
  raise(state, lua_tostring(state, -1));
}

Sandbox::Sandbox(std::span<const Binding> bindings, ScriptHost& host, SandboxOptions options)
    : machine_(std::make_unique<Machine>(bindings, host, std::move(options))) {
  machine_->state = lua_newstate(allocate, machine_.get());
  if (machine_->state == nullptr) throw std::bad_alloc();
  Machine* machine = machine_.get();
  std::memcpy(lua_getextraspace(machine->state), &machine, sizeof machine);
}

Sandbox::~Sandbox() { lua_close(machine_->state); }

void Sandbox::collect() { lua_gc(machine_->state, LUA_GCCOLLECT); }

void Sandbox::run(const std::string& script) {
  Machine& machine = *machine_;
  std::string_view text = script;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (text.starts_with(LUA_SIGNATURE))
    throw std::invalid_argument(placed(machine, "this is compiled Lua; a repair script is text"));
  Source source{text.data(), text.size()};
  lua_State* state = machine.state;
  lua_pushcfunction(state, noteLine);
  lua_pushcfunction(state, runProtected);
  lua_pushlightuserdata(state, &source);
  const int status = lua_pcall(state, 1, 0, -3);
  if (machine.stopped) std::rethrow_exception(machine.stopped);
  if (status == LUA_OK) return;
  if (status == LUA_ERRMEM)
    throw std::invalid_argument(placed(machine, "the texts and tables of the script take more than " +
                                                    millions(machine.options.bytes) + " MB"));
  const char* message =
      lua_type(state, -1) == LUA_TSTRING ? lua_tostring(state, -1) : "error() without a text";
  throw std::invalid_argument(placed(machine, message));
}

}  // namespace sinew::repair
