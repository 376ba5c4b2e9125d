// The entries of a scene file: what may be set, to what, and what was set where. Refuses unknown names,
// repeated keys and bad values with one message that names place, key, value, what is allowed and the nearest
// known name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/scene/errors.h"
#include "apps/scene/faults.h"
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
  // Of sections alike: in the first, or a further one; written only where it is set, the first with what is
  // documented.
  enum class Alike { none, first, further } alike = Alike::none;
  // Converts a text and stores the number; throws ValueError. Empty once the scene has been read.
  std::function<void(const std::string &)> read;
  // Why it has no effect, and why it must be given; "" where neither is so (apps/scene/declared.h).
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

class Parameters {
public:
  // Declares an entry and reads its default. A path is "Section/Key" or "Section/Subsection/Key".
  void declare(Entry entry);
  // The same entry for a further member: both are set. Throws std::logic_error where they differ in default,
  // unit or what is allowed.
  void join(Entry entry);
  Entry &declared(const std::string &path); // throws std::out_of_range for an unknown path

  // Section names in the order of declaration, "Platens/Top" included.
  const std::vector<std::string> &sections() const { return sections_; }
  const std::vector<Entry> &entries() const { return entries_; }
  const Entry *find(const std::string &path) const; // null for an unknown path
  const Entry &at(const std::string &path) const;   // throws std::out_of_range for an unknown path

  bool is_section(const std::string &path) const;
  // Keys of this section, of what is in it too, belong to another program: they are neither read nor refused.
  void pass_over(const std::string &section) { foreign_.push_back(section); }
  bool is_foreign(const std::string &path) const;
  // Throws InputError unless path is a section.
  void enter(const std::string &path, const Origin &origin) const;
  // Sets an entry. Throws InputError for an unknown path, a bad value, or a key that was set before at the
  // same or a smaller depth: a file may override what the files it includes have set, the command line
  // everything.
  void set(const std::string &path, const std::string &text, const Origin &origin);
  // Throws InputError where a value holds a character that cannot be seen and is neither a file nor a title.
  // `whole` is what stands there, value included, for the column.
  void require_seen(const std::string &path, const std::string &value, const std::string &whole,
                    const Origin &origin) const;
  // Gives a value to an entry that nobody has set, as if it were the default; one that is set stays.
  void supply(const std::string &path, const std::string &text);
  // The same on behalf of a word that stands at `word`; one that is set at a larger depth gives way too.
  void supply(const std::string &path, const std::string &text, const Origin &word);
  // Applies "Section/Key = value"; number is that of the option, from 1.
  void override_entry(const std::string &assignment, int number);

  // Throws InputError on behalf of an entry: "case.prm:14: error: Bond/Gap = -1 mm <reason>"; the file stands
  // without a line where the entry was not set.
  [[noreturn]] void refuse(const std::string &path, const std::string &reason) const;
  // The same for a member of a struct of the library; throws `error` itself where no entry sets it.
  [[noreturn]] void refuse(const BadParameter &error) const;
  // The entry that sets a member of the library's settings, "Loading/Ramp" for "loading.ramp"; the member
  // itself where none does.
  std::string entry_of(const std::string &member) const;
  // With every member in backquotes replaced by its entry.
  std::string with_entries(const std::string &message) const;

  // What attempts refuse is kept from now on, and told together; before it each refusal is thrown.
  void collect() { collects_ = true; }
  // Whether f() was not refused. What it throws beside EntryError passes.
  template <class F>
  bool attempt(const F &f) {
    try {
      f();
      return true;
    } catch (const EntryError &error) {
      if (!collects_) throw;
      faults_.add(error);
      return false;
    }
  }
  // A part of the scene cannot be read: what it lacks cannot be told.
  void lose_part() { whole_ = false; }
  bool whole() const { return whole_; }
  const Faults &faults() const { return faults_; }
  // Adds what was found by checks, but for what follows from another fault: of an entry that has one, or with
  // such an entry in its words.
  void add_independent(const Faults &found);
  void throw_faults() const; // InputError, where there is one
  // Reads another word, as if it stood in the scene; "" its default.
  void pretend(const std::string &path, const std::string &word);

  // A file that is read, the scene itself first; included ones follow.
  void add_source(const std::string &path) { sources_.push_back(path); }
  const std::vector<std::string> &sources() const { return sources_; }

  // Forgets how values are converted: what remains is texts.
  void release();

private:
  [[noreturn]] void refuse_unknown(const std::string &path, const Origin &origin) const;
  // "Loading/Stage 20" of "Loading/Stage 21"; "" where there are none alike.
  std::string last_of_its_kind(const std::string &path) const;
  std::string nearest_section(const std::string &path) const; // "" where none is near
  std::string contents_of(const std::string &section) const;
  bool names_a_fault(const std::string &message) const;
  std::size_t position(const std::string &path) const; // entries_.size() for an unknown path

  std::vector<Entry> entries_;
  std::vector<std::string> sections_;
  std::vector<std::string> sources_;
  std::vector<std::string> foreign_; // sections
  Faults faults_;
  bool collects_ = false, whole_ = true;
};

// Throws ValueError for a text that a .prm cannot hold and give back.
void check_characters(const std::string &text);

// "holds U+00A0 (no-break space) in column 18, which cannot be seen. Allowed: blanks and tabs." of the first
// such character of `part`; the column is that in `whole`, which holds it, left out where it does not. ""
// where there is none.
std::string unseen_in(const std::string &part, const std::string &whole);

// The candidate nearest to a word, by letters inserted, dropped, changed or swapped, regardless of case; ""
// where none is near enough to be meant.
std::string nearest_word(const std::string &word, const std::vector<std::string> &candidates);
// The count of such changes.
int edit_distance(const std::string &a, const std::string &b);

// Without blanks at both ends, tabs and carriage returns turned into blanks: a value, a line.
std::string trimmed(const std::string &text);
// The same, each run of blanks inside shrunk to one: names and words.
std::string tidy(const std::string &text);

} // namespace platen::apps
