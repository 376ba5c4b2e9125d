// Lists of plain values between all ranks.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <numeric>
#include <type_traits>
#include <vector>

namespace platen::dist {

// A datatype of `width` bytes, freed at the end.
class Bytes {
public:
  explicit Bytes(std::size_t width) {
    MPI_Type_contiguous(static_cast<int>(width), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~Bytes() { MPI_Type_free(&type_); }
  Bytes(const Bytes &) = delete;
  Bytes &operator=(const Bytes &) = delete;
  operator MPI_Datatype() const { return type_; }

private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

// Start index of each part.
inline std::vector<int> starts(const std::vector<int> &counts) {
  std::vector<int> at(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, at.begin() + 1);
  return at;
}

// Sends to[r] to rank r; returns the list from each rank.
template <class T>
std::vector<std::vector<T>> exchange_lists(MPI_Comm ranks, const std::vector<std::vector<T>> &to) {
  static_assert(std::is_trivially_copyable_v<T>, "sent as bytes");
  const std::size_t size = to.size();
  std::vector<int> out(size), in(size);
  std::vector<T> sent;
  for (std::size_t r = 0; r < size; ++r) {
    out[r] = static_cast<int>(to[r].size());
    sent.insert(sent.end(), to[r].begin(), to[r].end());
  }
  MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, ranks);
  const std::vector<int> out_at = starts(out), in_at = starts(in);
  std::vector<T> received(static_cast<std::size_t>(in_at.back() + in.back()));
  const Bytes type(sizeof(T));
  MPI_Alltoallv(sent.data(), out.data(), out_at.data(), type, received.data(), in.data(), in_at.data(), type,
                ranks);
  std::vector<std::vector<T>> from(size);
  for (std::size_t r = 0; r < size; ++r)
    from[r].assign(received.begin() + in_at[r], received.begin() + in_at[r] + in[r]);
  return from;
}

// The lists of all ranks, in the order of ranks.
template <class T>
std::vector<T> gather_list_of_all(MPI_Comm ranks, const std::vector<T> &own) {
  static_assert(std::is_trivially_copyable_v<T>, "sent as bytes");
  int size = 1;
  MPI_Comm_size(ranks, &size);
  std::vector<int> counts(static_cast<std::size_t>(size));
  const int count = static_cast<int>(own.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, ranks);
  const std::vector<int> at = starts(counts);
  std::vector<T> all(static_cast<std::size_t>(at.back() + counts.back()));
  const Bytes type(sizeof(T));
  MPI_Allgatherv(own.data(), count, type, all.data(), counts.data(), at.data(), type, ranks);
  return all;
}

} // namespace platen::dist
