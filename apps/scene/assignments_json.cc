#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "apps/scene/assignments.h"
#include "apps/scene/texts.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

using Kind = Assignment::Kind;

// Hands scalars on with their paths, and the lines on which the parser has read them. Returning false ends
// it.
class JsonReader : public nlohmann::json_sax<nlohmann::json> {
public:
  JsonReader(const std::string &text, const std::string &name, FileText &to)
      : text_(text), stream_(text), name_(name), to_(to) {
    nlohmann::json::sax_parse(stream_, this);
  }

  bool null() override { return broken("null is no value; leave the key out instead."); }
  bool boolean(bool value) override { return scalar(value ? "on" : "off"); }
  bool number_integer(number_integer_t value) override { return scalar(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override { return scalar(std::to_string(value)); }
  bool number_float(number_float_t, const std::string &as_written) override { return scalar(as_written); }
  bool string(std::string &value) override { return scalar(value); }
  bool binary(nlohmann::json::binary_t &) override { return broken("binary data is no value."); }
  bool start_array(std::size_t) override {
    return broken(where() +
                  " is an array. Allowed: numbers, texts, true, false; lists are texts, \"1, 2, 3\".");
  }
  bool end_array() override { return true; }
  bool start_object(std::size_t) override {
    const std::size_t first = to_.assignments.size();
    if (!levels_.empty())
      to_.assignments.push_back({Kind::section, path(levels_.size()), "", "", levels_.back().origin, ""});
    levels_.push_back({"", {name_, 0, 0, 0}, {}, first});
    return true;
  }
  bool end_object() override;
  bool key(std::string &name) override;
  bool parse_error(std::size_t position, const std::string &,
                   const nlohmann::json::exception &error) override;

private:
  struct Level {
    std::string key; // of the member being read
    Origin origin;   // of that key
    std::set<std::string> keys;
    std::size_t first; // assignment of this object
  };

  std::size_t read_to() {
    return static_cast<std::size_t>(stream_.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in));
  }
  // Of the line that the event ends on, as far as it has been read.
  std::string read_of_line() {
    const std::size_t end = read_to(), first = end == 0 ? 0 : text_.rfind('\n', end - 1) + 1;
    return text_.substr(first, end - first);
  }
  std::string path(std::size_t levels) const {
    std::string joined;
    for (std::size_t k = 0; k < levels; ++k)
      joined += (k == 0 ? "" : "/") + levels_[k].key;
    return joined;
  }
  std::string where() const { return levels_.empty() ? "the file" : path(levels_.size()); }
  bool broken(const std::string &what) {
    to_.assignments.push_back(
        {Kind::broken, "", "", what, levels_.empty() ? Origin{name_, 1, 0, 0} : levels_.back().origin, ""});
    return false;
  }
  bool scalar(const std::string &value) {
    if (levels_.empty()) return broken("the file is no object. Allowed: {\"Section\": {\"Key\": value}}.");
    to_.assignments.push_back({Kind::value, path(levels_.size() - 1), levels_.back().key, value,
                               levels_.back().origin, first_unseen(value) ? read_of_line() : ""});
    return true;
  }

  const std::string &text_;
  std::istringstream stream_;
  std::size_t counted_ = 0; // bytes whose lines are counted in line_
  int line_ = 1;
  const std::string &name_;
  FileText &to_;
  std::vector<Level> levels_; // one for each object that is open
};

// An object with a "value" is an entry; its other members are for readers.
bool JsonReader::end_object() {
  const std::size_t first = levels_.back().first;
  levels_.pop_back();
  if (levels_.empty()) return true;
  const std::string entry = path(levels_.size());
  const auto begin = to_.assignments.begin() + static_cast<std::ptrdiff_t>(first);
  const auto value = std::find_if(begin, to_.assignments.end(), [&](const Assignment &one) {
    return one.kind == Kind::value && one.section == entry && one.key == "value";
  });
  if (value == to_.assignments.end()) return true;
  Assignment own = *value;
  own.section = path(levels_.size() - 1), own.key = levels_.back().key;
  to_.assignments.erase(begin, to_.assignments.end());
  to_.assignments.push_back(std::move(own));
  return true;
}

bool JsonReader::key(std::string &name) {
  Level &level = levels_.back();
  const std::size_t end = read_to();
  line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_),
                                       text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
  counted_ = end;
  level.origin.line = line_;
  level.key = tidy(name);
  if (first_unseen(level.key)) return broken(where() + " " + unseen_in(level.key, read_of_line()));
  if (const std::string clean = shown(level.key); clean != level.key) {
    level.key = clean;
    return broken(where() +
                  " holds a control character or is too long. Allowed: names of sections and parameters.");
  }
  if (!level.keys.insert(level.key).second)
    return broken(where() + " stands twice in one object. Allowed: once.");
  return true;
}

bool JsonReader::parse_error(std::size_t position, const std::string &,
                             const nlohmann::json::exception &error) {
  const std::size_t before = std::min(position, text_.size()); // the byte that does not fit ends there
  const auto end = text_.begin() + static_cast<std::ptrdiff_t>(before == 0 ? 0 : before - 1);
  // "[json.exception...] parse error at line 3, column 5: syntax error ..."
  std::string reason = error.what();
  if (const auto prefix = reason.find(": "); prefix != std::string::npos) reason = reason.substr(prefix + 2);
  const Origin origin{name_, 1 + static_cast<int>(std::count(text_.begin(), end, '\n')), 0, 0};
  to_.assignments.push_back(
      {Kind::broken, "", "", "this is not JSON: " + tidy(reason).substr(0, 300) + ".", origin, ""});
  return false;
}

} // namespace

FileText json_assignments(const std::string &text, const std::string &name) {
  FileText all{{}, {name}};
  JsonReader(text, name, all);
  return all;
}

} // namespace platen::apps
