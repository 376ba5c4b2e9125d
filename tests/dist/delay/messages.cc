// Messages whose numbers are known: check_counts.cmake compares what the wrapper counted. Argument: the least
// time that the rounds must take on each rank, ms.
#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

// 10 rounds of 100 numbers to the next rank, three calls each.
void go_round(int rank, int ranks) {
  const std::vector<double> out(100, rank);
  std::vector<double> in(100);
  for (int k = 0; k < 10; ++k) {
    MPI_Request both[2];
    MPI_Irecv(in.data(), 100, MPI_DOUBLE, (rank + ranks - 1) % ranks, k, MPI_COMM_WORLD, &both[0]);
    MPI_Isend(out.data(), 100, MPI_DOUBLE, (rank + 1) % ranks, k, MPI_COMM_WORLD, &both[1]);
    MPI_Waitall(2, both, MPI_STATUSES_IGNORE);
  }
}

// Five integers prepared once and sent four times.
void send_prepared(int rank, int ranks) {
  const int out[5] = {};
  int in[5];
  MPI_Request both[2];
  MPI_Recv_init(in, 5, MPI_INT, (rank + ranks - 1) % ranks, 20, MPI_COMM_WORLD, &both[0]);
  MPI_Send_init(out, 5, MPI_INT, (rank + 1) % ranks, 20, MPI_COMM_WORLD, &both[1]);
  for (int k = 0; k < 4; ++k) {
    MPI_Startall(2, both);
    MPI_Waitall(2, both, MPI_STATUSES_IGNORE);
  }
  for (MPI_Request &request : both)
    MPI_Request_free(&request);
}

void collect(int rank, int ranks) {
  double sums[3] = {1, 2, 3};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  int mine = rank, most = 0;
  MPI_Request request;
  MPI_Iallreduce(&mine, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD, &request);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  std::vector<int> counts, firsts, own(static_cast<std::size_t>(rank + 1), rank);
  int total = 0;
  for (int r = 0; r < ranks; ++r) {
    counts.push_back(r + 1);
    firsts.push_back(total);
    total += r + 1;
  }
  std::vector<int> all(static_cast<std::size_t>(total));
  MPI_Allgatherv(own.data(), rank + 1, MPI_INT, all.data(), counts.data(), firsts.data(), MPI_INT,
                 MPI_COMM_WORLD);
}

} // namespace

int main(int argc, char **argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Barrier(MPI_COMM_WORLD); // what stands before MPI_Pcontrol(2) is not counted
  MPI_Pcontrol(2);
  const double before = MPI_Wtime();
  go_round(rank, ranks);
  const double took = 1e3 * (MPI_Wtime() - before), least = argc > 1 ? std::atof(argv[1]) : 0;
  int late = took >= least;
  if (!late) std::printf("rank %d: the rounds took %g ms, not %g\n", rank, took, least);
  send_prepared(rank, ranks);
  double word = 1;
  for (int k = 0; k < 2; ++k) { // two more of rank 0
    if (rank == 0) MPI_Send(&word, 1, MPI_DOUBLE, 1, 30, MPI_COMM_WORLD);
    if (rank == 1) MPI_Recv(&word, 1, MPI_DOUBLE, 0, 30, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }
  collect(rank, ranks);
  MPI_Pcontrol(0);
  MPI_Allreduce(MPI_IN_PLACE, &late, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  MPI_Finalize();
  return late ? 0 : 1;
}
