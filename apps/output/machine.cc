#include "apps/output/machine.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "base/parallel.h"

namespace platen::apps {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

// Infinite where there is no such file or no number in it ("max").
double number_in(const std::filesystem::path &file) {
  std::ifstream stream(file);
  double value = 0;
  return stream >> value ? value : no_limit;
}

// "200000 100000": microseconds of cores in a period, of version 2.
double cores_of(const std::filesystem::path &file) {
  std::ifstream stream(file);
  double quota = 0, period = 0;
  return stream >> quota >> period && quota > 0 && period > 0 ? quota / period : no_limit;
}

void lower(GroupLimits &limits, const std::filesystem::path &folder) {
  limits.cores = std::min(limits.cores, cores_of(folder / "cpu.max"));
  const double quota = number_in(folder / "cpu.cfs_quota_us"),
               period = number_in(folder / "cpu.cfs_period_us");
  if (quota > 0 && quota < no_limit && period > 0) limits.cores = std::min(limits.cores, quota / period);
  for (const char *file : {"memory.max", "memory.limit_in_bytes"})
    limits.memory_bytes = std::min(limits.memory_bytes, number_in(folder / file));
}

// The text after "key <blanks>:" in a file of such lines; empty where there is none.
std::string value_of(const char *file, const std::string &key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const auto colon = line.find(':');
    const auto first = colon == std::string::npos ? colon : line.find_first_not_of(" \t", colon + 1);
    if (first != std::string::npos) return line.substr(first);
  }
  return "";
}

} // namespace

GroupLimits group_limits(const std::string &groups, const std::filesystem::path &root) {
  GroupLimits limits;
  std::istringstream lines(groups);
  for (std::string line; std::getline(lines, line);) { // "4:cpu,cpuacct:/path"; of version 2 "0::/path"
    const auto first = line.find(':'), second = first == line.npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    std::vector<std::filesystem::path> mounts{root / controllers};
    if (controllers.empty()) mounts = {root, root / "unified"};
    std::istringstream names(controllers);
    for (std::string name; std::getline(names, name, ',');)
      mounts.push_back(root / name);
    // A container may see its own group as the root alone.
    for (const std::filesystem::path &mount : mounts) {
      std::filesystem::path group = std::filesystem::path(line.substr(second + 1)).relative_path();
      for (; !group.empty(); group = group.parent_path())
        lower(limits, mount / group);
      lower(limits, mount);
    }
  }
  return limits;
}

Machine this_machine() {
  Machine machine;
  machine.processor = value_of("/proc/cpuinfo", "model name");
  if (machine.processor.empty()) machine.processor = "unknown";
  std::ostringstream groups;
  groups << std::ifstream("/proc/self/cgroup").rdbuf();
  const GroupLimits limits = group_limits(groups.str(), "/sys/fs/cgroup");
  // Whole cores: threads wait for each other, and one that is held back holds all.
  machine.cores = static_cast<int>(std::max(1.0, std::min<double>(hardware_threads(), limits.cores)));
  const long pages = sysconf(_SC_PHYS_PAGES), page_bytes = sysconf(_SC_PAGE_SIZE);
  if (pages > 0 && page_bytes > 0)
    machine.memory_bytes = static_cast<std::uint64_t>(
        std::min(static_cast<double>(pages) * static_cast<double>(page_bytes), limits.memory_bytes));
  struct utsname names {};
  if (uname(&names) == 0)
    machine.system = std::string(names.sysname) + " " + names.release + " " + names.machine;
  return machine;
}

std::uint64_t peak_memory_bytes() {
  // Not ru_maxrss of getrusage: that also remembers the process that started this one.
  const std::string kilobytes = value_of("/proc/self/status", "VmHWM");
  return kilobytes.empty() ? 0 : std::stoull(kilobytes) * 1024;
}

} // namespace platen::apps
