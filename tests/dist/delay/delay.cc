// Stands between a program and MPI when loaded before it (LD_PRELOAD): puts random delays before messages and
// what waits for them, so that they come in other orders than on a quiet machine. A program whose results are
// the same bytes with and without has no race between its messages.
//   PLATEN_DELAY_US     longest delay before a call, microseconds; none: 0
//   PLATEN_DELAY_SEED   another number, other delays; each rank has its own
//   PLATEN_DELAY_FILE   file that gets a line per rank at MPI_Finalize: how many delays, how long in all
// Calls of one thread at a time.
#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace {

long long told[2] = {0, 0}; // delays, microseconds

long long number_from(const char *name) {
  const char *text = std::getenv(name);
  return text ? std::atoll(text) : 0;
}

std::uint64_t first_state() {
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return static_cast<std::uint64_t>(number_from("PLATEN_DELAY_SEED")) * 1000003u +
         static_cast<std::uint64_t>(rank);
}

// splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t next_random() {
  static std::uint64_t state = first_state();
  std::uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

void delay() {
  static const long long longest = number_from("PLATEN_DELAY_US");
  if (longest <= 0) return;
  const auto time = static_cast<long long>(next_random() % static_cast<std::uint64_t>(longest + 1));
  ++told[0], told[1] += time;
  std::this_thread::sleep_for(std::chrono::microseconds(time));
}

void tell() {
  const char *path = std::getenv("PLATEN_DELAY_FILE");
  if (!path) return;
  int rank = 0, ranks = 1;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  PMPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (rank > 0) PMPI_Send(told, 2, MPI_LONG_LONG, 0, 0, MPI_COMM_WORLD);
  if (rank > 0) return;
  std::FILE *file = std::fopen(path, "w");
  for (int r = 0; r < ranks; ++r) {
    if (r > 0) PMPI_Recv(told, 2, MPI_LONG_LONG, r, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (file) std::fprintf(file, "rank %d of %d: delays %lld delayed_us %lld\n", r, ranks, told[0], told[1]);
  }
  if (!file || std::fclose(file) != 0) std::fprintf(stderr, "%s: cannot be written\n", path);
}

} // namespace

// The calls of this project and of the libraries that it uses between ranks.
#define PLATEN_DELAYED(NAME, PARAMETERS, ARGUMENTS) \
  int MPI_##NAME PARAMETERS {                       \
    delay();                                        \
    return PMPI_##NAME ARGUMENTS;                   \
  }
#define PLATEN_SEND(NAME)                                                                                \
  PLATEN_DELAYED(NAME, (const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm), \
                 (data, count, type, to, tag, comm))
#define PLATEN_ISEND(NAME)                                                                        \
  PLATEN_DELAYED(NAME,                                                                            \
                 (const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, \
                  MPI_Request *request),                                                          \
                 (data, count, type, to, tag, comm, request))

extern "C" {

int MPI_Finalize() {
  tell();
  return PMPI_Finalize();
}

PLATEN_SEND(Send)
PLATEN_SEND(Ssend)
PLATEN_ISEND(Isend)
PLATEN_ISEND(Issend)
PLATEN_DELAYED(Recv,
               (void *data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
                MPI_Status *status),
               (data, count, type, from, tag, comm, status))
PLATEN_DELAYED(Irecv,
               (void *data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
                MPI_Request *request),
               (data, count, type, from, tag, comm, request))
PLATEN_DELAYED(Start, (MPI_Request * request), (request))
PLATEN_DELAYED(Startall, (int count, MPI_Request requests[]), (count, requests))
PLATEN_DELAYED(Wait, (MPI_Request * request, MPI_Status *status), (request, status))
PLATEN_DELAYED(Waitall, (int count, MPI_Request requests[], MPI_Status statuses[]),
               (count, requests, statuses))
PLATEN_DELAYED(Waitany, (int count, MPI_Request requests[], int *index, MPI_Status *status),
               (count, requests, index, status))
PLATEN_DELAYED(Waitsome, (int count, MPI_Request requests[], int *done, int indices[], MPI_Status statuses[]),
               (count, requests, done, indices, statuses))
PLATEN_DELAYED(Test, (MPI_Request * request, int *flag, MPI_Status *status), (request, flag, status))
PLATEN_DELAYED(Testall, (int count, MPI_Request requests[], int *flag, MPI_Status statuses[]),
               (count, requests, flag, statuses))
PLATEN_DELAYED(Barrier, (MPI_Comm comm), (comm))
PLATEN_DELAYED(Bcast, (void *data, int count, MPI_Datatype type, int root, MPI_Comm comm),
               (data, count, type, root, comm))
PLATEN_DELAYED(Allreduce, (const void *out, void *in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm),
               (out, in, count, type, op, comm))
PLATEN_DELAYED(Iallreduce,
               (const void *out, void *in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm,
                MPI_Request *request),
               (out, in, count, type, op, comm, request))
PLATEN_DELAYED(Allgather,
               (const void *out, int out_count, MPI_Datatype out_type, void *in, int in_count,
                MPI_Datatype in_type, MPI_Comm comm),
               (out, out_count, out_type, in, in_count, in_type, comm))
PLATEN_DELAYED(Allgatherv,
               (const void *out, int out_count, MPI_Datatype out_type, void *in, const int in_counts[],
                const int firsts[], MPI_Datatype in_type, MPI_Comm comm),
               (out, out_count, out_type, in, in_counts, firsts, in_type, comm))

} // extern "C"
