// Faults on purpose, each of one rank: must_fail.cmake wants them seen.
#include <stdexcept>

#include "tests/dist/on_ranks.h"

namespace {

const auto rank = platen::dist::testing::rank_of_this;

TEST(Faults, on_rank_1) {
  EXPECT_NE(rank(), 1);
}

TEST(Faults, thrown_on_rank_2) {
  if (rank() == 2) throw std::runtime_error("thrown here");
}

TEST(Faults, rank_0_waits) {
  ASSERT_NE(rank(), 1); // which sends nothing then
  int word = rank();
  if (rank() == 0) MPI_Recv(&word, 1, MPI_INT, 1, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

} // namespace
