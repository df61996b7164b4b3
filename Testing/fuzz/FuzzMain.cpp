#include "Targets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

/// libFuzzer's entry; SINEW_FUZZ_TARGET names the target of this program.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew::fuzz;
  static const Target& target = *std::ranges::find(targets(), SINEW_FUZZ_TARGET, &Target::name);
  target.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
