// The machine that a run had, for run.log and summary.json.
#pragma once

#include <cstdint>
#include <string>

namespace platen::apps {

struct Machine {
  std::string processor;          // model as the system calls it; "unknown" where it does not say
  int cores = 0;                  // that the process may use
  std::uint64_t memory_bytes = 0; // 0 where the system does not say
  std::string system;             // "Linux 6.1.0 x86_64"
};
Machine this_machine();

// Largest resident memory of this process until now, bytes.
std::uint64_t peak_memory_bytes();

} // namespace platen::apps
