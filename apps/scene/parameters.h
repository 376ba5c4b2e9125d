// The entries of a scene file: what may be set, to what, and what was set where. Refuses unknown names,
// repeated keys and bad values with one message that names place, key, value, what is allowed and the nearest
// known name.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/scene/assignments.h"
#include "apps/scene/errors.h"
#include "apps/scene/faults.h"
#include "apps/scene/texts.h"
#include "base/describe.h"

namespace platen::apps {

struct Situation;

struct Entry {
  std::string path;               // "Bond/Tensile strength"
  std::string default_text;       // "" where there is no default
  std::string unit;               // SI unit of a bare number; "" where there is none
  std::string allowed;            // in words: "0 ... 5", "none, linear, hertz"
  std::string documentation;      // one sentence or two
  bool is_file = false;           // the value is a path, relative to the folder of the scene
  bool is_text = false;           // the value is free: a title, a name
  std::vector<std::string> words; // that it may be; empty where it is none of a few
  std::size_t number = 0;         // of a section among others alike, from 1: written only where it is set
  // Converts a text and stores the number; throws ValueError. Empty once the scene has been read.
  std::function<void(const std::string &)> read;
  // Why it has no effect, and why it must be given; "" where neither is so (apps/scene/declare.h).
  std::vector<std::function<std::string(const Situation &)>> idle, needed;
  std::vector<std::string> members; // of the library's structs that it sets, "BondLayout.modulus"

  std::string text;    // as used
  Origin origin;       // of text
  std::string of_file; // where an option has set it: the text without that option

  // Whether an option has set it to another text than the scene file has.
  bool overridden() const { return origin.option > 0 && text != of_file; }
  bool changed() const { return text != default_text; }
};

// What an entry allows, with unit and default: "0 ... 5, default 0.5"; "" where anything goes.
std::string limits(const Entry &entry);

// The path of a file entry as the program can open it: relative to the folder of the file that sets it, or,
// from the command line, to the current folder.
std::string resolved_path(const Entry &entry);

class Parameters {
public:
  // Declares an entry and reads its default. A path is "Section/Key" or "Section/Subsection/Key".
  Entry &declare(Entry entry);
  // The same entry for a further member: both are set. Throws std::logic_error where they differ in default,
  // unit or what is allowed.
  Entry &join(Entry entry);
  // Sections alike, `first` "Loading/Stage 1", each declared by declare(parameters, number): the first at
  // once, a further one, with those before it, when a scene writes it.
  void declare_series(const std::string &first, std::size_t most,
                      std::function<void(Parameters &, std::size_t)> declare);
  // Entries of a section of a series, or one of them, as they would be if it were written; empty of others.
  std::vector<Entry> unwritten(const std::string &path) const;

  // Section names in the order of declaration, "Platens/Top" included.
  const std::vector<std::string> &sections() const { return sections_; }
  const std::deque<Entry> &entries() const { return entries_; }
  const Entry *find(const std::string &path) const; // null for an unknown path
  const Entry &at(const std::string &path) const;   // throws std::out_of_range for an unknown path
  Entry &declared(const std::string &path);         // the same
  bool is_section(const std::string &path) const;
  // Keys of this section, of what is in it too, belong to another program: they are neither read nor refused.
  void pass_over(const std::string &section) { foreign_.push_back(section); }
  bool is_foreign(const std::string &path) const;

  // Sets what files say, and keeps what is wrong with them.
  void apply(const FileText &file);
  // Sets an entry. Throws EntryError for an unknown path, a bad value, or a key that was set before at the
  // same or a smaller depth: a file may override what the files it includes have set, the command line
  // everything. `line` is what stands there, value included, where a character of it cannot be seen.
  void set(const std::string &path, const std::string &text, const Origin &origin,
           const std::string &line = "");
  // Gives a value to an entry that nobody has set, as if it were the default; one that is set stays.
  void supply(const std::string &path, const std::string &text);
  // The same on behalf of a word that stands at `word`; one that is set at a larger depth gives way too.
  void supply(const std::string &path, const std::string &text, const Origin &word);
  // Applies "Section/Key = value"; number is that of the option, from 1. Throws EntryError.
  void override_entry(const std::string &assignment, int number);
  // Reads another word, as if it stood in the scene; "" its default.
  void pretend(const std::string &path, const std::string &word);

  // Throws EntryError on behalf of an entry: "case.prm:14: error: Bond/Gap = -1 mm <reason>"; the file stands
  // without a line where the entry was not set.
  [[noreturn]] void refuse(const std::string &path, const std::string &reason) const;
  // The same for a member of a struct of the library; throws `error` itself where no entry sets it.
  [[noreturn]] void refuse(const BadParameter &error) const;
  // The entry that sets a member of the library's settings, "Loading/Ramp" for "loading.ramp"; the member
  // itself where none does.
  std::string entry_of(const std::string &member) const;
  // With every member in backquotes replaced by its entry.
  std::string with_entries(const std::string &message) const;

  // Keeps what f() refuses, so that all faults are reported together. True where nothing was refused.
  template <class F>
  bool attempt(const F &f) {
    try {
      f();
      return true;
    } catch (const EntryError &error) {
      faults_.add(error);
      return false;
    }
  }
  // Whether all files could be read: if not, nobody knows what a scene lacks.
  bool whole() const { return whole_; }
  const Faults &faults() const { return faults_; }
  // Adds what was found by checks, but for what follows from another fault: of an entry that has one, or with
  // such an entry in its words.
  void add_independent(const Faults &found);
  void throw_faults() const; // SceneFaults, where there is one

  // Files that were read, the scene itself first; included ones follow.
  const std::vector<std::string> &sources() const { return sources_; }

  // Forgets how values are converted: what remains is texts.
  void release();

private:
  struct Series {
    std::string prefix; // "Loading/Stage "
    std::size_t most, declared;
    std::function<void(Parameters &, std::size_t)> declare;
  };
  static constexpr std::size_t section_mark = static_cast<std::size_t>(-1);

  void declare_further(Series &series);
  // The number that a path has in a series, 0 where it is not of it.
  static std::size_t number_in(const Series &series, const std::string &path);
  void declare_written(const std::string &path); // the section of a series that holds it
  // Whether what follows the assignment can be read.
  bool apply(const Assignment &one, const FileText &file);
  void open(const Assignment &section, const FileText &file);
  bool lacks_end(const std::string &path) const; // what stands before the section lacks one
  // The entry whose path stands in front of a text; "" where there is none.
  std::string begun(const std::string &text) const;
  std::string contents_of(const std::string &section) const;
  EntryError unknown_section(const std::string &path, const Origin &origin) const;
  EntryError unknown_entry(const std::string &path, const Origin &origin) const;
  bool names_a_fault(const std::string &message) const;

  std::deque<Entry> entries_;
  std::unordered_map<std::string, std::size_t> places_; // in entries_; section_mark of a section
  std::vector<std::string> sections_;
  std::vector<Series> series_;
  std::vector<std::string> sources_;
  std::vector<std::string> foreign_; // sections
  Faults faults_;
  bool whole_ = true;
  std::string passed_over_; // a section that is not known: what it holds is not reported
};

} // namespace platen::apps
