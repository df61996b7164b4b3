#pragma once

#include <string>
#include <vector>

namespace sinew {

/// Runs `sinew ARGUMENTS...`: a sub-command, or help and version.
/// @return the exit code: 0 fine, 1 failed in part (already told)
/// @throws CLI::ParseError on wrong usage, Interrupted, and what the command throws
int runCommand(const std::vector<std::string>& arguments);

// One sub-command each, in the file of its name; `arguments` are those after its name.
int runMesh(const std::vector<std::string>& arguments);
int runRepair(const std::vector<std::string>& arguments);
int runConvert(const std::vector<std::string>& arguments);
int runInfo(const std::vector<std::string>& arguments);
int runQuality(const std::vector<std::string>& arguments);
int runFibres(const std::vector<std::string>& arguments);
int runSimulate(const std::vector<std::string>& arguments);
int runPhantom(const std::vector<std::string>& arguments);

}  // namespace sinew
