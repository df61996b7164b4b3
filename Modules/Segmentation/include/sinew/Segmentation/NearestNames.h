#pragma once

#include <string>
#include <vector>

namespace sinew {

/// Lower case, with spaces for `_` and `-`: names that differ in nothing else count as the same.
std::string looseName(std::string name);

/// The names that come nearest to what was typed, nearest first: those that contain it or are contained in
/// it, then by Levenshtein's distance, up to case, `_` and `-`.
/// @return at most `count` names, each once, in quotes and with commas between: `'biceps', 'triceps'`
std::string nearestNames(const std::string& typed, const std::vector<std::string>& names,
                         std::size_t count = 3);

}  // namespace sinew
