#include "dist/rank_file.h"

#include <stdexcept>
#include <vector>

#include "on_ranks.h"

using namespace platen;
using namespace platen::dist;
using namespace platen::dist::testing;
namespace fs = std::filesystem;

namespace {

class RankFile : public dist::testing::WithFolder {
protected:
  void SetUp() override {
    WithFolder::SetUp();
    path_ = (folder_ / "state.platen").string();
  }
  std::string path_;
};

// Stretches of unlike lengths in turn to the ranks, by a rule that all know; given in descending order.
std::vector<FilePiece> pieces_of(const std::string &text, std::size_t shortest) {
  std::vector<FilePiece> pieces;
  std::size_t offset = 0;
  for (std::size_t k = 0; offset < text.size(); ++k) {
    const std::size_t length = std::min(text.size() - offset, shortest * (1 + k % 3));
    if (static_cast<int>((k * 5 + k / 7) % static_cast<std::size_t>(number_of_ranks())) == rank_of_this())
      pieces.insert(pieces.begin(), FilePiece{offset, text.data() + offset, length});
    offset += length;
  }
  return pieces;
}

// What write_rank_file throws on every rank; empty where it does not.
std::string error_of(const std::string &path, const std::vector<FilePiece> &pieces) {
  try {
    write_rank_file(MPI_COMM_WORLD, path, pieces);
  } catch (const std::runtime_error &error) {
    return error.what();
  }
  return "";
}

void expect_on_all_ranks(const std::string &text, const std::string &path, const std::string &reason,
                         const std::string &rank) {
  EXPECT_EQ(text.rfind(path + ": ", 0), 0u) << text;
  EXPECT_NE(text.find(reason), std::string::npos) << text;
  EXPECT_NE(text.find(rank), std::string::npos) << text;
}

TEST_F(RankFile, is_the_same_bytes_as_one_rank_would_write) {
  for (const std::size_t length : {1, 7, 1000, 300000}) {
    const std::string text = text_of(length);
    write_rank_file(MPI_COMM_WORLD, path_, pieces_of(text, 1 + length / 50));
    EXPECT_TRUE(bytes_in(path_) == text) << length << " bytes, " << bytes_in(path_).size() << " in the file";
    MPI_Barrier(MPI_COMM_WORLD); // before the next one replaces it
  }
}

TEST_F(RankFile, replaces_a_longer_one) {
  const std::string longer = text_of(5000), shorter(2000, 'x');
  write_rank_file(MPI_COMM_WORLD, path_, pieces_of(longer, 100));
  write_rank_file(MPI_COMM_WORLD, path_, pieces_of(shorter, 100));
  EXPECT_TRUE(bytes_in(path_) == shorter) << bytes_in(path_).size() << " bytes";
}

TEST_F(RankFile, takes_large_pieces_in_several_calls) {
  const std::string text = text_of(10007);
  for (const std::uint64_t at_once : {1, 64, 999}) {
    if (at_once == 1 && number_of_ranks() > 3) continue; // ten thousand calls
    write_rank_file(MPI_COMM_WORLD, path_, pieces_of(text, 3000), at_once);
    EXPECT_TRUE(bytes_in(path_) == text) << at_once << " at once";
    MPI_Barrier(MPI_COMM_WORLD);
  }
}

TEST_F(RankFile, of_one_rank_alone_and_of_no_bytes) {
  const std::string text = text_of(400);
  const bool last = rank_of_this() == number_of_ranks() - 1;
  write_rank_file(MPI_COMM_WORLD, path_,
                  last ? std::vector<FilePiece>{{0, text.data(), 400}} : std::vector<FilePiece>{});
  EXPECT_TRUE(bytes_in(path_) == text);
  MPI_Barrier(MPI_COMM_WORLD);
  write_rank_file(MPI_COMM_WORLD, path_, {});
  EXPECT_TRUE(fs::exists(path_) && fs::file_size(path_) == 0);
}

TEST_F(RankFile, that_cannot_be_opened_is_told_on_all_ranks) {
  const std::string text = text_of(100);
  const std::string nowhere = (folder_ / "none" / "state.platen").string();
  expect_on_all_ranks(error_of(nowhere, pieces_of(text, 10)), nowhere, "No such file or directory",
                      "(rank 0)");
  expect_on_all_ranks(error_of(folder_.string(), pieces_of(text, 10)), folder_.string(), "cannot be opened",
                      "(rank 0)");
}

TEST_F(RankFile, on_a_full_disk_is_told_on_all_ranks) {
  const std::string text = text_of(100);
  const std::string error = error_of("/dev/full", pieces_of(text, 10));
  EXPECT_EQ(error.rfind("/dev/full: cannot be written: ", 0), 0u) << error;
}

// The last rank alone may write no more than 40 bytes into a file.
TEST_F(RankFile, that_one_rank_cannot_write_is_told_on_all_ranks) {
  const int last = number_of_ranks() - 1;
  const std::string text = text_of(1000);
  const std::uint64_t each = 1000 / static_cast<std::uint64_t>(number_of_ranks());
  const std::uint64_t from = each * static_cast<std::uint64_t>(rank_of_this());
  const std::vector<FilePiece> pieces = {
      {from, text.data() + from, rank_of_this() == last ? 1000 - from : each}};
  std::string error;
  with_small_files(last, from + 40, [&] { error = error_of(path_, pieces); });
  expect_on_all_ranks(error, path_, "cannot be written: File too large",
                      "(rank " + std::to_string(last) + ")");
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(error_of(path_, pieces), ""); // and goes well when there is room again
  EXPECT_TRUE(bytes_in(path_) == text);
}

TEST_F(RankFile, with_a_gap_or_an_overlap_is_refused_on_all_ranks) {
  const std::string text = text_of(300);
  std::vector<FilePiece> gap = pieces_of(text, 10), twice = gap, late = gap;
  if (rank_of_this() == number_of_ranks() - 1) {
    gap.pop_back();
    twice.push_back(twice.front());
    if (!late.empty()) late.back().offset += 1;
  }
  EXPECT_THROW(write_rank_file(MPI_COMM_WORLD, path_, gap), std::invalid_argument);
  EXPECT_THROW(write_rank_file(MPI_COMM_WORLD, path_, twice), std::invalid_argument);
  EXPECT_THROW(write_rank_file(MPI_COMM_WORLD, path_, late), std::invalid_argument);
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(RankFile, runs_are_told_alike_and_neighbours_are_joined) {
  const std::string text = text_of(60);
  // Rank r holds bytes 10 r ... 10 r + 10 in two pieces; the last one all that is left.
  const std::uint64_t r = static_cast<std::uint64_t>(rank_of_this()), last = number_of_ranks() - 1;
  if (last > 4) GTEST_SKIP() << "sixty bytes";
  const std::uint64_t end = r == last ? 60 : 10 * r + 10;
  const auto runs =
      runs_of_file(MPI_COMM_WORLD, {{10 * r + 5, text.data(), end - 10 * r - 5}, {10 * r, text.data(), 5}});
  ASSERT_EQ(runs.size(), last + 1);
  for (std::uint64_t k = 0; k <= last; ++k) {
    EXPECT_EQ(runs[k].offset, 10 * k);
    EXPECT_EQ(runs[k].length, k == last ? 60 - 10 * k : 10);
    EXPECT_EQ(runs[k].rank, static_cast<int>(k));
  }
}

} // namespace
