#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "apps/output/csv_writer.h"
#include "apps/output/errors.h"
#include "apps/output/numbers.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

// While it lives no file of this process grows beyond so many bytes: what a full disk does.
class SmallFiles {
public:
  explicit SmallFiles(std::size_t bytes) : action_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit small{bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    signal(SIGXFSZ, action_);
  }

private:
  rlimit limit_{};
  sighandler_t action_;
};

class Csv : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "history.csv";
  const std::vector<std::string> columns_{"time_s", "axial_stress_top_pa", "mode"};
  // Row k of an imaginary run.
  template <class Table>
  static void write_row(Table &csv, int k) {
    csv.row({1e-7 * k / 3, std::sin(k) * 1e7, k % 2 == 0 ? "tension" : "shear"});
  }
};

TEST_F(Csv, is_a_header_line_and_rows) {
  CsvWriter csv(path_, {"time_s", "intact_bonds", "mode"});
  csv.row({0.5, 12, "tension"});
  csv.row({1.0, std::size_t{3000000000}, std::string("shear")});
  EXPECT_EQ(content_of(path_), "time_s,intact_bonds,mode\n0.5,12,tension\n1,3000000000,shear\n");
}

TEST_F(Csv, shows_each_row_at_once_and_knows_its_length) {
  CsvWriter csv(path_, columns_);
  for (int k = 0; k < 5; ++k) {
    write_row(csv, k);
    EXPECT_EQ(content_of(path_).size(), csv.bytes());
    EXPECT_EQ(content_of(path_).back(), '\n');
  }
}

TEST_F(Csv, numbers_read_back_to_the_same_bits) {
  std::vector<double> values{0.1,
                             1.0 / 3,
                             -0.0,
                             std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::epsilon()};
  std::mt19937_64 random(3);
  while (values.size() < 10000) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) values.push_back(value);
  }
  for (const double value : values) {
    std::string text;
    CsvCell(value).append_to(text);
    const auto back = number_of(text);
    ASSERT_TRUE(back.has_value()) << text;
    EXPECT_EQ(std::memcmp(&*back, &value, sizeof value), 0) << text;
  }
}

TEST_F(Csv, leaves_the_cell_of_what_was_not_measured_empty) {
  CsvWriter csv(path_, {"a", "b"});
  csv.row({std::nan(""), -std::nan("")});
  EXPECT_EQ(content_of(path_), "a,b\n,\n");
}

TEST_F(Csv, quotes_words_that_would_break_the_row) {
  CsvWriter csv(path_, {"a", "b"});
  csv.row({"one, two", "say \"hi\""});
  EXPECT_EQ(content_of(path_), "a,b\n\"one, two\",\"say \"\"hi\"\"\"\n");
}

TEST_F(Csv, refuses_a_row_of_another_length) {
  CsvWriter csv(path_, {"a", "b"});
  EXPECT_THROW(csv.row({1.0}), std::logic_error);
  EXPECT_EQ(content_of(path_), "a,b\n");
}

TEST_F(Csv, of_a_resumed_run_equals_that_of_an_uninterrupted_one) {
  {
    CsvWriter csv(path_, columns_);
    for (int k = 0; k < 20; ++k)
      write_row(csv, k);
  }
  const std::string whole = content_of(path_);
  for (int rows_at_checkpoint = 0; rows_at_checkpoint <= 20; ++rows_at_checkpoint) {
    std::uint64_t length = 0;
    {
      CsvWriter csv(path_, columns_);
      for (int k = 0; k < rows_at_checkpoint; ++k)
        write_row(csv, k);
      length = csv.bytes();
      for (int k = rows_at_checkpoint; k < 17; ++k) // rows after the checkpoint, lost
        write_row(csv, k);
    }
    std::ofstream(path_, std::ios::app) << "0.25,torn"; // where the run was killed
    CsvWriter csv(path_, columns_, length);
    EXPECT_EQ(csv.bytes(), length);
    for (int k = rows_at_checkpoint; k < 20; ++k)
      write_row(csv, k);
    EXPECT_EQ(content_of(path_), whole) << rows_at_checkpoint;
  }
}

TEST_F(Csv, that_another_program_has_changed_takes_no_further_row) {
  const auto refused = [&](const std::function<void()> &meddle, bool by_sync) {
    CsvWriter csv(path_, columns_);
    write_row(csv, 1);
    meddle();
    const std::string said =
        message_of<OutputError>([&] { by_sync ? csv.sync() : static_cast<void>(write_row(csv, 2)); });
    EXPECT_TRUE(contains(said, path_.string() + ": has been "));
    fs::remove(path_);
    return said;
  };
  for (const bool by_sync : {false, true}) {
    EXPECT_TRUE(contains(refused([&] { fs::remove(path_); }, by_sync), "removed"));
    EXPECT_TRUE(contains(refused([&] { fs::resize_file(path_, 3); }, by_sync), "(3 bytes, "));
    EXPECT_TRUE(contains(refused([&] { std::ofstream(path_, std::ios::app) << "0\n"; }, by_sync), "changed"));
    EXPECT_TRUE(contains(refused(
                             [&] {
                               fs::rename(path_, folder_ / "old");
                               fs::copy_file(folder_ / "old", path_);
                             },
                             by_sync),
                         "replaced"));
  }
}

TEST_F(Csv, that_does_not_fit_the_checkpoint_is_refused_and_left_alone) {
  const auto refused = [&](const std::vector<std::string> &columns, std::uint64_t length) {
    return message_of<CheckpointError>([&] { CsvWriter(path_, columns, length); });
  };
  EXPECT_TRUE(contains(refused(columns_, 10), "missing"));
  std::uint64_t length = 0;
  {
    CsvWriter csv(path_, columns_);
    write_row(csv, 1);
    write_row(csv, 2);
    length = csv.bytes();
  }
  const std::string whole = content_of(path_);
  EXPECT_TRUE(contains(refused(columns_, length + 1), "bytes"));
  EXPECT_TRUE(contains(refused({"time_s", "other", "mode"}, length), "header"));
  EXPECT_TRUE(contains(refused(columns_, length - 1), "no row ends"));
  EXPECT_TRUE(contains(refused(columns_, 3), "no row ends"));
  EXPECT_TRUE(contains(refused(columns_, 0), "no row ends"));
  EXPECT_EQ(content_of(path_), whole);
}

TEST_F(Csv, on_a_full_disk_says_so) {
  const std::string text = message_of<OutputError>([&] { CsvWriter("/dev/full", columns_); });
  EXPECT_TRUE(contains(text, "/dev/full") && contains(text, "No space left")) << text;
}

TEST_F(Csv, leaves_no_file_without_a_header) {
  const SmallFiles none(0);
  EXPECT_THROW(CsvWriter(path_, columns_), OutputError);
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(Csv, a_whole_table_is_there_with_all_rows_or_not_at_all) {
  {
    WholeTable table(path_, columns_);
    write_row(table, 1);
    table.finish();
  }
  const std::string before = content_of(path_);
  {
    const SmallFiles limit(before.size() + 5); // five bytes of the second row fit
    WholeTable table(path_, columns_);
    write_row(table, 1);
    EXPECT_EQ(content_of(path_), before);
    EXPECT_THROW(write_row(table, 2), OutputError);
  }
  EXPECT_EQ(content_of(path_), before);
  EXPECT_FALSE(fs::exists(part_path(path_)));
}

TEST_F(Csv, in_no_folder_says_so) {
  const std::string text = message_of<OutputError>([&] { CsvWriter(folder_ / "none" / "a.csv", columns_); });
  EXPECT_TRUE(contains(text, "No such file"));
}

TEST_F(Csv, keeps_whole_rows_where_the_room_ends_within_one) {
  CsvWriter csv(path_, columns_);
  write_row(csv, 1);
  const std::string before = content_of(path_);
  {
    const SmallFiles limit(before.size() + 5); // five bytes of the next row fit
    EXPECT_THROW(write_row(csv, 2), OutputError);
  }
  EXPECT_EQ(content_of(path_), before);
  write_row(csv, 2); // and goes on when there is room again
  EXPECT_EQ(content_of(path_).substr(0, before.size()), before);
  EXPECT_EQ(content_of(path_).size(), csv.bytes());
}

} // namespace
} // namespace platen::apps
