#pragma once

#include "Session.h"

#include <span>

namespace sinew::repair {

// The language in four parts, each in the file of its name.
std::span<const Binding> solidBindings();
std::span<const Binding> shapeBindings();
std::span<const Binding> measureBindings();
std::span<const Binding> tissueBindings();

}  // namespace sinew::repair
