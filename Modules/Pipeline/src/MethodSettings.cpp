#include "sinew/Pipeline/MethodSettings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

constexpr std::array<std::pair<CompressionMethod, const char*>, 4> kMethods{
    {{CompressionMethod::Optimization, "optimization"},
     {CompressionMethod::Springs, "springs"},
     {CompressionMethod::FiniteElements, "fem"},
     {CompressionMethod::Hybrid, "hybrid"}}};

constexpr std::array<std::pair<MeshingMaterial, const char*>, 3> kMaterials{
    {{MeshingMaterial::NeoHookean, "neo-hookean"},
     {MeshingMaterial::StVenantKirchhoff, "stvk"},
     {MeshingMaterial::Corotated, "corotated"}}};

template <class Names>
std::string listOf(const Names& names) {
  std::string list;
  for (const auto& [value, name] : names) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

template <class Names, class Value>
std::string nameOf(const Names& names, Value value) {
  return std::ranges::find(names, value, [](const auto& entry) { return entry.first; })->second;
}

/// What a key sets.
using Place = std::variant<bool*, int*, double*, MeshingMaterial*>;

enum class Serves { Springs, Elements, Both };

struct Key {
  const char* name;
  Serves serves;
  Place (*place)(PhysicsCompressionOptions&);
};

/// The table of README's chapter on methods has the same rows.
constexpr std::array<Key, 12> kKeys{{
    {"material", Serves::Elements, [](PhysicsCompressionOptions& o) -> Place { return &o.material; }},
    {"poisson", Serves::Elements, [](PhysicsCompressionOptions& o) -> Place { return &o.poisson; }},
    {"shortest-only", Serves::Springs, [](PhysicsCompressionOptions& o) -> Place { return &o.shortestOnly; }},
    {"acts-below", Serves::Springs, [](PhysicsCompressionOptions& o) -> Place { return &o.actsBelow; }},
    {"damping", Serves::Both, [](PhysicsCompressionOptions& o) -> Place { return &o.damping; }},
    {"drag", Serves::Both, [](PhysicsCompressionOptions& o) -> Place { return &o.drag; }},
    {"push", Serves::Both, [](PhysicsCompressionOptions& o) -> Place { return &o.push; }},
    {"force-steps", Serves::Both, [](PhysicsCompressionOptions& o) -> Place { return &o.forceSteps; }},
    {"velocity-steps", Serves::Both, [](PhysicsCompressionOptions& o) -> Place { return &o.velocitySteps; }},
    {"stillness", Serves::Both, [](PhysicsCompressionOptions& o) -> Place { return &o.stillness; }},
    {"strain", Serves::Both, [](PhysicsCompressionOptions& o) -> Place { return &o.limits.strain; }},
    {"strain-change", Serves::Both, [](PhysicsCompressionOptions& o) -> Place { return &o.limits.change; }},
}};

bool hasEffect(const Key& key, CompressionMethod method) {
  if (method == CompressionMethod::Optimization) return false;
  const Serves other = method == CompressionMethod::Springs ? Serves::Elements : Serves::Springs;
  return key.serves != other;
}

template <class Number>
bool readNumber(std::string_view text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end && std::isfinite(static_cast<double>(number));
}

struct Reader {
  std::string_view text;

  /// @return what is allowed; empty when the value was read
  std::string operator()(bool* value) const {
    *value = text == "true";
    return *value || text == "false" ? "" : "true or false";
  }
  std::string operator()(int* value) const { return readNumber(text, *value) ? "" : "a whole number"; }
  std::string operator()(double* value) const { return readNumber(text, *value) ? "" : "a number"; }
  std::string operator()(MeshingMaterial* value) const {
    const auto found = std::ranges::find(kMaterials, text, [](const auto& entry) { return entry.second; });
    if (found == kMaterials.end()) return "one of " + listOf(kMaterials);
    *value = found->first;
    return "";
  }
};

struct Writer {
  PhysicsValue operator()(const MeshingMaterial* value) const { return nameOf(kMaterials, *value); }
  template <class Number>
  PhysicsValue operator()(const Number* value) const {
    return *value;
  }
};

std::string textOf(const PhysicsValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&value)) return *text;
  char digits[32];
  const auto write = [&](auto number) {
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  };
  if (const int* number = std::get_if<int>(&value)) return write(*number);
  return write(std::get<double>(value));
}

std::string keysOf(CompressionMethod method) {
  std::string list;
  for (const Key& key : kKeys)
    if (hasEffect(key, method)) list += (list.empty() ? "" : ", ") + std::string(key.name);
  return list;
}

}  // namespace

const std::vector<std::string>& methodNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [method, name] : kMethods) list.emplace_back(name);
    return list;
  }();
  return names;
}

std::string toString(CompressionMethod method) { return nameOf(kMethods, method); }

CompressionMethod parseMethod(std::string_view name) {
  const auto found = std::ranges::find(kMethods, name, [](const auto& entry) { return entry.second; });
  if (found == kMethods.end())
    throw std::invalid_argument("'" + std::string(name) + "' is no method: write one of " + listOf(kMethods));
  return found->first;
}

void setPhysics(std::string_view text, CompressionMethod method, PhysicsCompressionOptions& physics) {
  const auto equals = text.find('=');
  const std::string name(text.substr(0, equals));
  const auto key = std::ranges::find(kKeys, name, &Key::name);
  if (equals == text.npos || key == kKeys.end() || !hasEffect(*key, method)) {
    const std::string known = keysOf(method);
    throw std::invalid_argument("'" + name + "' has no effect on the method " + toString(method) +
                                (known.empty() ? "" : "; its keys are " + known));
  }
  PhysicsCompressionOptions changed = physics;
  const std::string allowed = std::visit(Reader{text.substr(equals + 1)}, key->place(changed));
  if (!allowed.empty())
    throw std::invalid_argument("'" + std::string(text) + "': " + name + " must be " + allowed);
  requireSound(changed);
  physics = changed;
}

std::vector<std::pair<std::string, PhysicsValue>> physicsSettings(CompressionMethod method,
                                                                  const PhysicsCompressionOptions& physics) {
  std::vector<std::pair<std::string, PhysicsValue>> settings;
  PhysicsCompressionOptions copy = physics;
  for (const Key& key : kKeys)
    if (hasEffect(key, method)) settings.emplace_back(key.name, std::visit(Writer{}, key.place(copy)));
  return settings;
}

std::string physicsHelp() {
  PhysicsCompressionOptions standard;
  std::string list;
  for (const Key& key : kKeys)
    list += (list.empty() ? "" : ", ") + std::string(key.name) + "=" +
            textOf(std::visit(Writer{}, key.place(standard)));
  return list;
}

}  // namespace sinew
