#include <cstdlib>
#include <new>

// A header may promise any size. What is beyond 1 GB is memory that is not there, which the readers must
// survive: AddressSanitizer's own `new` ends the program instead.

extern "C" const char* __asan_default_options() {
  // ITK's and VTK's readers leak when they report errors; Sinew itself owns no bare pointer.
  return "max_allocation_size_mb=1000:allocator_may_return_null=1:alloc_dealloc_mismatch=0:detect_leaks=0";
}

void* operator new(std::size_t bytes) {
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}

void* operator new[](std::size_t bytes) { return operator new(bytes); }
