#include "Bindings.h"
#include "sinew/Segmentation/NearestNames.h"
#include "sinew/Segmentation/SelectTissues.h"

#include <algorithm>

namespace sinew::repair {
namespace {

using As = Binding::As;

/// Whether a name fits a pattern of letters, * (any text) and ? (any letter), up to case, `_` and `-`.
bool fits(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = pattern.npos, retry = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p, ++n;
    } else if (star != pattern.npos) {
      p = star + 1;
      n = ++retry;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == pattern.npos;
}

bool hasWildcard(const std::string& pattern) { return pattern.find_first_of("*?") != pattern.npos; }

/// The tissues of the input that a pattern means: by wildcards, or as `selectTissues` has it.
std::vector<int> tissuesOf(const Segmentation& input, const std::string& pattern) {
  if (!hasWildcard(pattern)) return selectTissues(input, {pattern});
  std::vector<int> found;
  for (std::size_t n = 0; n < input.tissues.size(); ++n)
    if (fits(looseName(pattern), looseName(input.tissues[n].name))) found.push_back(static_cast<int>(n));
  return found;
}

std::vector<std::string> tissueNames(const Segmentation& input) {
  std::vector<std::string> names;
  for (const Tissue& tissue : input.tissues) names.push_back(tissue.name);
  return names;
}

/// Names and layers of several tissues.
std::string listed(const Segmentation& input, const std::vector<int>& tissues) {
  std::string list;
  for (const int t : tissues)
    list += (list.empty() ? "" : ", ") + quoted(input.tissues[t].name) + " (label " +
            std::to_string(input.tissues[t].label) + ", layer " + std::to_string(input.tissues[t].layer) +
            ")";
  return list;
}

int onlyOne(Call& call, const std::vector<int>& tissues, const std::string& wish) {
  if (tissues.size() > 1)
    call.reader().refuse(quoted(wish) + " may be " + listed(call.session.input(), tissues) +
                         "; use the id or the label");
  return tissues.front();
}

Values tissueOf(Call& call) {
  call.atMost(1);
  const double* label = std::get_if<double>(&call[0]);
  const std::string wish = label ? toText(*label) : call.reader().text("the name", call[0]);
  const std::vector<int> found = tissuesOf(call.session.input(), wish);
  if (found.empty())
    call.reader().refuse("none fits " + quoted(wish) + "; the nearest names are " +
                         nearestNames(wish, tissueNames(call.session.input())));
  return {call.engine().tissue(onlyOne(call, found, wish))};
}

Values tissuesOf(Call& call) {
  call.atMost(1);
  const std::string pattern = call.has(0) ? call.reader().text("the pattern", call[0]) : "*";
  Table table;
  for (const int t : tissuesOf(call.session.input(), pattern))
    table.items.emplace_back(call.engine().tissue(t));
  if (table.items.empty()) call.session.tell("tissues " + quoted(pattern, '"') + ": there is none");
  return {std::make_shared<const Table>(std::move(table))};
}

/// The tissue of the input that a saved name replaces: of exactly that name or id; -1 for none.
int replacedTissue(Call& call, const std::string& name) {
  const std::vector<Tissue>& tissues = call.session.input().tissues;
  for (const auto key : {&Tissue::name, &Tissue::id}) {
    std::vector<int> found;
    for (std::size_t t = 0; t < tissues.size(); ++t)
      if (tissues[t].*key == name) found.push_back(static_cast<int>(t));
    if (!found.empty()) return onlyOne(call, found, name);
  }
  return -1;
}

/// A new name that differs from a tissue's in case only may be a slip.
void tellLikeness(Call& call, const std::string& name) {
  for (const Tissue& tissue : call.session.input().tissues)
    if (looseName(tissue.name) == looseName(name))
      call.session.tell("save " + quoted(name, '"') + ": a new tissue; " + quoted(tissue.name) +
                        " stays as it is");
}

std::array<double, 3> colorOf(Call& call, const Value& value) {
  const Table& table = call.reader().table("color", value);
  if (table.items.size() != 3) call.reader().refuse("color has to be {red, green, blue}, each from 0 to 1");
  std::array<double, 3> color{};
  for (int c = 0; c < 3; ++c)
    color[c] =
        call.reader().number("number " + std::to_string(c + 1) + " of color", table.items[c], {0, false, 1});
  return color;
}

Values saveOf(Call& call) {
  const std::string name = call.reader().text("the name", call[0]);
  if (name.empty() || std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' '; }))
    call.reader().refuse("the name is " + quoted(name, '"') + "; allowed: a line of text");
  Saving saving;
  saving.tissue = replacedTissue(call, name);
  saving.name = saving.tissue < 0 ? name : call.session.input().tissues[saving.tissue].name;
  saving.shape = call.reader().shape("the second argument", call[1]);
  saving.line = call.line;
  if (call.has(2)) {
    const Fields fields = call.fields(2, {"color"});
    if (fields.has("color")) saving.color = colorOf(call, fields["color"]);
  }
  call.atMost(3);
  if (saving.tissue < 0) tellLikeness(call, name);
  Wishes& wishes = call.session.wishes;
  std::erase_if(wishes.savings, [&](const Saving& older) { return older.name == saving.name; });
  wishes.removed.erase(saving.tissue);
  wishes.savings.push_back(std::move(saving));
  return {};
}

Values removeOf(Call& call) {
  call.atMost(1);
  const ShapePtr* shape = std::get_if<ShapePtr>(&call[0]);
  const std::string pattern = shape ? (*shape)->name : call.reader().text("the pattern", call[0]);
  Wishes& wishes = call.session.wishes;
  const auto saved = std::erase_if(wishes.savings, [&](const Saving& saving) {
    return saving.tissue < 0 && fits(looseName(pattern), looseName(saving.name));
  });
  if (saved > 0 && !hasWildcard(pattern)) return {};
  const std::vector<int> found = tissuesOf(call.session.input(), pattern);
  if (found.empty() && saved == 0) call.session.tell("remove " + quoted(pattern, '"') + ": there is none");
  for (const int t : found) {
    wishes.removed.insert(t);
    std::erase_if(wishes.savings, [&](const Saving& saving) { return saving.tissue == t; });
  }
  return {};
}

Values priorityOf(Call& call) {
  call.atMost(1);
  const Table& list = call.reader().table("the list of names", call[0]);
  if (list.items.empty() || !list.fields.empty())
    call.reader().refuse("takes a list of names; usage: " + call.reader().usage());
  std::vector<std::string> names;
  for (const Value& item : list.items) {
    const ShapePtr* shape = std::get_if<ShapePtr>(&item);
    names.push_back(shape ? (*shape)->name
                          : call.reader().text("name " + std::to_string(names.size() + 1), item));
  }
  call.session.wishes.priority = names;
  call.session.wishes.priorityLine = call.line;
  return {};
}

Values layersOf(Call& call) {
  call.atMost(0);
  call.session.wishes.layers = true;
  return {};
}

Values coordinatesOf(Call& call) {
  call.atMost(1);
  const std::string system = call.reader().text("the system", call[0]);
  if (system != "RAS" && system != "LPS")
    call.reader().refuse("the system is " + quoted(system, '"') + "; allowed: \"LPS\", \"RAS\"");
  call.session.useCoordinates(system == "RAS");
  return {};
}

Values settingOf(Call& call) {
  call.atMost(2);
  const std::string name = call.reader().text("the name", call[0]);
  if (std::optional<Value> value = call.session.setting(name)) return {*value};
  if (!call.has(1)) call.reader().refuse("needs --set " + name + "=VALUE, or a value to use without");
  return {call[1]};
}

Values printOf(Call& call) {
  std::string line;
  for (int n = 0; n < call.count(); ++n) {
    if (n > 0) line += ' ';
    line += toText(call[n]);
  }
  call.session.print(line);
  return {};
}

constexpr Binding kTissues[] = {
    {"tissue", "tissue \"name\"", As::Function, tissueOf},
    {"tissues", "tissues \"pattern*\"", As::Function, tissuesOf},
    {"save", "save(\"name\", shape, {color={red, green, blue}})", As::Function, saveOf},
    {"remove", "remove \"pattern*\"", As::Function, removeOf},
    {"priority", "priority{\"name\", ...}", As::Function, priorityOf},
    {"layers", "layers()", As::Function, layersOf},
    {"coordinates", "coordinates \"RAS\"", As::Function, coordinatesOf},
    {"setting", "setting(\"name\", otherwise)", As::Function, settingOf},
    {"print", "print(...)", As::Function, printOf},
};

}  // namespace

std::span<const Binding> tissueBindings() { return kTissues; }

}  // namespace sinew::repair
