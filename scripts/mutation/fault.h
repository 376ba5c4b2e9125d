// Included ahead of every file of a mutated copy of the sources (scripts/mutation.py): one build holds all
// faults, the environment says which of them acts.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace platen::fault {

inline constexpr int most = 1000;
// PLATEN_FAULT, 1 ... most - 1; without it no fault acts.
inline const int acting = [] {
  const char *text = std::getenv("PLATEN_FAULT");
  return text == nullptr ? 0 : std::atoi(text);
}();
// Faults that were come by since somebody looked.
inline volatile unsigned char reached[most] = {};

// A program that a test starts leaves behind what it came by (reached.cc).
struct Reached {
  ~Reached() {
    const char *path = std::getenv("PLATEN_FAULTS_REACHED");
    std::FILE *file = path == nullptr ? nullptr : std::fopen((std::string(path) + ".children").c_str(), "a");
    if (file == nullptr) return;
    for (int number = 0; number < most; ++number)
      if (reached[number]) std::fprintf(file, "%d\n", number);
    std::fclose(file);
  }
};
inline const Reached reached_by_this_program;

inline bool on(int number) {
  if (!reached[number]) reached[number] = 1;
  return number == acting;
}

} // namespace platen::fault
