// summary.json, figures over seeds, and what a container leaves of a machine: read from trees as Docker,
// Kubernetes and systemd lay them.
#include <cmath>
#include <cstdlib>
#include <limits>

#include "apps/output/errors.h"
#include "apps/output/file.h"
#include "apps/output/machine.h"
#include "apps/output/seed_statistics.h"
#include "apps/output/sha256.h"
#include "apps/output/summary.h"
#include "apps/scratch_folder.h"
#include "base/parallel.h"

namespace platen::apps {
namespace {

using namespace testing;

// Of a file all of it, or what it begins with.
class SumOfFile : public ScratchFolder {};

TEST_F(SumOfFile, is_that_of_its_text) {
  const std::string text(200000, 'c'); // more than is read at a time
  put(folder_ / "file", text);
  EXPECT_EQ(sha256_of_file(folder_ / "file"), sha256_of(text));
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, std::size_t{65536}, text.size()})
    EXPECT_EQ(sha256_of_file(folder_ / "file", bytes), sha256_of(text.substr(0, bytes))) << bytes;
  EXPECT_EQ(sha256_of_file(folder_ / "none"), std::nullopt);
  EXPECT_EQ(sha256_of_file(folder_), std::nullopt);
}

class Summary : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "summary.json";
};

TEST_F(Summary, keeps_keys_in_order_and_numbers_to_the_bit) {
  Json summary;
  summary["status"] = "done";
  summary["app"] = "platen-compress";
  summary["strength_pa"] = 1e8 / 3;
  summary["effects"] = {"parallel bond", "coulomb"};
  summary["stage_seconds"]["bonds"] = 0.1;
  write_summary(path_, summary);
  const Json back = Json::parse(content_of(path_));
  EXPECT_EQ(back, summary);
  EXPECT_EQ(back["strength_pa"].get<double>(), 1e8 / 3);
  std::vector<std::string> keys;
  for (const auto &[key, value] : back.items())
    keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"status", "app", "strength_pa", "effects", "stage_seconds"}));
}

// Digests of FIPS 180-4's examples and of lengths around a block, by coreutils' sha256sum.
TEST(Sha256, is_that_of_the_standard) {
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_of(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256_of(std::string(63, 'b')),
            "94e419fabac7f930810f9636354042f8c1426d2f834d4ab65c93dc1e69326b13");
}

TEST_F(Summary, that_is_cut_off_is_none) {
  write_summary(path_, {{"status", "done"}, {"strength_pa", 4.25e7}, {"broken_tension", 7}});
  const std::string whole = content_of(path_);
  EXPECT_EQ(read_summary(path_).fault, "");
  EXPECT_EQ(number_in(read_summary(path_).summary, "strength_pa"), 4.25e7);
  for (std::size_t k = 0; k + 2 < whole.size(); ++k) { // without its brace
    put(path_, whole.substr(0, k));
    EXPECT_NE(read_summary(path_).fault, "") << k << " bytes";
  }
}

TEST_F(Summary, that_is_none_says_why) {
  const auto fault = [&] { return read_summary(path_).fault; };
  EXPECT_EQ(fault(), "is missing");
  fs::create_directory(path_);
  EXPECT_EQ(fault(), "is no file");
  fs::remove(path_);
  put(path_, "[1, 2]");
  EXPECT_TRUE(contains(fault(), "no JSON object"));
  put(path_, "{\"status\": \"done\"}");
  EXPECT_EQ(fault(), "");
}

TEST_F(Summary, says_null_for_what_was_not_measured) {
  Json summary;
  summary["poisson_ratio"] = std::numeric_limits<double>::quiet_NaN();
  summary["rate"] = std::numeric_limits<double>::infinity();
  summary["cone_top"] = nullptr;
  write_summary(path_, summary);
  const Json back = Json::parse(content_of(path_));
  for (const char *key : {"poisson_ratio", "rate", "cone_top"})
    EXPECT_TRUE(back[key].is_null()) << key;
}

TEST_F(Summary, is_whole_even_with_text_that_is_not) {
  Json summary;
  summary["scene"] = "caf\xe9"; // Latin-1
  write_summary(path_, summary);
  EXPECT_EQ(Json::parse(content_of(path_))["scene"], "caf\xef\xbf\xbd");
}

TEST_F(Summary, on_a_full_disk_leaves_the_former_one) {
  write_summary(path_, {{"status", "done"}});
  const std::string before = content_of(path_);
  fs::create_symlink("/dev/full", part_path(path_));
  const std::string text = message_of<OutputError>([&] { write_summary(path_, {{"status", "failed"}}); });
  EXPECT_TRUE(contains(text, "No space left"));
  EXPECT_EQ(content_of(path_), before);
  EXPECT_FALSE(fs::exists(fs::symlink_status(part_path(path_))));
}

TEST_F(Summary, memory_at_its_peak_covers_what_was_in_use) {
  const std::uint64_t before = peak_memory_bytes();
  const std::size_t block = std::size_t{64} << 20;
  {
    std::vector<char> used(block + before, 1); // every page is touched
    EXPECT_EQ(used[block], 1);
  }
  EXPECT_GE(peak_memory_bytes(), before + block);
  EXPECT_GT(this_machine().cores, 0);
  EXPECT_GT(this_machine().memory_bytes, peak_memory_bytes());
}

TEST(SeedStatistics, are_those_of_a_sample_that_is_known) {
  SeedStatistics s;
  for (const double v : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0})
    s.add(v);
  EXPECT_EQ(s.count(), 8u);
  EXPECT_DOUBLE_EQ(s.mean(), 5);
  EXPECT_DOUBLE_EQ(s.deviation(), std::sqrt(32.0 / 7));    // of the sample: over n - 1
  EXPECT_DOUBLE_EQ(s.root_mean_square(), std::sqrt(29.0)); // 25 + 32/8: square of the mean and variance
  EXPECT_EQ(text_of(s, 1), "5 +- 2.1");
  EXPECT_EQ(text_of(s, 10), "0.5 +- 0.21");
}

TEST(SeedStatistics, leave_out_what_was_not_measured) {
  SeedStatistics s;
  EXPECT_TRUE(std::isnan(s.mean()));
  EXPECT_TRUE(std::isnan(s.root_mean_square()));
  EXPECT_EQ(text_of(s, 1), "-");
  s.add(std::numeric_limits<double>::quiet_NaN());
  s.add(3);
  EXPECT_EQ(s.count(), 1u);
  EXPECT_EQ(s.mean(), 3);
  EXPECT_TRUE(std::isnan(s.deviation()));
  EXPECT_EQ(text_of(s, 1), "3, 1 packing");
}

// A deviation of few is a guess that looks like knowledge: two that agree by chance would tell "+- 0.0".
TEST(SeedStatistics, of_fewer_than_five_the_range_is_told_and_how_many) {
  SeedStatistics s;
  EXPECT_TRUE(std::isnan(s.least()));
  EXPECT_TRUE(std::isnan(s.largest()));
  s.add(41.5e6), s.add(41.4e6);
  EXPECT_EQ(text_of(s, 1e6), "41.4 ... 41.5, 2 packings");
  EXPECT_EQ(short_text_of(s, 1e6), "41.4 ... 41.5");
  s.add(43e6), s.add(40e6);
  EXPECT_EQ(s.least(), 40e6);
  EXPECT_EQ(s.largest(), 43e6);
  EXPECT_EQ(text_of(s, 1e6), "40 ... 43, 4 packings");
  s.add(41.5e6);
  EXPECT_EQ(text_of(s, 1e6), "41.48 +- 1.1");
  EXPECT_EQ(short_text_of(s, 1e6), text_of(s, 1e6));
}

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
} // namespace platen::apps
