#pragma once

#include "sinew/Segmentation/Segmentation.h"

#include <string>
#include <vector>

namespace sinew {

/// One file name without extension per tissue: the tissue's name with spaces and everything that some
/// file system refuses replaced by `_`. Never empty, reserved or hidden; unique without regard to case, in
/// any script: tissues that would share a name get `_<label>` appended, or `_<label>_layer<k>` where the
/// label is shared as well. Give the whole table, so that a tissue's name does not depend on what else is
/// asked for.
std::vector<std::string> tissueFileStems(const std::vector<Tissue>& tissues);

/// `wanted`, with as many `_` behind it as it takes to differ from all of `stems`, without regard to case.
std::string freeFileStem(std::string wanted, const std::vector<std::string>& stems);

}  // namespace sinew
