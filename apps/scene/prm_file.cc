// The grammar of deal.II's ParameterHandler, line by line: `subsection`, `set`, `end`, `include` (lower or
// upper case), comments from # to the end of the line, a backslash at the end to continue a line.
#include <algorithm>
#include <filesystem>
#include <vector>

#include "apps/scene/file_text.h"
#include "apps/scene/scene_files.h"
#include "apps/scene/shipped.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

constexpr int deepest_include = 16; // more is a file that includes itself
// Each time that a file is read: files that include two others each are thousands a few levels down.
constexpr int most_includes = 500;

struct OpenSection {
  std::string name;
  Origin origin;
  bool unknown; // it, or one around it: what it holds is passed over
};

class PrmReader {
public:
  explicit PrmReader(Parameters &parameters) : parameters_(parameters) {}
  void read(const std::string &text, const std::string &name, int depth);

private:
  void statement(const std::string &line, const Origin &origin);
  void enter(const std::string &name, const Origin &origin);
  void leave(const std::string &rest, const Origin &origin);
  void set(const std::string &assignment, const Origin &origin);
  void include(const std::string &file, const Origin &origin);
  std::string path(const std::string &name) const;
  bool passes_over() const { return !open_.empty() && open_.back().unknown; }
  std::string begun(const std::string &assignment) const;

  Parameters &parameters_;
  std::string raw_; // the statement as it stands there, for columns
  std::vector<OpenSection> open_;
  int included_ = 0;              // files so far
  std::size_t opened_before_ = 0; // sections that an including file has open: not ours to close
};

[[noreturn]] void fail(const Origin &origin, const std::string &what, const std::string &entry = "") {
  throw EntryError(origin.text() + ": error: " + what, origin, entry);
}

// Beside the file that includes it, else among the scenes that came with the programs; the former where
// neither is there.
std::string place_of(const std::string &file, const std::string &including) {
  const std::filesystem::path beside = std::filesystem::path(including).parent_path() / file,
                              shipped = shipped_scenes() / file;
  std::error_code none;
  const bool is_shipped =
      !std::filesystem::exists(beside, none) && std::filesystem::is_regular_file(shipped, none);
  return (is_shipped ? shipped : beside).string();
}

std::string PrmReader::path(const std::string &name) const {
  std::string joined;
  for (const OpenSection &section : open_)
    joined += section.name + "/";
  return joined + name;
}

void PrmReader::read(const std::string &text, const std::string &name, int depth) {
  const std::size_t outer = opened_before_;
  opened_before_ = open_.size();
  std::string joined; // of continued lines
  bool continues = false;
  Origin origin{name, 0, depth};
  int line_number = 0;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t end = std::min(text.find('\n', first), text.size());
    const std::string whole = text.substr(first, end - first);
    std::string line = trimmed(whole);
    first = end + 1;
    ++line_number;
    if (!continues) origin.line = line_number, raw_.clear();
    raw_ += (raw_.empty() ? "" : "\n") + whole;
    continues = !line.empty() && line.back() == '\\';
    if (continues) line.pop_back(); // a blank before it stays: it parts the words that are joined
    joined += line;
    if (continues && first <= text.size()) continue;
    statement(trimmed(joined.substr(0, joined.find('#'))), origin);
    joined.clear();
  }
  if (open_.size() > opened_before_)
    fail(open_.back().origin, "subsection " + open_.back().name +
                                  " is opened here and not closed by an \"end\" before the file is over.");
  opened_before_ = outer;
}

void PrmReader::statement(const std::string &line, const Origin &origin) {
  if (line.empty()) return;
  const std::size_t blank = std::min(line.find(' '), line.size());
  const std::string word = line.substr(0, blank), rest = trimmed(line.substr(blank));
  if (const std::string fault = unseen_in(word, raw_); !fault.empty())
    fail(origin, "\"" + line.substr(0, 80) + "\" " + fault);
  if (word == "set" || word == "SET")
    return static_cast<void>(parameters_.attempt([&] { set(rest, origin); }));
  if (word == "subsection" || word == "SUBSECTION") return enter(tidy(rest), origin);
  if (word == "end" || word == "END") return leave(rest, origin);
  if (word == "include" || word == "INCLUDE") {
    const std::vector<OpenSection> open = open_;
    const std::size_t opened_before = opened_before_;
    if (parameters_.attempt([&] { include(rest, origin); })) return;
    parameters_.lose_part();
    open_ = open, opened_before_ = opened_before;
    return;
  }
  const std::string nearest = nearest_word(word, {"set", "subsection", "end", "include"});
  const auto refuse = [&] {
    fail(origin,
         "\"" + line.substr(0, 80) + "\" is no statement." +
             (nearest.empty() ? " Allowed: set, subsection, end, include."
                              : " Did you mean \"" + nearest + "\"?"),
         nearest == "set" ? begun(rest) : "");
  };
  if (nearest != "set") refuse(); // what follows may stand in another section, or be no scene at all
  parameters_.attempt(refuse);
}

// The entry of the open section whose key stands in front.
std::string PrmReader::begun(const std::string &assignment) const {
  std::string longest;
  for (const Entry &entry : parameters_.entries()) {
    const std::string key = entry.path.substr(entry.path.rfind('/') + 1);
    if (entry.path == path(key) && assignment.rfind(key, 0) == 0 && entry.path.size() > longest.size())
      longest = entry.path;
  }
  return longest;
}

void PrmReader::enter(const std::string &name, const Origin &origin) {
  if (name.empty()) fail(origin, "\"subsection\" needs the name of a section.");
  if (const std::string fault = unseen_in(name, raw_); !fault.empty())
    fail(origin, "\"subsection " + name + "\" " + fault);
  const std::string entered = path(name);
  if (!passes_over() && !parameters_.is_section(entered) && !open_.empty() && parameters_.is_section(name))
    fail(origin, entered + " is not a section. Is the \"end\" of section " + open_.back().name + " (" +
                     open_.back().origin.text() + ") missing before it?");
  const bool known = passes_over() || parameters_.attempt([&] { parameters_.enter(entered, origin); });
  open_.push_back({name, origin, passes_over() || !known});
}

void PrmReader::leave(const std::string &rest, const Origin &origin) {
  parameters_.attempt([&] {
    if (!rest.empty())
      fail(origin, "\"end\" is followed by \"" + rest.substr(0, 80) + "\". Allowed: nothing.");
  });
  if (open_.size() == opened_before_) fail(origin, "\"end\" without a subsection to close.");
  open_.pop_back();
}

void PrmReader::set(const std::string &assignment, const Origin &origin) {
  if (passes_over()) return;
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos)
    fail(origin, "\"set " + assignment.substr(0, 80) + "\" has no \"=\". Allowed: set Key = value.",
         begun(assignment));
  const std::string key = tidy(assignment.substr(0, equals));
  const std::string fault = unseen_in(assignment.substr(0, equals), raw_);
  if (!fault.empty()) fail(origin, "\"set " + assignment.substr(0, 80) + "\" " + fault);
  if (key.empty())
    fail(origin, "\"set " + assignment.substr(0, 80) + "\" names no key. Allowed: set Key = value.");
  if (key.find('/') != std::string::npos && parameters_.find(key) != nullptr)
    fail(origin,
         "\"set " + key + "\" holds a path. Allowed: subsection " + key.substr(0, key.rfind('/')) + ", set " +
             key.substr(key.rfind('/') + 1) + " = ..., end.",
         key);
  const std::string value = assignment.substr(equals + 1);
  parameters_.require_seen(path(key), value, raw_, origin);
  parameters_.set(path(key), value, origin);
}

void PrmReader::include(const std::string &file, const Origin &origin) {
  if (file.empty()) fail(origin, "\"include\" needs the name of a file.");
  if (origin.depth >= deepest_include)
    fail(origin, "include " + file + ": files include each other without end.");
  if (++included_ > most_includes + 1) return; // told once
  if (included_ > most_includes)
    fail(origin,
         "include " + file + ": more than " + std::to_string(most_includes) +
             " files are included, those that are included again counted again. Allowed: up to that.");
  const std::string included = place_of(file, origin.file);
  std::string text;
  try {
    text = read_text(included);
  } catch (const InputError &error) {
    const std::string fault = unseen_in(file, raw_);
    fail(origin, "include " + file + ": " + error.what() + (fault.empty() ? "" : " The name " + fault));
  }
  parameters_.add_source(included);
  read(with_plain_line_ends(text), included, origin.depth + 1);
}

} // namespace

void read_prm_text(const std::string &text, const std::string &name, Parameters &parameters) {
  PrmReader(parameters).read(with_plain_line_ends(without_byte_order_mark(text)), name, 0);
}

} // namespace platen::apps
