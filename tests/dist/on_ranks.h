// What tests on several ranks share: who they are, a folder for all of them, a limit of one rank's files.
#pragma once

#include <gtest/gtest.h>
#include <mpi.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace platen::dist::testing {

inline int rank_of_this() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

inline int number_of_ranks() {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

// The same bytes on every rank.
inline std::string text_of(std::size_t length) {
  std::string text(length, ' ');
  unsigned state = static_cast<unsigned>(length) + 3;
  for (char &c : text)
    c = static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
  return text;
}

inline std::string bytes_in(const std::filesystem::path &path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A folder that all ranks share, gone at the end.
class WithFolder : public ::testing::Test {
protected:
  void SetUp() override {
    int number = static_cast<int>(::getpid());
    MPI_Bcast(&number, 1, MPI_INT, 0, MPI_COMM_WORLD);
    folder_ = std::filesystem::temp_directory_path() / ("platen_ranks_" + std::to_string(number));
    if (rank_of_this() == 0) std::filesystem::create_directories(folder_);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  void TearDown() override {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank_of_this() == 0) std::filesystem::remove_all(folder_);
  }
  std::filesystem::path folder_;
};

// Does something while that rank may write no byte beyond the given one of a file.
template <class Act>
void with_small_files(int rank, std::uint64_t bytes, const Act &act) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank_of_this() == rank) {
    const rlimit small{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  act();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
}

} // namespace platen::dist::testing
