// main of tests on several ranks: what fails on one rank fails on all, and is told with the number of the
// rank.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>
#include <sstream>
#include <string>

#include "base/parallel.h"

namespace {

class FailuresOfRank : public testing::EmptyTestEventListener {
public:
  FailuresOfRank(int rank, int ranks) : rank_(rank), ranks_(ranks) {}

private:
  void OnTestStart(const testing::TestInfo &test) override {
    test_ = std::string(test.test_suite_name()) + "." + test.name();
  }
  // At once: other ranks may wait for ever for one that left its test.
  void OnTestPartResult(const testing::TestPartResult &result) override {
    if (!result.failed()) return;
    std::ostringstream text;
    text << "rank " << rank_ << " of " << ranks_ << ": " << test_ << " fails at "
         << (result.file_name() ? result.file_name() : "unknown file") << ":" << result.line_number() << ": "
         << result.summary() << "\n";
    std::fputs(text.str().c_str(), stdout); // in one piece: ranks share the output
    std::fflush(stdout);
  }
  int rank_, ranks_;
  std::string test_ = "what is outside tests";
};

} // namespace

int main(int argc, char **argv) {
  int level = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  testing::InitGoogleTest(&argc, argv);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  auto &listeners = testing::UnitTest::GetInstance()->listeners();
  if (rank != 0) delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new FailuresOfRank(rank, ranks));

  const platen::ThreadLimit one(1); // ranks are more than cores already

  int status = RUN_ALL_TESTS() != 0;
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 0) status = 1; // a filter that fits nothing
  MPI_Allreduce(MPI_IN_PLACE, &status, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return status;
}
