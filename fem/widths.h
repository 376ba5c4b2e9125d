// Loops compiled for each vector width of processors; the program chooses one when it starts. Floating-point
// contraction is off, so that each gives the same bits. For .cc files.
#pragma once

// GCC on x86-64; programs with the address sanitizer do not start with target_clones.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define PLATEN_WIDTHS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define PLATEN_WIDTHS
#endif

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi" // all functions that take or return vectors are inlined
#endif
