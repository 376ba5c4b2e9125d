#include "dist/spread_checksum.h"

#include <xxhash.h>

#include <stdexcept>
#include <string>

#include "on_ranks.h"

using namespace platen::dist;
using namespace platen::dist::testing;

namespace {

// Pieces of `length` bytes in turn to the ranks, the first to rank `from`.
std::vector<FilePiece> in_turn(const std::string &text, std::size_t length, int from) {
  std::vector<FilePiece> pieces;
  for (std::size_t k = 0; k * length < text.size(); ++k)
    if ((static_cast<int>(k) + from) % number_of_ranks() == rank_of_this())
      pieces.insert(pieces.begin(),
                    {k * length, text.data() + k * length, std::min(length, text.size() - k * length)});
  return pieces;
}

TEST(SpreadChecksum, is_that_of_one_rank_that_has_all) {
  for (const std::size_t length : {1, 31, 32, 33, 1000, 4096})
    for (const std::size_t piece : {1, 5, 32, 700, 5000})
      for (const std::size_t portion :
           {1, 7, 300, 100000}) {            // smaller than a piece, than a lane, than the text
        if (length / portion > 40) continue; // many messages, nothing new
        const std::string text = text_of(length);
        const auto hashes = xxh64_of(MPI_COMM_WORLD, {in_turn(text, piece, 0)}, portion);
        ASSERT_EQ(hashes.size(), 1u);
        EXPECT_EQ(hashes[0], XXH64(text.data(), text.size(), 0))
            << length << " bytes in pieces of " << piece << ", shares of " << portion;
      }
}

TEST(SpreadChecksum, of_a_long_text_is_shared_out) {
  const std::string text = text_of(3000001); // portions above the least
  const auto hashes = xxh64_of(MPI_COMM_WORLD, {in_turn(text, 12288, 1)});
  EXPECT_EQ(hashes[0], XXH64(text.data(), text.size(), 0));
}

TEST(SpreadChecksum, of_the_empty_text_is_the_known_one) {
  EXPECT_EQ(xxh64_of(MPI_COMM_WORLD, {{}})[0], 0xef46db3751d8e999u); // xxHash specification
  EXPECT_TRUE(xxh64_of(MPI_COMM_WORLD, {}).empty());
}

TEST(SpreadChecksum, of_several_texts_are_told_apart) {
  const std::string one = text_of(500), two = text_of(900), three = text_of(64);
  const auto hashes =
      xxh64_of(MPI_COMM_WORLD, {in_turn(one, 20, 1), in_turn(two, 33, 0), {}, in_turn(three, 64, 2)});
  ASSERT_EQ(hashes.size(), 4u);
  EXPECT_EQ(hashes[0], XXH64(one.data(), one.size(), 0));
  EXPECT_EQ(hashes[1], XXH64(two.data(), two.size(), 0));
  EXPECT_EQ(hashes[2], XXH64("", 0, 0));
  EXPECT_EQ(hashes[3], XXH64(three.data(), three.size(), 0));
}

TEST(SpreadChecksum, changes_with_a_byte_of_any_rank) {
  std::string text = text_of(300);
  const auto before = xxh64_of(MPI_COMM_WORLD, {in_turn(text, 17, 0)});
  for (const std::size_t byte : {0, 20, 299}) {
    text[byte] = static_cast<char>(text[byte] ^ 1);
    const auto after = xxh64_of(MPI_COMM_WORLD, {in_turn(text, 17, 0)});
    EXPECT_NE(after, before) << "byte " << byte;
    text[byte] = static_cast<char>(text[byte] ^ 1);
  }
}

TEST(SpreadChecksum, of_a_text_with_a_gap_is_refused_on_all_ranks) {
  const std::string text = text_of(100);
  std::vector<FilePiece> pieces = in_turn(text, 10, 0);
  if (rank_of_this() == 0) pieces.back().length -= 1; // its first one
  EXPECT_THROW(xxh64_of(MPI_COMM_WORLD, {pieces}), std::invalid_argument);
}

TEST(SpreadChecksum, of_a_text_that_grows_is_that_of_the_whole) {
  for (const std::uint64_t portion : {7, 300, 100000}) {
    const std::string head = text_of(45), first = text_of(1000), middle = text_of(33), last = text_of(700);
    SpreadHash hash(MPI_COMM_WORLD, portion);
    const auto expect = [&](const std::string &all) {
      EXPECT_EQ(hash.value(), XXH64(all.data(), all.size(), 0))
          << all.size() << " bytes, shares of " << portion;
    };
    expect("");
    hash.add_of_first(head.data(), head.size());
    hash.add(in_turn(first, 300, 1));
    expect(head + first);
    hash.add({});
    hash.add_of_first(middle.data(), middle.size());
    hash.add_of_first("", 0);
    expect(head + first + middle);
    hash.add(in_turn(last, 32, 0));
    expect(head + first + middle + last);
  }
}

} // namespace
