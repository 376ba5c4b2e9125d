#include <cstdlib>
#include <limits>

#include "apps/output/errors.h"
#include "apps/output/file.h"
#include "apps/output/machine.h"
#include "apps/output/sha256.h"
#include "apps/output/summary.h"
#include "scratch_folder.h"

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
  EXPECT_TRUE(contains(fault(), "no JSON object")) << fault();
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
  EXPECT_TRUE(contains(text, "No space left")) << text;
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

} // namespace
} // namespace platen::apps
