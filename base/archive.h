// State by name. A part of an experiment describes once what it holds,
//
//   void describe(Archive &archive) {
//     archive.version(1);
//     archive("pressure", pressure_, "Pa");
//   }
//
// and the same lines write it to a checkpoint and read it back, keep it in memory, list and compare it. Names
// are paths, "experiment/sleeve/pressure". What an older state lacks has a value that is stated here, or the
// state is refused by the name of what it lacks. After name, value and unit may stand what its numbers can be
// (allowed.h); what goes together with other blocks is asked in describe() of looks_at().
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

// A state that cannot be read: what it lacks, what is of another kind or size, or holds a number that cannot
// be, by name.
class StateError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

class Archive {
public:
  virtual ~Archive() = default;
  Archive(const Archive &) = delete;
  Archive &operator=(const Archive &) = delete;

  // Whether describe() fills the part from a state: what is derived from it has to be made anew at its end.
  virtual bool reads() const = 0;
  // The state that is about to be read, while it is only looked at: describe() is called once for that before
  // it is called to read, changes nothing, and throws StateError where blocks do not go together. Else null.
  virtual const StateSource *looks_at() const { return nullptr; }
  bool writes() const { return !reads() && looks_at() == nullptr; }
  // In the state, of a block of the part that is described.
  std::string path(const std::string &name) const { return path_ + name; }

  // Of the part that is described; the first line of describe(). Returns the version of the state that is
  // read, never above `known`: a newer one is refused with StateError.
  int version(int known);

  // A number, an array or a struct of numbers (block_type.h); flags too.
  template <class T>
  void operator()(const std::string &name, T &value, const std::string &unit = "1") {
    (*this)(name, value, unit, allowed_of<T>());
  }
  template <class T>
  void operator()(const std::string &name, T &value, const std::string &unit, const Allowed &allowed) {
    block(path(name), block_type<T>(unit), {&value, 1, {}}, false, allowed);
  }
  // The same of what states lack that were written before it was added: it is then `lacking`.
  template <class T>
  void operator()(const std::string &name, T &value, const std::string &unit, const T &lacking,
                  const Allowed &allowed = allowed_of<T>()) {
    if (!block(path(name), block_type<T>(unit), {&value, 1, {}}, true, allowed) && reads()) value = lacking;
  }
  void text(const std::string &name, std::string &text);

  // As many values as were stored.
  template <class T>
  void rows(const std::string &name, std::vector<T> &values, const std::string &unit = "1",
            const Allowed &allowed = {}) {
    const auto resize = [&values](std::size_t n) -> void * {
      values.resize(n);
      return values.data();
    };
    block(path(name), block_type<T>(unit), {values.data(), values.size(), resize}, false, allowed);
  }
  // As many as there are; a state with more or fewer is refused.
  template <class T>
  void same_rows(const std::string &name, std::vector<T> &values, const std::string &unit = "1",
                 const Allowed &allowed = {}) {
    block(path(name), block_type<T>(unit), {values.data(), values.size(), {}}, false, allowed);
  }
  // All columns by name, with as many rows as were stored; or with as many as there are.
  void table(const std::string &name, Table &table);
  void same_table(const std::string &name, Table &table);

  // What another class describes, under a name of its own.
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
    bool is_local = false;                     // to describe(): filled by an archive that only looks, too
  };
  // Writes, looks at or fills the rows; false, having done nothing, where the state lacks them and may.
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

  std::string path_; // of the part that is described, with a slash at its end
};

} // namespace platen
