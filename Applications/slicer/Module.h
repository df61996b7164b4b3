#pragma once

#include "ModuleDescription.h"
#include "ModuleProgress.h"

#include <functional>

namespace sinew {

/// `main` of a Slicer module. With `--xml` it prints the description. Otherwise it reads the command line as
/// Slicer writes it (flags first, lists with commas, then the positional ones), runs the action, writes what
/// the rows of results hold to the file of `--returnparameterfile`, and accepts the other flags that Slicer
/// gives to every module. Standard error stays empty, but for one line on failure.
/// @return the exit code: 0 when all outputs are complete, else 1, or 2 on wrong usage
int runModule(int argc, char** argv, const ModuleDescription& description,
              const std::function<void(ModuleProgress&)>& action);

}  // namespace sinew
