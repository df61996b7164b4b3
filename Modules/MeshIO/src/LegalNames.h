#pragma once

#include "sinew/MeshIO/TissueMesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What a format allows in a name.
struct NameRule {
  std::size_t maxBytes;
  std::string_view refused;  ///< printable ASCII that becomes `_`, as control characters do
  bool asciiOnly = false;    ///< other characters of UTF-8 become `_`, too
  bool letterFirst = false;  ///< else `T_` is put in front
};

/// A legal name for every region: its own where it is legal, else with the refused replaced and cut at a
/// character's end. `Segment_<label>` where there is none. Names that are the same but for the case of ASCII
/// letters, or among `taken` (lower case), get `_<label>`.
std::vector<std::string> legalNames(const std::vector<TissueRegion>& regions, const NameRule& rule,
                                    const std::vector<std::string>& taken = {});

/// A name as part of a one-line comment in UTF-8: control characters become spaces, bytes that are none `?`.
std::string inComment(std::string_view name);

}  // namespace sinew
