// Scenes as JSON: {"Bond": {"Modulus": "320 GPa"}, "Platens": {"Top": {"Friction static": 0.3}}}. Numbers,
// texts and true / false are values. An entry may also be an object with a "value", as --print-parameters
// --json and ParameterHandler write it.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <sstream>
#include <vector>

#include "apps/scene/file_text.h"
#include "apps/scene/scene_files.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

class JsonReader : public nlohmann::json_sax<nlohmann::json> {
public:
  JsonReader(const std::string &text, const std::string &name, Parameters &parameters)
      : text_(text), stream_(text), name_(name), parameters_(parameters) {}

  void read() { nlohmann::json::sax_parse(stream_, this); }

  bool null() override { fail("null is no value; leave the key out instead."); }
  bool boolean(bool value) override { return scalar(value ? "on" : "off"); }
  bool number_integer(number_integer_t value) override { return scalar(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override { return scalar(std::to_string(value)); }
  bool number_float(number_float_t, const std::string &as_written) override { return scalar(as_written); }
  bool string(std::string &value) override { return scalar(value); }
  bool binary(nlohmann::json::binary_t &) override { fail("binary data is no value."); }
  bool start_array(std::size_t) override {
    fail(where() + " is an array. Allowed: numbers, texts, true, false; lists are texts, \"1, 2, 3\".");
  }
  bool end_array() override { return true; }
  bool start_object(std::size_t) override;
  bool end_object() override;
  bool key(std::string &name) override;
  bool parse_error(std::size_t position, const std::string &,
                   const nlohmann::json::exception &error) override;

private:
  struct Level {
    std::string key; // of the member being read
    Origin origin;   // of that key
    std::set<std::string> keys;
  };

  // Of the event that is told, which is where the parser has read to.
  int line() {
    const std::streamoff read_to = stream_.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in);
    line_ += static_cast<int>(std::count(text_.begin() + counted_, text_.begin() + read_to, '\n'));
    counted_ = read_to;
    return line_;
  }
  // Of the line that the event ends on, as far as it has been read.
  std::string read_of_line() {
    const auto read_to =
        static_cast<std::size_t>(stream_.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in));
    const std::size_t first = read_to == 0 ? 0 : text_.rfind('\n', read_to - 1) + 1;
    return text_.substr(first, read_to - first);
  }
  void require_seen(const std::string &entry, const std::string &value) {
    if (first_unseen(value)) parameters_.require_seen(entry, value, read_of_line(), levels_.back().origin);
  }
  std::string path(std::size_t levels) const {
    std::string joined;
    for (std::size_t k = 0; k < levels; ++k)
      joined += (k == 0 ? "" : "/") + levels_[k].key;
    return joined;
  }
  std::string where() const { return levels_.empty() ? "the file" : path(levels_.size()); }
  [[noreturn]] void fail(const std::string &what) {
    const Origin origin = levels_.empty() ? Origin{name_, 1, 0, 0} : levels_.back().origin;
    throw EntryError(origin.text() + ": error: " + what, origin, "");
  }
  bool scalar(const std::string &value);

  const std::string &text_;
  std::istringstream stream_;
  std::streamoff counted_ = 0; // bytes, of which line_ tells the end
  int line_ = 1;
  const std::string &name_;
  Parameters &parameters_;
  std::vector<Level> levels_;    // one for each object that is open
  std::size_t unknown_from_ = 0; // levels from which on what an unknown section holds is passed over
  bool in_entry_ = false;        // inside {"value": ...}
};

bool JsonReader::start_object(std::size_t) {
  if (in_entry_) fail(where() + " is an object inside an entry. Allowed: its \"value\".");
  if (!levels_.empty() && unknown_from_ == 0) {
    const std::string here = path(levels_.size());
    in_entry_ = parameters_.find(here) != nullptr;
    if (!in_entry_ && !parameters_.attempt([&] { parameters_.enter(here, levels_.back().origin); }))
      unknown_from_ = levels_.size() + 1;
  }
  levels_.push_back({"", {name_, 0, 0, 0}, {}});
  return true;
}

bool JsonReader::end_object() {
  if (in_entry_ && levels_.back().keys.count("value") == 0) {
    const Origin origin = levels_[levels_.size() - 2].origin;
    throw EntryError(origin.text() + ": error: " + path(levels_.size() - 1) +
                         " is an object without \"value\". Allowed: a number, a text, true, false.",
                     origin, path(levels_.size() - 1));
  }
  in_entry_ = false;
  if (unknown_from_ == levels_.size()) unknown_from_ = 0;
  levels_.pop_back();
  return true;
}

bool JsonReader::key(std::string &name) {
  Level &level = levels_.back();
  level.origin.line = line();
  level.key = tidy(name);
  if (first_unseen(level.key)) fail(where() + " " + unseen_in(level.key, read_of_line()));
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (std::any_of(level.key.begin(), level.key.end(), control)) {
    level.key = "a key";
    fail(where() + " holds a control character or a line end. Allowed: names of sections and parameters.");
  }
  if (!level.keys.insert(level.key).second) fail(where() + " stands twice in one object. Allowed: once.");
  return true;
}

bool JsonReader::scalar(const std::string &value) {
  if (levels_.empty()) fail("the file is no object. Allowed: {\"Section\": {\"Key\": value}}.");
  if (unknown_from_ > 0) return true;
  parameters_.attempt([&] {
    if (!in_entry_) {
      if (parameters_.is_section(where()))
        fail(where() + " = " + value + " is a section. Allowed: an object.");
      require_seen(where(), value);
      parameters_.set(where(), value, levels_.back().origin);
    } else if (levels_.back().key == "value") {
      const std::string entry = path(levels_.size() - 1);
      require_seen(entry, value);
      parameters_.set(entry, value, levels_.back().origin);
    }
  });
  return true;
}

bool JsonReader::parse_error(std::size_t position, const std::string &,
                             const nlohmann::json::exception &error) {
  const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position, text_.size()));
  const auto before = position > 0 ? end - (end == text_.begin() ? 0 : 1) : end; // the byte that does not fit
  const int at = 1 + static_cast<int>(std::count(text_.begin(), before, '\n'));
  std::string reason = error.what();
  const auto prefix =
      reason.find(": "); // "[json.exception...] parse error at line 3, column 5: syntax error ..."
  if (prefix != std::string::npos) reason = reason.substr(prefix + 2);
  const Origin origin{name_, at, 0, 0};
  throw EntryError(origin.text() + ": error: this is not JSON: " + tidy(reason).substr(0, 300) + ".", origin,
                   "");
}

} // namespace

void read_json_text(const std::string &text, const std::string &name, Parameters &parameters) {
  const std::string plain = with_plain_line_ends(without_byte_order_mark(text));
  JsonReader(plain, name, parameters).read();
}

void write_json(const std::vector<Entry> &entries, std::ostream &out) {
  nlohmann::ordered_json tree;
  for (const Entry &entry : entries) {
    nlohmann::ordered_json &leaf = tree[nlohmann::ordered_json::json_pointer("/" + entry.path)];
    leaf["value"] = entry.text;
    leaf["default_value"] = entry.default_text;
    leaf["unit"] = entry.unit;
    leaf["allowed"] = entry.allowed;
    leaf["documentation"] = entry.documentation;
  }
  // Text that is no UTF-8 (a title, a path) is shown with replacement characters rather than refused.
  out << tree.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

} // namespace platen::apps
