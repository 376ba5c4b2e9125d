#include "apps/output/errors.h"
#include "apps/output/specimen_csv.h"
#include "scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class IdList : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "aggregate.txt";
  std::vector<int> read(const std::string &content) const {
    put(path_, content);
    return read_id_list(path_);
  }
  std::string refusal(const std::string &content) const {
    put(path_, content);
    return message_of<InputError>([&] { read_id_list(path_); });
  }
};

TEST_F(IdList, holds_one_number_a_line_between_comments) {
  EXPECT_EQ(read("# large ones\r\n3\n\n  0 # the first\n2147483647"), (std::vector<int>{3, 0, 2147483647}));
  EXPECT_TRUE(read("# none\n").empty());
}

TEST_F(IdList, refuses_what_is_no_id) {
  for (const char *bad : {"1.5", "-1", "1 2", "1,2", "a", "2147483648", "0x1", "+1"}) {
    const std::string message = refusal(std::string("7\n") + bad + "\n");
    EXPECT_TRUE(contains(message, "aggregate.txt:2: error: \"" + std::string(bad) + "\" is no id"))
        << message;
  }
  EXPECT_TRUE(contains(refusal("7\n8\n\n7\n"), "aggregate.txt:4: error: 7 stands in line 1 too"));
  put(path_, "0\n9\n\n10\n");
  EXPECT_EQ(read_id_list(path_, 11).size(), 3u);
  EXPECT_TRUE(
      contains(message_of<InputError>([&] { read_id_list(path_, 10); }),
               "aggregate.txt:4: error: names sphere 10, but the specimen has 10. Allowed: 0 ... 9."));
  EXPECT_TRUE(contains(message_of<InputError>([&] { read_id_list(folder_ / "none"); }), "cannot be read"));
  EXPECT_TRUE(contains(message_of<InputError>([&] { read_id_list(folder_); }), "cannot be read"));
}

} // namespace
} // namespace platen::apps
