#include "apps/scene/parameters.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>

#include "apps/scene/units.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string section_of(const std::string &path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string last_name(const std::string &path) {
  return path.substr(path.rfind('/') + 1);
}

// The distance is at least that of the lengths, which costs nothing.
int length_difference(const std::string &a, const std::string &b) {
  return std::abs(static_cast<int>(a.size()) - static_cast<int>(b.size()));
}

bool a_slip_apart(const std::string &a, const std::string &b) {
  return length_difference(a, b) <= 1 && edit_distance(a, b) <= 1;
}

// Keys of more words, of which this is one: "Friction static" for "Friction"; few, or it says nothing.
std::vector<std::string> keys_with(const std::string &key, const std::vector<std::string> &keys) {
  constexpr std::size_t most = 4;
  const auto small = [](const std::string &text) {
    std::string result = " ";
    for (const char c : text)
      result += lower(c);
    return result + " ";
  };
  std::vector<std::string> found;
  for (const std::string &one : keys)
    if (small(one).find(small(key)) != std::string::npos) found.push_back(one);
  return found.size() > most ? std::vector<std::string>{} : found;
}

std::string shown(const std::string &text) {
  constexpr std::size_t longest = 80; // a message stays readable whatever the value
  std::string cut = text.size() > longest ? text.substr(0, longest) + "..." : text;
  for (char &c : cut)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return cut;
}

// ": it holds U+0421 (Cyrillic letter) in column 1" of what looks like a known name and is none.
std::string look_alike_in(const std::string &text) {
  const std::optional<Character> odd = first_look_alike(text);
  return odd ? ": it holds " + text_of_odd_character(text) : "";
}

} // namespace

std::string unseen_in(const std::string &part, const std::string &whole) {
  const std::optional<Character> odd = first_unseen(part);
  if (!odd) return "";
  const std::string sign = part.substr(odd->at, odd->bytes);
  const std::size_t there = whole.find(part),
                    at = there == std::string::npos ? whole.find(sign) : there + odd->at;
  std::string column;
  if (at != std::string::npos) {
    const std::size_t line = whole.rfind('\n', at) + 1; // of a continued one the last
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
    const auto first = whole.begin() + static_cast<std::ptrdiff_t>(line),
               end = whole.begin() + static_cast<std::ptrdiff_t>(at);
    column = " in column " + std::to_string(1 + (end - first) - std::count_if(first, end, continues));
  }
  return "holds " + odd->name + column + ", which cannot be seen. Allowed: blanks and tabs.";
}

// What a .prm cannot hold cannot be written back, wherever it came from.
void check_characters(const std::string &text) {
  for (const char c : text) {
    if (c == '#') throw ValueError("holds a \"#\", which begins a comment in a scene file");
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      throw ValueError("holds a control character or a line end");
  }
  if (!text.empty() && text.back() == '\\') throw ValueError("ends with a backslash, which continues a line");
}

std::string limits(const Entry &entry) {
  std::string text = entry.allowed;
  if (!entry.unit.empty() && entry.unit != "1") text += (text.empty() ? "in " : " ") + entry.unit;
  if (!entry.default_text.empty()) text += (text.empty() ? "default " : ", default ") + entry.default_text;
  return text;
}

int edit_distance(const std::string &a, const std::string &b) {
  const std::size_t n = a.size(), m = b.size();
  std::vector<std::vector<int>> d(n + 1, std::vector<int>(m + 1));
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= m; ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = static_cast<int>(i + j);
        continue;
      }
      const int changed = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + changed});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[n][m];
}

std::string nearest_word(const std::string &word, const std::vector<std::string> &candidates) {
  constexpr std::size_t longest = 200; // more is no slip of the pen, and the distance costs its square
  if (word.size() > longest) return "";
  std::string nearest;
  int least = (static_cast<int>(word.size()) + 2) / 3 + 1;
  for (const std::string &candidate : candidates) {
    if (length_difference(word, candidate) >= least) continue;
    const int distance = edit_distance(word, candidate);
    if (distance < least && distance < static_cast<int>(candidate.size()))
      least = distance, nearest = candidate;
  }
  return nearest;
}

std::string trimmed(const std::string &text) {
  std::string result = text;
  for (char &c : result)
    if (c == '\t' || c == '\r') c = ' ';
  const auto first = result.find_first_not_of(' ');
  return first == std::string::npos ? "" : result.substr(first, result.find_last_not_of(' ') - first + 1);
}

std::string tidy(const std::string &text) {
  std::string result;
  for (const char c : trimmed(text))
    if (c != ' ' || result.back() != ' ') result += c;
  return result;
}

void Parameters::declare(Entry entry) {
  if (find(entry.path) != nullptr) throw std::logic_error("declared twice: " + entry.path);
  const std::string section = section_of(entry.path);
  for (std::size_t slash = section.find('/');; slash = section.find('/', slash + 1)) {
    const std::string outer = section.substr(0, slash);
    if (!outer.empty() && !is_section(outer)) sections_.push_back(outer);
    if (slash == std::string::npos) break;
  }
  entry.text = entry.default_text;
  entry.read(entry.text);
  entries_.push_back(std::move(entry));
}

void Parameters::join(Entry further) {
  Entry &entry = declared(further.path);
  if (entry.default_text != further.default_text || limits(entry) != limits(further))
    throw std::logic_error("declared in two ways: " + entry.path);
  entry.read = [first = std::move(entry.read), second = std::move(further.read)](const std::string &text) {
    first(text);
    second(text);
  };
}

Entry &Parameters::declared(const std::string &path) {
  return entries_.at(position(path));
}

std::size_t Parameters::position(const std::string &path) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry &entry) { return entry.path == path; });
  return static_cast<std::size_t>(found - entries_.begin());
}

const Entry *Parameters::find(const std::string &path) const {
  const std::size_t k = position(path);
  return k == entries_.size() ? nullptr : &entries_[k];
}

const Entry &Parameters::at(const std::string &path) const {
  const Entry *entry = find(path);
  if (entry == nullptr) throw std::out_of_range("no entry " + path);
  return *entry;
}

bool Parameters::is_section(const std::string &path) const {
  return std::find(sections_.begin(), sections_.end(), path) != sections_.end();
}

bool Parameters::is_foreign(const std::string &path) const {
  return std::find(foreign_.begin(), foreign_.end(), path.substr(0, path.find('/'))) != foreign_.end();
}

void Parameters::enter(const std::string &path, const Origin &origin) const {
  if (is_section(path) || is_foreign(path)) return;
  std::string message =
      origin.text() + ": error: " + shown(path) + " is not a section" + look_alike_in(path) + ".";
  if (path.find('/') != std::string::npos && is_section(last_name(path)))
    throw EntryError(message + " Is the \"end\" of section " + section_of(path) + " missing before it?",
                     origin, path);
  if (const std::string last = last_of_its_kind(path); !last.empty())
    throw EntryError(message + " The last one is " + last + ".", origin, path);
  const std::string nearest = nearest_section(path);
  if (!nearest.empty()) throw EntryError(message + " Did you mean \"" + nearest + "\"?", origin, nearest);
  throw EntryError(message + "\n" + contents_of(section_of(path)), origin, "");
}

std::string Parameters::last_of_its_kind(const std::string &path) const {
  const std::size_t digits = path.find_last_not_of("0123456789") + 1;
  if (digits == path.size()) return "";
  std::string last;
  for (const std::string &section : sections_)
    if (section.find_last_not_of("0123456789") + 1 == digits &&
        section.compare(0, digits, path, 0, digits) == 0 && section.size() > digits)
      last = section; // in the order of their numbers
  return last;
}

std::string Parameters::nearest_section(const std::string &path) const {
  std::vector<std::string> siblings;
  for (const std::string &section : sections_)
    if (section_of(section) == section_of(path)) siblings.push_back(last_name(section));
  const std::string outer = section_of(path);
  if (outer.empty()) siblings.insert(siblings.end(), foreign_.begin(), foreign_.end());
  const std::string sibling = nearest_word(last_name(path), siblings);
  if (!sibling.empty()) return (outer.empty() ? "" : outer + "/") + sibling;
  for (const std::string &section : sections_) // right name, wrong place
    if (a_slip_apart(last_name(section), last_name(path))) return section;
  return "";
}

std::string Parameters::contents_of(const std::string &section) const {
  std::string names;
  const auto add = [&](const std::string &path) {
    if (section_of(path) == section) names += (names.empty() ? "" : ", ") + last_name(path);
  };
  for (const std::string &inner : sections_)
    add(inner);
  for (const Entry &entry : entries_)
    add(entry.path);
  return (section.empty() ? "Sections: " : "Section " + section + " holds: ") + names + ".";
}

void Parameters::refuse_unknown(const std::string &path, const Origin &origin) const {
  const std::string section = section_of(path);
  if (!section.empty()) enter(section, origin);
  const std::string key = last_name(path);
  std::vector<std::string> keys, everywhere, last_names;
  for (const Entry &entry : entries_) {
    if (section_of(entry.path) == section) keys.push_back(last_name(entry.path));
    if (a_slip_apart(last_name(entry.path), key)) last_names.push_back(entry.path);
    everywhere.push_back(entry.path);
  }
  const std::string message =
      origin.text() + ": error: " + shown(path) + " is not a parameter" + look_alike_in(path) + ".";
  std::string nearest = nearest_word(key, keys);
  if (nearest.empty() || !a_slip_apart(nearest, key))
    if (const std::vector<std::string> longer = keys_with(key, keys); !longer.empty()) {
      std::string names;
      for (std::size_t k = 0; k < longer.size(); ++k)
        names += (k == 0                  ? "\""
                  : k + 1 < longer.size() ? ", \""
                                          : " or \"") +
                 section + "/" + longer[k] + "\"";
      throw EntryError(message + " Did you mean " + names + "?", origin, section + "/" + longer.front());
    }
  if (!nearest.empty())
    nearest = (section.empty() ? "" : section + "/") + nearest;
  else if (!last_names.empty())
    nearest = last_names.front(); // right key, wrong section
  else
    nearest = nearest_word(path, everywhere);
  if (nearest.empty()) throw EntryError(message + "\n" + contents_of(section), origin, "");
  const std::string about = limits(at(nearest));
  throw EntryError(
      message + " Did you mean \"" + nearest + "\"" + (about.empty() ? "" : " (" + about + ")") + "?", origin,
      nearest);
}

void Parameters::set(const std::string &path, const std::string &text, const Origin &origin) {
  if (is_foreign(path)) return;
  if (find(path) == nullptr) refuse_unknown(path, origin);
  Entry &entry = declared(path);
  if (entry.origin.line > 0 && origin.depth >= entry.origin.depth)
    throw EntryError(origin.text() + ": error: " + path + " = " + shown(trimmed(text)) +
                         " is set twice: it was set to \"" + shown(entry.text) + "\" in " +
                         entry.origin.text() + ". Allowed: once.",
                     origin, path);
  const std::string value = trimmed(text);
  try {
    check_characters(value);
    if (value.empty() && !entry.default_text.empty()) throw ValueError("has no value");
    entry.read(value);
  } catch (const ValueError &error) {
    const std::string about = limits(entry);
    std::string reason = error.what();
    if (reason.back() != '.' && reason.back() != '?') reason += '.';
    if (first_look_alike(value)) reason += " It holds " + text_of_odd_character(value) + ".";
    throw EntryError(origin.text() + ": error: " + path + " = " + shown(value) + (value.empty() ? "" : " ") +
                         reason + (about.empty() ? "" : " Allowed: " + about + "."),
                     origin, path);
  }
  if (entry.origin.option == 0) entry.of_file = entry.text;
  entry.text = value;
  entry.origin = origin;
}

void Parameters::require_seen(const std::string &path, const std::string &value, const std::string &whole,
                              const Origin &origin) const {
  const Entry *entry = find(path);
  const std::string fault = unseen_in(value, whole);
  if (fault.empty() || entry == nullptr || entry->is_file || entry->is_text) return;
  throw EntryError(origin.text() + ": error: " + path + " = " + shown(trimmed(value)) + " " + fault, origin,
                   path);
}

void Parameters::supply(const std::string &path, const std::string &text) {
  supply(path, text, {"", 0, std::numeric_limits<int>::max()});
}

void Parameters::supply(const std::string &path, const std::string &text, const Origin &word) {
  Entry &entry = declared(path);
  if (!entry.origin.file.empty() && entry.origin.depth <= word.depth) return;
  entry.read(text);
  entry.text = text;
  entry.origin = {};
}

void Parameters::override_entry(const std::string &assignment, int number) {
  const Origin origin{"command line, --set " + std::to_string(number), 0, -1, number};
  const auto equals = assignment.find('=');
  if (equals == std::string::npos)
    throw EntryError(
        origin.text() + ": error: \"" + shown(assignment) +
            "\" sets nothing. Allowed: \"Section/Key = value\", e.g. \"Contact/Friction = 0.3\".",
        origin, "");
  const std::string key = assignment.substr(0, equals), fault = unseen_in(key, assignment);
  if (!fault.empty())
    throw EntryError(origin.text() + ": error: \"" + shown(assignment) + "\" " + fault, origin, "");
  std::string path, part;
  const std::string names = key + "/";
  for (const char c : names) {
    if (c != '/') {
      part += c;
      continue;
    }
    path += (path.empty() ? "" : "/") + tidy(part);
    part.clear();
  }
  const std::string value = assignment.substr(equals + 1);
  require_seen(path, value, assignment, origin);
  set(path, value, origin);
}

void Parameters::refuse(const std::string &path, const std::string &reason) const {
  const Entry &entry = at(path);
  const std::string scene = sources_.empty() ? "" : sources_.front();
  const Origin origin = entry.origin.file.empty() ? Origin{scene, 0, 0, 0} : entry.origin;
  const std::string place = origin.text();
  throw EntryError((place.empty() ? "" : place + ": ") + "error: " + path +
                       (entry.text.empty() ? "" : " = " + shown(entry.text)) + " " + reason,
                   origin, path);
}

void Parameters::refuse(const BadParameter &error) const {
  const std::string member = error.owner + "." + error.member, entry = entry_of(member);
  if (entry == member) throw error;
  refuse(entry, error.reason);
}

std::string Parameters::entry_of(const std::string &member) const {
  for (const Entry &entry : entries_)
    if (std::find(entry.members.begin(), entry.members.end(), member) != entry.members.end())
      return entry.path;
  return member;
}

std::string Parameters::with_entries(const std::string &message) const {
  std::string text;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t open = message.find('`', at), close = message.find('`', open + 1);
    if (open == std::string::npos || close == std::string::npos) return text + message.substr(at);
    text += message.substr(at, open - at) + entry_of(message.substr(open + 1, close - open - 1));
    at = close + 1;
  }
  return text;
}

// "Bond/Radius" is not named by "Bond/Radius rule is ...": the longest entry that stands there is.
bool Parameters::names_a_fault(const std::string &message) const {
  const auto names = [&](const std::string &faulty) {
    for (std::size_t at = message.find(faulty); at != std::string::npos; at = message.find(faulty, at + 1)) {
      const bool longer = std::any_of(entries_.begin(), entries_.end(), [&](const Entry &entry) {
        return entry.path.size() > faulty.size() && message.compare(at, entry.path.size(), entry.path) == 0;
      });
      if (!longer || is_section(faulty)) return true;
    }
    return false;
  };
  return std::any_of(faults_.all().begin(), faults_.all().end(),
                     [&](const EntryError &one) { return !one.entry.empty() && names(one.entry); });
}

void Parameters::add_independent(const Faults &found) {
  for (const EntryError &one : found.all())
    if (!faults_.concern(one.entry) && !names_a_fault(one.what())) faults_.add(one);
}

void Parameters::throw_faults() const {
  if (!faults_.empty()) throw SceneFaults(faults_.text(sources_), faults_.sorted(sources_));
}

void Parameters::pretend(const std::string &path, const std::string &word) {
  Entry &entry = declared(path);
  entry.text = word.empty() ? entry.default_text : word;
  entry.read(entry.text);
}

void Parameters::release() {
  for (Entry &entry : entries_) {
    entry.read = nullptr;
    entry.idle.clear();
    entry.needed.clear();
  }
}

} // namespace platen::apps
