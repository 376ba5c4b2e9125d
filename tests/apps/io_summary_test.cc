#include <cstdlib>
#include <limits>

#include "apps/io/errors.h"
#include "apps/io/file.h"
#include "apps/io/machine.h"
#include "apps/io/sha256.h"
#include "apps/io/summary.h"
#include "io_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

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
  Json back = Json::parse(content_of(path_));
  EXPECT_EQ(back.back(), back["checksum"]); // the last key
  back.erase("checksum");
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
  const std::string bytes(300, 'b');
  for (std::size_t length = 0; length <= bytes.size(); ++length) { // in two parts as at once
    Sha256 parts;
    parts.update(std::string_view(bytes).substr(0, length / 3));
    parts.text(); // is of what was given until then, and ends nothing
    parts.update(std::string_view(bytes).substr(length / 3, length - length / 3));
    EXPECT_EQ(parts.text(), sha256_of(std::string_view(bytes).substr(0, length))) << length;
  }
}

TEST_F(Summary, is_verified_by_two_commands) {
  write_summary(path_, {{"status", "done"}, {"cone", {{"checksum", "of a cone"}, {"height_m", 0.1}}}});
  const fs::path said = folder_ / "said";
  const std::string command =
      "grep -v '^  \"checksum\":' '" + path_.string() + "' | sha256sum > '" + said.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(content_of(said).substr(0, 64), text_in(Json::parse(content_of(path_)), "checksum"));
}

TEST_F(Summary, that_has_lost_or_changed_a_byte_is_not_as_it_was_written) {
  const Json summary{{"status", "done"}, {"strength_pa", 4.25e7}, {"broken_tension", 7}};
  write_summary(path_, summary);
  const std::string whole = content_of(path_);
  EXPECT_EQ(read_summary(path_).fault, "");
  EXPECT_EQ(number_in(read_summary(path_).summary, "strength_pa"), 4.25e7);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    std::string other = whole;
    other[k] = static_cast<char>(other[k] ^ 1);
    put(path_, other);
    EXPECT_NE(read_summary(path_).fault, "") << other;
    put(path_, whole.substr(0, k));
    EXPECT_NE(read_summary(path_).fault, "") << k << " bytes";
  }
  put(path_, whole);
  EXPECT_EQ(read_summary(path_).fault, "");
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
  EXPECT_TRUE(contains(fault(), "has no checksum")) << fault();
  EXPECT_FALSE(read_summary(path_).changed);
  put(path_, "{\"status\": \"done\",\n  \"checksum\": \"00\"\n}\n");
  EXPECT_TRUE(contains(fault(), "checksum does not hold")) << fault();
  EXPECT_TRUE(read_summary(path_).changed);
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

class StreamAside : public ScratchFolder {};

TEST_F(StreamAside, is_whole_or_not_there) {
  const fs::path path = folder_ / "platens.vtu";
  write_stream_aside(path, [](std::ostream &out) { out << "whole"; });
  EXPECT_EQ(content_of(path), "whole");
  EXPECT_THROW(write_stream_aside(path,
                                  [](std::ostream &out) {
                                    out << "half";
                                    throw std::domain_error("body");
                                  }),
               std::domain_error);
  EXPECT_EQ(content_of(path), "whole");
  for (const std::size_t length : {std::size_t{1}, std::size_t{1000000}}) { // buffered, and not
    fs::create_symlink("/dev/full", part_path(path));
    const std::string text = message_of<OutputError>(
        [&] { write_stream_aside(path, [&](std::ostream &out) { out << std::string(length, 'x'); }); });
    EXPECT_TRUE(contains(text, "No space left")) << text;
    EXPECT_EQ(content_of(path), "whole");
  }
  // Nor do words of a writer that looks at its stream reach the user.
  fs::create_symlink("/dev/full", part_path(path));
  const auto looks = [](std::ostream &out) {
    if (!(out << std::string(1000000, 'x')).flush()) throw std::domain_error("an input/output error");
  };
  const std::string text = message_of<OutputError>([&] { write_stream_aside(path, looks); });
  EXPECT_TRUE(contains(text, "No space left")) << text;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

} // namespace
} // namespace platen::apps
