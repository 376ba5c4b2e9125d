#include "apps/scene/assignments.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "apps/scene/regular_file.h"
#include "apps/scene/shipped.h"
#include "apps/scene/texts.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

using Kind = Assignment::Kind;
namespace fs = std::filesystem;

constexpr int deepest_include = 16; // more is a file that includes itself
// Each time that a file is read: files that include two others each are thousands a few levels down.
constexpr int most_includes = 500;
constexpr std::size_t longest_quote = 80; // bytes of a statement in a message

// Throws InputError, "cannot be read: No such file or directory.", for what is missing, a folder, unreadable,
// larger than a scene can be, or not text.
std::string read_text(const std::string &path) {
  const auto fail = [](const std::string &reason) { throw InputError("cannot be read: " + reason); };
  constexpr std::size_t largest = 4u << 20; // bytes; a scene is a few thousand, so this is some other file
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) fail("it is a folder.");
  if (is_pipe_or_device(path)) fail("it is a pipe or a device, no file.");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text(largest + 1, ' ');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (!file.is_open() || file.bad()) fail(std::string(std::strerror(errno)) + ".");
  if (text.size() > largest) fail("it is larger than 4 MB, so it is no scene.");
  if (text.find('\0') != std::string::npos) fail("it holds a zero byte, so it is no text file.");
  return text;
}

// With \n at the ends of lines, without the three bytes with which some editors begin UTF-8.
std::string plain(const std::string &text) {
  return with_plain_line_ends(text.compare(0, 3, "\xef\xbb\xbf") == 0 ? text.substr(3) : text);
}

// Beside the file that includes it, else among the scenes that came with the programs; the former where
// neither is there.
std::string place_of(const std::string &file, const std::string &including) {
  const fs::path beside = fs::path(including).parent_path() / file, shipped = shipped_scenes() / file;
  std::error_code none;
  return (!fs::exists(beside, none) && fs::is_regular_file(shipped, none) ? shipped : beside).string();
}

// One file; those that it includes have readers of their own.
class PrmReader {
public:
  // `section` is open in the file that includes it, of which `included` are read so far.
  PrmReader(FileText &to, int &included, std::string section, const Origin &file)
      : to_(to), included_(included), outer_(std::move(section)), origin_(file) {}
  void read(const std::string &text);

private:
  struct Open {
    std::string name;
    Origin origin;
  };
  struct Broken {};

  void read_lines(const std::string &text);
  void statement(const std::string &line);
  void set(const std::string &assignment, const std::string &quoted);
  void include(const std::string &file);
  std::string section() const;
  void add(Kind kind, const std::string &key, const std::string &text) {
    to_.assignments.push_back({kind, section(), key, text, origin_, first_unseen(text) ? raw_ : ""});
  }
  void wrong(const std::string &what, const std::string &about = "") { add(Kind::wrong, about, what); }
  void broken(const std::string &what) { add(Kind::broken, "", what); }
  // What follows may stand in another section, or be no scene at all.
  [[noreturn]] void stop(const std::string &what) {
    broken(what);
    throw Broken();
  }

  FileText &to_;
  int &included_;
  std::string outer_;
  Origin origin_;          // of the statement that is read
  std::string raw_;        // the same as it stands there, for columns
  std::vector<Open> open_; // sections
};

std::string PrmReader::section() const {
  std::string path = outer_;
  for (const Open &one : open_)
    path += (path.empty() ? "" : "/") + one.name;
  return path;
}

void PrmReader::read(const std::string &text) {
  try {
    read_lines(text);
  } catch (const Broken &) {
    return;
  }
  if (open_.empty()) return;
  origin_ = open_.back().origin;
  broken("subsection " + open_.back().name +
         " is opened here and not closed by an \"end\" before the file is over.");
}

void PrmReader::read_lines(const std::string &text) {
  std::istringstream lines(text);
  std::string whole, joined; // the latter of continued lines
  bool continues = false;
  for (int number = 1; std::getline(lines, whole); ++number) {
    std::string line = trimmed(whole);
    if (!continues) origin_.line = number, raw_.clear();
    raw_ += (raw_.empty() ? "" : "\n") + whole;
    continues = !line.empty() && line.back() == '\\';
    if (continues) line.pop_back(); // a blank before it stays: it parts the words that are joined
    joined += line;
    if (continues && lines.peek() != std::char_traits<char>::eof()) continue;
    statement(trimmed(joined.substr(0, joined.find('#'))));
    joined.clear();
  }
}

void PrmReader::statement(const std::string &line) {
  if (line.empty()) return;
  const std::size_t blank = std::min(line.find(' '), line.size());
  const std::string word = line.substr(0, blank), rest = trimmed(line.substr(blank)),
                    quoted = "\"" + line.substr(0, longest_quote) + "\" ";
  const bool sets = word == "set" || word == "SET";
  if (word == "include" || word == "INCLUDE") return include(rest);
  if (const std::string unseen = unseen_in(line.substr(0, line.find('=')), raw_); !unseen.empty())
    return sets ? wrong(quoted + unseen) : stop(quoted + unseen);
  if (sets) return set(rest, quoted);
  if (word == "subsection" || word == "SUBSECTION") {
    if (rest.empty()) stop("\"subsection\" needs the name of a section.");
    open_.push_back({tidy(rest), origin_});
    return add(Kind::section, "", "");
  }
  if (word == "end" || word == "END") {
    if (!rest.empty())
      wrong("\"end\" is followed by \"" + rest.substr(0, longest_quote) + "\". Allowed: nothing.");
    if (open_.empty()) stop("\"end\" without a subsection to close.");
    return open_.pop_back();
  }
  const std::string nearest = nearest_word(word, {"set", "subsection", "end", "include"}),
                    what = quoted + "is no statement." +
                           (nearest.empty() ? " Allowed: set, subsection, end, include."
                                            : " Did you mean \"" + nearest + "\"?");
  if (nearest != "set") stop(what);
  wrong(what, tidy(rest));
}

void PrmReader::set(const std::string &assignment, const std::string &quoted) {
  const std::size_t equals = assignment.find('=');
  const std::string key = tidy(assignment.substr(0, equals));
  if (equals == std::string::npos) return wrong(quoted + "has no \"=\". Allowed: set Key = value.", key);
  if (key.empty()) return wrong(quoted + "names no key. Allowed: set Key = value.");
  if (const std::size_t slash = key.rfind('/'); section().empty() && slash != std::string::npos)
    return wrong("\"set " + key + "\" holds a path. Allowed: subsection " + key.substr(0, slash) + ", set " +
                     key.substr(slash + 1) + " = ..., end.",
                 key);
  add(Kind::value, key, assignment.substr(equals + 1));
}

void PrmReader::include(const std::string &file) {
  const std::string what = "include " + file + ": ";
  if (file.empty()) return broken("\"include\" needs the name of a file.");
  if (origin_.depth >= deepest_include) return broken(what + "files include each other without end.");
  if (++included_ > most_includes) {
    if (included_ == most_includes + 1) // reported once
      broken(what + "more than " + std::to_string(most_includes) +
             " files are included, those that are included again counted again. Allowed: up to that.");
    return;
  }
  const std::string included = place_of(file, origin_.file);
  std::string text;
  try {
    text = read_text(included);
  } catch (const InputError &error) {
    const std::string unseen = unseen_in(file, raw_);
    return broken(what + included + ": error: " + error.what() +
                  (unseen.empty() ? "" : " The name " + unseen));
  }
  to_.sources.push_back(included);
  PrmReader(to_, included_, section(), {included, 0, origin_.depth + 1}).read(plain(text));
}

FileText broken_file(const std::string &path, const std::string &message) {
  return {{{Kind::broken, "", "", message, {path, 0, 0, 0}, ""}}, {path}};
}

} // namespace

FileText prm_assignments(const std::string &text, const std::string &name) {
  FileText all{{}, {name}};
  int included = 0;
  PrmReader(all, included, "", {name, 0, 0}).read(text);
  return all;
}

FileText file_assignments(const std::string &path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending != ".prm" && ending != ".json")
    return broken_file(path, "is no scene file by its name. Allowed: names that end in .prm or .json.");
  try {
    const std::string text = plain(read_text(path));
    return ending == ".json" ? json_assignments(text, path) : prm_assignments(text, path);
  } catch (const InputError &error) {
    return broken_file(path, error.what());
  }
}

} // namespace platen::apps
