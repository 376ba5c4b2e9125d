// The machine that a run had, for run.log and summary.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace platen::apps {

struct Machine {
  std::string processor;          // model as the system calls it; "unknown" where it does not say
  int cores = 0;                  // that the process may use: by its affinity and its container
  std::uint64_t memory_bytes = 0; // of the machine or of the container; 0 where the system does not say
  std::string system;             // "Linux 6.1.0 x86_64"
};
Machine this_machine();

// What control groups (of a container, a batch job, a service) leave a process; infinite: no limit.
struct GroupLimits {
  double cores = std::numeric_limits<double>::infinity(); // time of all cores over time
  double memory_bytes = std::numeric_limits<double>::infinity();
};
// The least of its groups and of those above them, versions 1 and 2. `groups`: the text of /proc/self/cgroup;
// `root`: where groups are mounted, /sys/fs/cgroup. What cannot be read is no limit.
GroupLimits group_limits(const std::string &groups, const std::filesystem::path &root);

// Largest resident memory of this process until now, bytes.
std::uint64_t peak_memory_bytes();

} // namespace platen::apps
