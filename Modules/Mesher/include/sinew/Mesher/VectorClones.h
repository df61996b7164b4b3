#pragma once

/// In front of a function: it is compiled for plain x86-64 and for processors with AVX2 and FMA, and the
/// better one is taken when the program starts. Empty where the compiler cannot, and under sanitizers, which
/// are not ready that early.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SINEW_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define SINEW_VECTOR_CLONES
#endif
