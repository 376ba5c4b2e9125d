// Rounds of messages that delays must lengthen. Arguments: the least and the largest time that they may take
// on each rank, ms.
#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char **argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Barrier(MPI_COMM_WORLD);
  const double before = MPI_Wtime();
  // Ten of 100 numbers to the next rank, three calls each.
  const std::vector<double> out(100, rank);
  std::vector<double> in(100);
  for (int k = 0; k < 10; ++k) {
    MPI_Request both[2];
    MPI_Irecv(in.data(), 100, MPI_DOUBLE, (rank + ranks - 1) % ranks, k, MPI_COMM_WORLD, &both[0]);
    MPI_Isend(out.data(), 100, MPI_DOUBLE, (rank + 1) % ranks, k, MPI_COMM_WORLD, &both[1]);
    MPI_Waitall(2, both, MPI_STATUSES_IGNORE);
  }
  const double took = 1e3 * (MPI_Wtime() - before);
  int fine = argc == 2 && took >= std::atof(argv[1]);
  if (!fine) std::printf("rank %d: the rounds took %g ms\n", rank, took);
  MPI_Allreduce(MPI_IN_PLACE, &fine, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  MPI_Finalize();
  return fine ? 0 : 1;
}
