#pragma once

#include <string>

namespace sinew {

/// Memory that this process may still take, bytes: what the machine has free, within the limits of the
/// control groups (containers, batch systems) it runs in. Infinity where nothing is known.
double availableMemory();

/// Largest resident memory of this process so far, bytes.
double peakMemory();

/// Number of bytes for people: `1.4 GB`, `320 MB`, `12 kB`.
std::string formatBytes(double bytes);

}  // namespace sinew
