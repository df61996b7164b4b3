#pragma once

/// For AddressSanitizer. A header may promise any size: what is beyond 1 GB is memory that is not there, not
/// a finding. ITK's and VTK's readers leak when they report errors; Sinew itself owns no bare pointer.
extern "C" const char* __asan_default_options() {
  return "allocator_may_return_null=1:max_allocation_size_mb=1000:detect_leaks=0";
}
