// All faults of a scene, reported together.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/scene/errors.h"

namespace platen::apps {

// Where a value comes from.
struct Origin {
  std::string file; // as given; "command line, --set 2"; empty for a default
  int line = 0;     // first is 1; 0 where lines mean nothing
  int depth = 0;    // of `include`: 0 in the scene itself, 1 in a file it includes; -1 on the command line
  int option = 0;   // number of the --set, from 1; 0 in a file
  std::string text() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
};

// An InputError that knows its place. `entry` is the entry, or the section, that it is about; of an unknown
// name the one that was meant, "" where none is near.
class EntryError : public InputError {
public:
  EntryError(const std::string &message, Origin where, std::string about)
      : InputError(message), origin(std::move(where)), entry(std::move(about)) {}
  Origin origin;
  std::string entry;
};

// All that is wrong, as text, and one by one in the same order.
class SceneFaults : public InputError {
public:
  SceneFaults(const std::string &text, std::vector<EntryError> faults)
      : InputError(text), all(std::move(faults)) {}
  std::vector<EntryError> all;
};

class Faults {
public:
  void add(const EntryError &error) { all_.push_back(error); }
  bool empty() const { return all_.empty(); }
  const std::vector<EntryError> &all() const { return all_; }
  bool concern(const std::string &entry) const; // an entry, or the section that it is in
  bool any_in(const std::string &section) const;
  // Leaves what `others` hold too.
  void keep_common(const Faults &others);

  // In the order of files (as they were read), lines and options.
  std::vector<EntryError> sorted(const std::vector<std::string> &files) const;
  // The same, each on its own line, twenty at most.
  std::string text(const std::vector<std::string> &files) const;

private:
  std::vector<EntryError> all_;
};

} // namespace platen::apps
