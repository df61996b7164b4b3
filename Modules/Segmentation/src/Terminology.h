#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

/// 3D Slicer's terminology entries:
///     list~category~type~type modifier~region list~region~region modifier      each code
///     `scheme^value^meaning`
namespace sinew::terminology {

/// The segment tag that holds an entry.
constexpr std::string_view kTag = "TerminologyEntry";

/// The columns of a Slicer .csv table: five codes, three cells each.
const std::vector<std::string>& columns();

/// The cells of an entry, in the order of columns(); empty ones for what it lacks.
std::vector<std::string> cells(std::string_view entry);

/// The entry of these cells; empty when all are. The separators of entries cannot stand inside of them.
std::string entry(const std::vector<std::string>& cells, const std::string& list = {},
                  const std::string& regionList = {});

/// The same codes without the names of the lists they come from, which tables cannot hold.
std::string withoutLists(std::string_view entry);

}  // namespace sinew::terminology
