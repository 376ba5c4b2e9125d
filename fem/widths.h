// Loops that are compiled for each width of vectors that processors have, of which one is chosen when the
// program starts. Nothing is contracted, so that each gives the same bits. For .cc files.
#pragma once

// GCC on x86-64; the sanitizer of addresses does not start with such choices.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define PLATEN_WIDTHS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define PLATEN_WIDTHS
#endif

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi" // nothing that takes or returns vectors is ever called
#endif
