// State by name. A part of an experiment describes its data once,
//
//   void describe(Archive &archive) {
//     archive.version(1);
//     archive("pressure", pressure_, "Pa");
//   }
//
// and the same lines write it to a checkpoint and read it back, keep it in memory, list and compare it. Names
// are paths, "experiment/sleeve/pressure". A value that an older state lacks gets a default that is given
// here; without a default the state is refused with the name of the value. The allowed numbers (allowed.h)
// may follow name, value and unit; describe() with looks_at() checks the consistency of blocks.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "base/allowed.h"
#include "base/block_type.h"
#include "base/table.h"

namespace platen {

class StateSource; // state.h

// A state that cannot be read. The message names the block that is missing, has another type or size, or
// contains a number that is not allowed.
class StateError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

class Archive {
public:
  virtual ~Archive() = default;
  Archive(const Archive &) = delete;
  Archive &operator=(const Archive &) = delete;

  // Whether describe() fills the part from a state: derived data must be rebuilt at the end of describe().
  virtual bool reads() const = 0;
  // The state that is about to be read, in the checking pass: describe() is called once for it before the
  // reading pass, changes nothing, and throws StateError where blocks do not match. Otherwise null.
  virtual const StateSource *looks_at() const { return nullptr; }
  bool writes() const { return !reads() && looks_at() == nullptr; }
  // Path in the state of a block of the described part.
  std::string path(const std::string &name) const { return path_ + name; }

  // Version of the described part; the first line of describe(). Returns the version of the state that is
  // read, never above `known`: a newer one is refused with StateError.
  int version(int known);

  // A number, a flag, an array or a struct of numbers (block_type.h).
  template <class T>
  void operator()(const std::string &name, T &value, const std::string &unit = "1") {
    (*this)(name, value, unit, allowed_of<T>());
  }
  template <class T>
  void operator()(const std::string &name, T &value, const std::string &unit, const Allowed &allowed) {
    block(path(name), block_type<T>(unit), {&value, 1, {}}, false, allowed);
  }
  // The same for a value that is not in older states: it is then `lacking`.
  template <class T>
  void operator()(const std::string &name, T &value, const std::string &unit, const T &lacking,
                  const Allowed &allowed = allowed_of<T>()) {
    if (!block(path(name), block_type<T>(unit), {&value, 1, {}}, true, allowed) && reads()) value = lacking;
  }
  void text(const std::string &name, std::string &text);

  // All stored values; `values` is resized.
  template <class T>
  void rows(const std::string &name, std::vector<T> &values, const std::string &unit = "1",
            const Allowed &allowed = {}) {
    const auto resize = [&values](std::size_t n) -> void * {
      values.resize(n);
      return values.data();
    };
    block(path(name), block_type<T>(unit), {values.data(), values.size(), resize}, false, allowed);
  }
  // The size of `values` is fixed; a state with more or fewer is refused.
  template <class T>
  void same_rows(const std::string &name, std::vector<T> &values, const std::string &unit = "1",
                 const Allowed &allowed = {}) {
    block(path(name), block_type<T>(unit), {values.data(), values.size(), {}}, false, allowed);
  }
  // All columns by name. table() takes the stored number of rows, same_table() requires the current one.
  void table(const std::string &name, Table &table);
  void same_table(const std::string &name, Table &table);

  // Calls describe() of another class, under a name of its own.
  template <class Part>
  void part(const std::string &name, Part &part) {
    const Scope scope(*this, name);
    part.describe(*this);
  }

protected:
  Archive() = default;
  struct Rows {
    void *data = nullptr;
    std::size_t count = 0;
    std::function<void *(std::size_t)> resize; // none: the number of rows is fixed
    bool is_local = false;                     // local in describe(): filled in the checking pass, too
  };
  // Writes, checks or fills the rows; false, with no effect, where the state lacks them and `may_lack`.
  virtual bool block(const std::string &path, const BlockType &type, const Rows &rows, bool may_lack,
                     const Allowed &allowed) = 0;

private:
  class Scope {
  public:
    Scope(Archive &archive, const std::string &name) : archive_(archive), length_(archive.path_.size()) {
      archive.path_ += name + "/";
    }
    ~Scope() { archive_.path_.resize(length_); }
    Scope(const Scope &) = delete;
    Scope &operator=(const Scope &) = delete;

  private:
    Archive &archive_;
    std::size_t length_;
  };
  template <class T>
  static Allowed allowed_of() {
    return std::is_same_v<T, bool> ? flag() : Allowed();
  }
  void columns_of(Table &table, bool same_size);

  std::string path_; // of the described part, with a slash at its end
};

} // namespace platen
