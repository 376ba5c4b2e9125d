// States as named blocks: an Archive writes them to and reads them from memory (State) or a file (a sink and
// a source of the apps). Functions here inspect a state without its owner.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/archive.h"

namespace platen {

struct StoredBlock {
  BlockType type;
  std::size_t rows = 0;
};

class StateSink {
public:
  virtual ~StateSink() = default;
  // Names are unique; one that is given twice throws std::logic_error.
  virtual void add(const std::string &name, const BlockType &type, const void *data, std::size_t rows) = 0;
};

class StateSource {
public:
  virtual ~StateSource() = default;
  virtual std::vector<std::string> names() const = 0;
  virtual std::optional<StoredBlock> find(const std::string &name) const = 0;
  virtual void read(const std::string &name, void *data) const = 0; // all rows of a block that is there
};

class SavingArchive : public Archive {
public:
  explicit SavingArchive(StateSink &sink) : sink_(sink) {}
  bool reads() const override { return false; }

private:
  bool block(const std::string &path, const BlockType &type, const Rows &rows, bool may_lack,
             const Allowed &allowed) override;
  StateSink &sink_;
};

// Checks a state, or reads it; read_parts() runs both passes.
class LoadingArchive : public Archive {
public:
  enum class Pass { look, read };
  LoadingArchive(const StateSource &source, Pass pass) : source_(source), pass_(pass) {}
  bool reads() const override { return pass_ == Pass::read; }
  const StateSource *looks_at() const override { return reads() ? nullptr : &source_; }
  // After all parts: throws StateError where the source contains a block that no part has requested.
  void require_all_requested() const;

private:
  bool block(const std::string &path, const BlockType &type, const Rows &rows, bool may_lack,
             const Allowed &allowed) override;
  const StateSource &source_;
  Pass pass_;
  std::set<std::string> requested_;
};

// Reads all of a source with describe(archive). Throws StateError where the state does not match these parts,
// or where `fits` (called last before reading) throws it: nothing has been changed then.
template <class Describe>
void read_parts(const StateSource &source, const Describe &describe,
                const std::function<void()> &fits = nullptr) {
  LoadingArchive look(source, LoadingArchive::Pass::look), read(source, LoadingArchive::Pass::read);
  describe(look);
  look.require_all_requested();
  if (fits) fits();
  describe(read);
}

// Reads one part of a source that contains others too, as read_parts().
template <class Part>
void read_part(const StateSource &source, const std::string &name, Part &part) {
  LoadingArchive(source, LoadingArchive::Pass::look).part(name, part);
  LoadingArchive(source, LoadingArchive::Pass::read).part(name, part);
}

template <class Part>
void save_part(StateSink &sink, const std::string &name, const Part &part) {
  SavingArchive archive(sink);
  archive.part(name, const_cast<Part &>(part)); // an archive that writes changes nothing
}

// A state in memory.
class State : public StateSink, public StateSource {
public:
  void add(const std::string &name, const BlockType &type, const void *data, std::size_t rows) override;
  std::vector<std::string> names() const override; // in the order in which they were added
  std::optional<StoredBlock> find(const std::string &name) const override;
  void read(const std::string &name, void *data) const override;

private:
  struct Block {
    StoredBlock stored;
    std::vector<char> bytes;
  };
  std::vector<std::string> names_;
  std::map<std::string, Block> blocks_;
};

template <class Part>
State state_of(const Part &part) {
  State state;
  save_part(state, "state", part);
  return state;
}
// Throws StateError where the state does not match the part, which then does not change.
template <class Part>
void set_state(Part &part, const State &state) {
  read_parts(state, [&](Archive &archive) { archive.part("state", part); });
}

// Single blocks, for data that is not a part. The readers throw StateError where the block is missing or has
// another type.
template <class T>
void add_rows(StateSink &sink, const std::string &name, const std::vector<T> &values,
              const std::string &unit = "1") {
  sink.add(name, block_type<T>(unit), values.data(), values.size());
}
void add_text(StateSink &sink, const std::string &name, const std::string &text);
std::string text_of(const StateSource &source, const std::string &name);
// Number of rows of a block, which must have that type.
std::size_t rows_of_type(const StateSource &source, const std::string &name, const BlockType &type);
template <class T>
std::vector<T> rows_of(const StateSource &source, const std::string &name, const std::string &unit = "1") {
  std::vector<T> values(rows_of_type(source, name, block_type<T>(unit)));
  if (!values.empty()) source.read(name, values.data());
  return values;
}

// "\"particles/mass\", row 3: -1. Allowed: finite, > 0 kg." as StateError, for a number that other checks
// have found wrong; `allowed` may be a sentence.
[[noreturn]] void refuse_row(const std::string &name, std::size_t row, const std::string &value,
                             const std::string &allowed);

// Throws StateError where two blocks differ in their number of rows.
void require_as_many(const StateSource &source, const std::string &name, const std::string &other);

// Smallest and largest of all numbers of a block (NaN for text and for no rows), and the number of NaN.
struct BlockRange {
  double least, largest;
  std::size_t not_numbers;
};
BlockRange range_of(const StateSource &source, const std::string &name);

// The first block, in the order of `a`, in which two states differ, with row, number in the row and both
// values. One sentence; none where the states are equal to the last bit.
std::optional<std::string> first_difference(const StateSource &a, const StateSource &b);

} // namespace platen
