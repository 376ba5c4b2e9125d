#include "dist/spread_checksum.h"

#define XXH_STATIC_LINKING_ONLY // the state's layout, to send it
#include <xxhash.h>

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace platen::dist {
namespace {

constexpr int tag = 6464;
constexpr std::uint64_t least_portion = 1 << 16; // below it a message costs more than the bytes
static_assert(std::is_trivially_copyable_v<XXH64_state_t>, "is sent as bytes");

struct Range {
  std::uint64_t first, last; // bytes of the text
  std::uint64_t length() const { return last - first; }
};

Range common(const Range &a, std::uint64_t offset, std::uint64_t length) {
  const std::uint64_t first = std::max(a.first, offset);
  return {first, std::max(first, std::min(a.last, offset + length))};
}

// A contiguous part of a text that is hashed at once, divided into a portion for each rank.
struct Window {
  std::uint64_t first, portion, end; // of the text
  int ranks;

  Range portion_of(int rank) const {
    const std::uint64_t from = std::min(end, first + portion * static_cast<std::uint64_t>(rank));
    return {from, std::min(end, from + portion)};
  }
  // Number of ranks with a portion: the first ones.
  int in_use() const {
    return static_cast<int>(std::min<std::uint64_t>(ranks, (end - first + portion - 1) / portion));
  }
  bool is_last() const { return end - first <= portion * static_cast<std::uint64_t>(ranks); }
};

// Counts by rank, and the start index of each.
struct Counts {
  std::vector<int> count, first;
  explicit Counts(int ranks) : count(static_cast<std::size_t>(ranks)), first(count.size()) {}
  int sum() { // sets first
    std::exclusive_scan(count.begin(), count.end(), first.begin(), 0);
    return first.back() + count.back();
  }
};

// Data of a rank for hashing a text.
struct Hasher {
  MPI_Comm comm;
  int rank = 0, ranks = 1;
  const std::vector<FileRun> &runs;  // of all ranks
  const std::vector<FilePiece> &own; // of this one, ascending
  XXH64_state_t state;               // valid on one rank at a time: rank 0 at first
};

// Sends this rank's bytes to the ranks whose portions they are in; returns those of its own portion, by rank.
std::vector<char> exchange(const Hasher &h, const Window &window, Counts &in) {
  Counts out(h.ranks);
  std::vector<char> give;
  for (int r = 0; r < h.ranks; ++r)
    for (const FilePiece &piece : h.own) {
      const Range part = common(window.portion_of(r), piece.offset, piece.length);
      const char *bytes = static_cast<const char *>(piece.bytes) + (part.first - piece.offset);
      if (part.length() == 0) continue;
      give.insert(give.end(), bytes, bytes + part.length());
      out.count[static_cast<std::size_t>(r)] += static_cast<int>(part.length());
    }
  out.sum();
  for (const FileRun &run : h.runs)
    in.count[static_cast<std::size_t>(run.rank)] +=
        static_cast<int>(common(window.portion_of(h.rank), run.offset, run.length).length());
  std::vector<char> got(static_cast<std::size_t>(in.sum()));
  MPI_Alltoallv(give.data(), out.count.data(), out.first.data(), MPI_BYTE, got.data(), in.count.data(),
                in.first.data(), MPI_BYTE, h.comm);
  return got;
}

// Continues the hash over this rank's portion: `got` contains the bytes of each rank one after the other.
void add_portion(Hasher &h, const Window &window, const std::vector<char> &got, Counts &in) {
  for (const FileRun &run : h.runs) {
    const Range part = common(window.portion_of(h.rank), run.offset, run.length);
    if (part.length() == 0) continue;
    int &next = in.first[static_cast<std::size_t>(run.rank)];
    XXH64_update(&h.state, got.data() + next, static_cast<std::size_t>(part.length()));
    next += static_cast<int>(part.length());
  }
}

void hash_window(Hasher &h, const Window &window) {
  Counts in(h.ranks);
  const std::vector<char> got = exchange(h, window, in);
  if (h.rank >= window.in_use()) return;
  const bool begins = window.first == 0 && h.rank == 0, ends = h.rank + 1 == window.in_use();
  if (!begins && h.ranks > 1)
    MPI_Recv(&h.state, sizeof h.state, MPI_BYTE, (h.rank + h.ranks - 1) % h.ranks, tag, h.comm,
             MPI_STATUS_IGNORE);
  add_portion(h, window, got, in);
  if (!(ends && window.is_last()) && h.ranks > 1)
    MPI_Send(&h.state, sizeof h.state, MPI_BYTE, (h.rank + 1) % h.ranks, tag, h.comm);
}

// Sends the state back to the first rank, which continues.
void hand_back(Hasher &h, int holder) {
  if (holder == 0) return;
  if (h.rank == holder) MPI_Send(&h.state, sizeof h.state, MPI_BYTE, 0, tag, h.comm);
  if (h.rank == 0) MPI_Recv(&h.state, sizeof h.state, MPI_BYTE, holder, tag, h.comm, MPI_STATUS_IGNORE);
}

void hash_text(Hasher &h, std::uint64_t largest) {
  const std::uint64_t total = h.runs.empty() ? 0 : h.runs.back().offset + h.runs.back().length,
                      ranks = static_cast<std::uint64_t>(h.ranks);
  const std::uint64_t portion = std::min(largest, std::max(least_portion, (total + ranks - 1) / ranks));
  int holder = 0;
  for (std::uint64_t first = 0; first < total; first += portion * ranks) {
    const Window window{first, portion, total, h.ranks};
    hash_window(h, window);
    holder = window.in_use() - 1;
  }
  hand_back(h, holder);
}

std::vector<FilePiece> ascending(std::vector<FilePiece> pieces) {
  std::sort(pieces.begin(), pieces.end(),
            [](const FilePiece &a, const FilePiece &b) { return a.offset < b.offset; });
  return pieces;
}

} // namespace

struct SpreadHash::State {
  XXH64_state_t of_first{}; // kept by rank 0
  int rank = 0, ranks = 1;
};

SpreadHash::SpreadHash(MPI_Comm ranks, std::uint64_t portion)
    : ranks_(ranks), portion_(portion), state_(std::make_unique<State>()) {
  MPI_Comm_rank(ranks, &state_->rank);
  MPI_Comm_size(ranks, &state_->ranks);
  XXH64_reset(&state_->of_first, 0);
}

SpreadHash::~SpreadHash() = default;

void SpreadHash::add(const std::vector<FilePiece> &pieces) {
  const std::vector<FileRun> runs = runs_of_file(ranks_, pieces);
  const std::vector<FilePiece> own = ascending(pieces);
  Hasher hasher{ranks_, state_->rank, state_->ranks, runs, own, state_->of_first};
  hash_text(hasher, portion_);
  state_->of_first = hasher.state;
}

void SpreadHash::add_of_first(const void *bytes, std::size_t count) {
  if (state_->rank == 0 && count > 0) XXH64_update(&state_->of_first, bytes, count);
}

std::uint64_t SpreadHash::value() const {
  std::uint64_t hash = XXH64_digest(&state_->of_first);
  MPI_Bcast(&hash, 1, MPI_UINT64_T, 0, ranks_);
  return hash;
}

std::vector<std::uint64_t> xxh64_of(MPI_Comm ranks, const std::vector<std::vector<FilePiece>> &texts,
                                    std::uint64_t portion) {
  std::vector<std::uint64_t> hashes;
  for (const auto &text : texts) {
    SpreadHash hash(ranks, portion);
    hash.add(text);
    hashes.push_back(hash.value());
  }
  return hashes;
}

} // namespace platen::dist
