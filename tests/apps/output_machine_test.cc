// What a container leaves of a machine, read from trees as Docker, Kubernetes and systemd lay them.
#include "apps/output/machine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/scratch_folder.h"
#include "base/parallel.h"

namespace platen::apps::testing {
namespace {

class GroupLimitsOf : public ScratchFolder {
protected:
  void file(const std::string &path, const std::string &text) {
    fs::create_directories((folder_ / path).parent_path());
    put(folder_ / path, text);
  }
  GroupLimits of(const std::string &groups) const { return group_limits(groups, folder_); }
};

TEST_F(GroupLimitsOf, version_2_gives_the_least_of_a_group_and_those_above) {
  file("cpu.max", "max 100000\n");
  file("pods.slice/cpu.max", "300000 100000\n");
  file("pods.slice/memory.max", "2000000000\n");
  file("pods.slice/job/cpu.max", "max 100000\n");
  file("pods.slice/job/memory.max", "max\n");
  EXPECT_EQ(of("0::/pods.slice/job\n").cores, 3);
  EXPECT_EQ(of("0::/pods.slice/job\n").memory_bytes, 2e9);
  file("pods.slice/job/cpu.max", "150000 100000\n");
  EXPECT_EQ(of("0::/pods.slice/job\n").cores, 1.5);
  EXPECT_TRUE(std::isinf(of("0::/elsewhere\n").cores));
}

// Within its own name space a container is the root.
TEST_F(GroupLimitsOf, a_container_that_sees_itself_as_the_root) {
  file("cpu.max", "200000 100000\n");
  EXPECT_EQ(of("0::/\n").cores, 2);
}

TEST_F(GroupLimitsOf, version_1_by_the_controllers_of_each_line) {
  file("cpu,cpuacct/docker/abc/cpu.cfs_quota_us", "250000\n");
  file("cpu,cpuacct/docker/abc/cpu.cfs_period_us", "50000\n");
  file("memory/docker/abc/memory.limit_in_bytes", "1073741824\n");
  file("memory/memory.limit_in_bytes", "9223372036854771712\n"); // none, as it is written there
  const std::string groups = "5:cpu,cpuacct:/docker/abc\n4:memory:/docker/abc\n3:pids:/docker/abc\n";
  EXPECT_EQ(of(groups).cores, 5);
  EXPECT_EQ(of(groups).memory_bytes, 1073741824);
  file("cpu,cpuacct/docker/abc/cpu.cfs_quota_us", "-1\n");
  EXPECT_TRUE(std::isinf(of(groups).cores));
}

// The path is that of the machine, and the container's own group is mounted as the root.
TEST_F(GroupLimitsOf, version_1_where_the_path_is_not_mounted) {
  file("cpu/cpu.cfs_quota_us", "100000\n");
  file("cpu/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(of("4:cpu,cpuacct:/docker/abc\n").cores, 1);
}

TEST_F(GroupLimitsOf, what_cannot_be_read_is_no_limit) {
  file("cpu.max", "many\n");
  file("memory.max", "");
  for (const char *groups : {"", "0::/\n", "no colon\n", "0::", ":"}) {
    EXPECT_TRUE(std::isinf(of(groups).cores)) << groups;
    EXPECT_TRUE(std::isinf(of(groups).memory_bytes)) << groups;
  }
}

TEST(ThisMachine, has_no_more_cores_than_the_process_may_run_on) {
  EXPECT_GE(this_machine().cores, 1);
  EXPECT_LE(this_machine().cores, hardware_threads());
}

} // namespace
} // namespace platen::apps::testing
