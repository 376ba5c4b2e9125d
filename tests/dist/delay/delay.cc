// Stands between a program and MPI when loaded before it (LD_PRELOAD): puts random delays before messages and
// what waits for them, so that they come in other orders than on a quiet machine, and counts what is sent. A
// program whose results are the same bytes with and without has no race between its messages.
//   PLATEN_DELAY_US         longest delay before a call, microseconds; none: 0
//   PLATEN_DELAY_SEED       another number, other delays; each rank has its own
//   PLATEN_MPI_COUNT_FILE   file that gets a line per rank at MPI_Finalize
// A program may call MPI_Pcontrol(0): count no further, (1): count on, (2): count from nothing again.
// Bytes of a collective are those that a rank gives, however MPI sends them. Calls of one thread at a time.
#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <thread>

namespace {

struct Counts {
  long long messages = 0, bytes = 0, collectives = 0, collective_bytes = 0, delays = 0, delayed_us = 0;
};
constexpr int numbers = sizeof(Counts) / sizeof(long long);

Counts counts;
bool counting = true;
std::map<MPI_Request, long long> persistent; // bytes of what MPI_Send_init prepared

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
  const long long time = static_cast<long long>(next_random() % static_cast<std::uint64_t>(longest + 1));
  ++counts.delays;
  counts.delayed_us += time;
  std::this_thread::sleep_for(std::chrono::microseconds(time));
}

long long bytes_of(long long count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return count * size;
}

void count_message(long long bytes) {
  if (!counting) return;
  ++counts.messages;
  counts.bytes += bytes;
}

int rank_in(MPI_Comm comm) {
  int rank = 0;
  PMPI_Comm_rank(comm, &rank);
  return rank;
}

int size_of(MPI_Comm comm) {
  int size = 1;
  PMPI_Comm_size(comm, &size);
  return size;
}

// A rank alone sends nothing.
void begin_collective(MPI_Comm comm, long long bytes) {
  if (size_of(comm) == 1) return;
  delay();
  if (!counting) return;
  ++counts.collectives;
  counts.collective_bytes += bytes;
}

void start(MPI_Request request) {
  const auto found = persistent.find(request);
  if (found != persistent.end()) count_message(found->second);
}

void write_counts() {
  const char *path = std::getenv("PLATEN_MPI_COUNT_FILE");
  if (!path) return;
  const int rank = rank_in(MPI_COMM_WORLD), ranks = size_of(MPI_COMM_WORLD);
  std::FILE *file = rank == 0 ? std::fopen(path, "w") : nullptr;
  for (int r = 0; r < ranks; ++r) {
    Counts of_rank = counts;
    if (r > 0 && rank == r) PMPI_Send(&counts, numbers, MPI_LONG_LONG, 0, 0, MPI_COMM_WORLD);
    if (rank != 0) continue;
    if (r > 0) PMPI_Recv(&of_rank, numbers, MPI_LONG_LONG, r, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (file)
      std::fprintf(
          file,
          "rank %d of %d: messages %lld bytes %lld collectives %lld collective_bytes %lld delays %lld "
          "delayed_us %lld\n",
          r, ranks, of_rank.messages, of_rank.bytes, of_rank.collectives, of_rank.collective_bytes,
          of_rank.delays, of_rank.delayed_us);
  }
  if (rank == 0 && (!file || std::fclose(file) != 0)) std::fprintf(stderr, "%s: cannot be written\n", path);
}

} // namespace

extern "C" {

int MPI_Pcontrol(const int level, ...) {
  if (level == 2) {
    const long long delays = counts.delays, time = counts.delayed_us;
    counts = {};
    counts.delays = delays;
    counts.delayed_us = time;
  } else {
    counting = level != 0;
  }
  return MPI_SUCCESS;
}

int MPI_Finalize() {
  write_counts();
  return PMPI_Finalize();
}

#define PLATEN_SEND(NAME)                                                                          \
  int MPI_##NAME(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) { \
    delay();                                                                                       \
    count_message(bytes_of(count, type));                                                          \
    return PMPI_##NAME(data, count, type, to, tag, comm);                                          \
  }
#define PLATEN_ISEND(NAME)                                                                       \
  int MPI_##NAME(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, \
                 MPI_Request *request) {                                                         \
    delay();                                                                                     \
    count_message(bytes_of(count, type));                                                        \
    return PMPI_##NAME(data, count, type, to, tag, comm, request);                               \
  }
#define PLATEN_SEND_INIT(NAME)                                                                   \
  int MPI_##NAME(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, \
                 MPI_Request *request) {                                                         \
    const int status = PMPI_##NAME(data, count, type, to, tag, comm, request);                   \
    persistent[*request] = bytes_of(count, type);                                                \
    return status;                                                                               \
  }
PLATEN_SEND(Send)
PLATEN_SEND(Ssend)
PLATEN_ISEND(Isend)
PLATEN_ISEND(Issend)
PLATEN_SEND_INIT(Send_init)
PLATEN_SEND_INIT(Ssend_init)

int MPI_Start(MPI_Request *request) {
  delay();
  start(*request);
  return PMPI_Start(request);
}

int MPI_Startall(int count, MPI_Request requests[]) {
  delay();
  for (int k = 0; k < count; ++k)
    start(requests[k]);
  return PMPI_Startall(count, requests);
}

int MPI_Request_free(MPI_Request *request) {
  persistent.erase(*request);
  return PMPI_Request_free(request);
}

int MPI_Sendrecv(const void *out, int out_count, MPI_Datatype out_type, int to, int out_tag, void *in,
                 int in_count, MPI_Datatype in_type, int from, int in_tag, MPI_Comm comm,
                 MPI_Status *status) {
  delay();
  count_message(bytes_of(out_count, out_type));
  return PMPI_Sendrecv(out, out_count, out_type, to, out_tag, in, in_count, in_type, from, in_tag, comm,
                       status);
}

int MPI_Recv(void *data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status *status) {
  delay();
  return PMPI_Recv(data, count, type, from, tag, comm, status);
}

int MPI_Irecv(void *data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
              MPI_Request *request) {
  delay();
  return PMPI_Irecv(data, count, type, from, tag, comm, request);
}

int MPI_Wait(MPI_Request *request, MPI_Status *status) {
  delay();
  return PMPI_Wait(request, status);
}

int MPI_Waitall(int count, MPI_Request requests[], MPI_Status statuses[]) {
  delay();
  return PMPI_Waitall(count, requests, statuses);
}

int MPI_Waitany(int count, MPI_Request requests[], int *index, MPI_Status *status) {
  delay();
  return PMPI_Waitany(count, requests, index, status);
}

int MPI_Waitsome(int count, MPI_Request requests[], int *done, int indices[], MPI_Status statuses[]) {
  delay();
  return PMPI_Waitsome(count, requests, done, indices, statuses);
}

int MPI_Test(MPI_Request *request, int *flag, MPI_Status *status) {
  delay();
  return PMPI_Test(request, flag, status);
}

int MPI_Testall(int count, MPI_Request requests[], int *flag, MPI_Status statuses[]) {
  delay();
  return PMPI_Testall(count, requests, flag, statuses);
}

int MPI_Barrier(MPI_Comm comm) {
  begin_collective(comm, 0);
  return PMPI_Barrier(comm);
}

int MPI_Bcast(void *data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  begin_collective(comm, rank_in(comm) == root ? bytes_of(count, type) : 0);
  return PMPI_Bcast(data, count, type, root, comm);
}

int MPI_Reduce(const void *out, void *in, int count, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm) {
  begin_collective(comm, bytes_of(count, type));
  return PMPI_Reduce(out, in, count, type, op, root, comm);
}

int MPI_Allreduce(const void *out, void *in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  begin_collective(comm, bytes_of(count, type));
  return PMPI_Allreduce(out, in, count, type, op, comm);
}

int MPI_Iallreduce(const void *out, void *in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm,
                   MPI_Request *request) {
  begin_collective(comm, bytes_of(count, type));
  return PMPI_Iallreduce(out, in, count, type, op, comm, request);
}

int MPI_Gather(const void *out, int out_count, MPI_Datatype out_type, void *in, int in_count,
               MPI_Datatype in_type, int root, MPI_Comm comm) {
  begin_collective(comm, out == MPI_IN_PLACE ? bytes_of(in_count, in_type) : bytes_of(out_count, out_type));
  return PMPI_Gather(out, out_count, out_type, in, in_count, in_type, root, comm);
}

int MPI_Gatherv(const void *out, int out_count, MPI_Datatype out_type, void *in, const int in_counts[],
                const int firsts[], MPI_Datatype in_type, int root, MPI_Comm comm) {
  begin_collective(comm,
                   out == MPI_IN_PLACE ? bytes_of(in_counts[root], in_type) : bytes_of(out_count, out_type));
  return PMPI_Gatherv(out, out_count, out_type, in, in_counts, firsts, in_type, root, comm);
}

int MPI_Allgather(const void *out, int out_count, MPI_Datatype out_type, void *in, int in_count,
                  MPI_Datatype in_type, MPI_Comm comm) {
  begin_collective(comm, out == MPI_IN_PLACE ? bytes_of(in_count, in_type) : bytes_of(out_count, out_type));
  return PMPI_Allgather(out, out_count, out_type, in, in_count, in_type, comm);
}

int MPI_Allgatherv(const void *out, int out_count, MPI_Datatype out_type, void *in, const int in_counts[],
                   const int firsts[], MPI_Datatype in_type, MPI_Comm comm) {
  begin_collective(comm, out == MPI_IN_PLACE ? bytes_of(in_counts[rank_in(comm)], in_type)
                                             : bytes_of(out_count, out_type));
  return PMPI_Allgatherv(out, out_count, out_type, in, in_counts, firsts, in_type, comm);
}

int MPI_Alltoall(const void *out, int out_count, MPI_Datatype out_type, void *in, int in_count,
                 MPI_Datatype in_type, MPI_Comm comm) {
  begin_collective(comm, size_of(comm) * (out == MPI_IN_PLACE ? bytes_of(in_count, in_type)
                                                              : bytes_of(out_count, out_type)));
  return PMPI_Alltoall(out, out_count, out_type, in, in_count, in_type, comm);
}

int MPI_Alltoallv(const void *out, const int out_counts[], const int out_firsts[], MPI_Datatype out_type,
                  void *in, const int in_counts[], const int in_firsts[], MPI_Datatype in_type,
                  MPI_Comm comm) {
  const bool in_place = out == MPI_IN_PLACE;
  long long bytes = 0;
  for (int r = 0; r < size_of(comm); ++r)
    bytes += bytes_of((in_place ? in_counts : out_counts)[r], in_place ? in_type : out_type);
  begin_collective(comm, bytes);
  return PMPI_Alltoallv(out, out_counts, out_firsts, out_type, in, in_counts, in_firsts, in_type, comm);
}

} // extern "C"
