#include "apps/scene/parameters.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "apps/scene/units.h"
#include "base/characters.h"

namespace platen::apps {

std::string limits(const Entry &entry) {
  std::string text = entry.allowed;
  if (!entry.unit.empty() && entry.unit != "1") text += (text.empty() ? "in " : " ") + entry.unit;
  if (!entry.default_text.empty()) text += (text.empty() ? "default " : ", default ") + entry.default_text;
  return text;
}

std::string resolved_path(const Entry &entry) {
  if (entry.text.empty() || entry.origin.line == 0) return entry.text;
  return (std::filesystem::path(entry.origin.file).parent_path() / entry.text).string();
}

Entry &Parameters::declare(Entry entry) {
  if (find(entry.path) != nullptr) throw std::logic_error("declared twice: " + entry.path);
  for (auto slash = entry.path.find('/'); slash != std::string::npos; slash = entry.path.find('/', slash + 1))
    if (const std::string section = entry.path.substr(0, slash); !is_section(section)) {
      sections_.push_back(section);
      places_[section] = section_mark;
    }
  entry.text = entry.default_text;
  entry.read(entry.text);
  places_[entry.path] = entries_.size();
  entries_.push_back(std::move(entry));
  return entries_.back();
}

Entry &Parameters::join(Entry further) {
  Entry &entry = declared(further.path);
  if (entry.default_text != further.default_text || limits(entry) != limits(further))
    throw std::logic_error("declared in two ways: " + entry.path);
  entry.read = [first = std::move(entry.read), second = std::move(further.read)](const std::string &text) {
    first(text);
    second(text);
  };
  return entry;
}

void Parameters::declare_series(const std::string &first, std::size_t most,
                                std::function<void(Parameters &, std::size_t)> declare) {
  series_.push_back({first.substr(0, first.size() - 1), most, 0, std::move(declare)});
  declare_further(series_.back());
}

void Parameters::declare_further(Series &series) {
  const std::size_t before = entries_.size();
  series.declare(*this, ++series.declared);
  for (std::size_t k = before; k < entries_.size(); ++k)
    entries_[k].number = series.declared;
}

std::size_t Parameters::number_in(const Series &series, const std::string &path) {
  if (path.rfind(series.prefix, 0) != 0) return 0;
  const std::string digits =
      path.substr(series.prefix.size(), path.find('/', series.prefix.size()) - series.prefix.size());
  if (digits.empty() || digits.size() > 4 || digits[0] == '0') return 0;
  if (digits.find_first_not_of("0123456789") != std::string::npos) return 0;
  const std::size_t number = std::stoul(digits);
  return number <= series.most ? number : 0;
}

void Parameters::declare_written(const std::string &path) {
  for (Series &one : series_)
    for (const std::size_t number = number_in(one, path); one.declared < number;)
      declare_further(one);
}

std::vector<Entry> Parameters::unwritten(const std::string &path) const {
  std::vector<Entry> entries;
  for (const Series &one : series_)
    if (const std::size_t number = number_in(one, path); number > one.declared)
      for (const Entry &first : entries_) {
        if (number_in(one, first.path) != 1) continue;
        Entry entry = first;
        entry.path = one.prefix + std::to_string(number) + first.path.substr(one.prefix.size() + 1);
        entry.text = entry.default_text;
        if (entry.path == path || entry.path.rfind(path + "/", 0) == 0) entries.push_back(entry);
      }
  return entries;
}

const Entry *Parameters::find(const std::string &path) const {
  const auto found = places_.find(path);
  return found == places_.end() || found->second == section_mark ? nullptr : &entries_[found->second];
}

const Entry &Parameters::at(const std::string &path) const {
  const Entry *entry = find(path);
  if (entry == nullptr) throw std::out_of_range("no entry " + path);
  return *entry;
}

Entry &Parameters::declared(const std::string &path) {
  return const_cast<Entry &>(at(path));
}

bool Parameters::is_section(const std::string &path) const {
  const auto found = places_.find(path);
  return found != places_.end() && found->second == section_mark;
}

bool Parameters::is_foreign(const std::string &path) const {
  return std::find(foreign_.begin(), foreign_.end(), path.substr(0, path.find('/'))) != foreign_.end();
}

void Parameters::apply(const FileText &file) {
  sources_.insert(sources_.end(), file.sources.begin(), file.sources.end());
  passed_over_.clear();
  for (const Assignment &one : file.assignments)
    if (!apply(one, file)) return;
}

bool Parameters::apply(const Assignment &one, const FileText &file) {
  const std::string path = one.section.empty() ? one.key : one.section + "/" + one.key;
  if (one.kind == Assignment::Kind::broken) {
    whole_ = false;
    faults_.add({one.origin.text() + ": error: " + one.text, one.origin, ""});
    return true;
  }
  if (!passed_over_.empty() && (one.section + "/").rfind(passed_over_ + "/", 0) == 0) return true;
  if (one.kind == Assignment::Kind::section) {
    if (attempt([&] { open(one, file); })) return true;
    passed_over_ = one.section;
    if (!lacks_end(one.section)) return true;
    whole_ = false;
    return false;
  }
  attempt([&] {
    if (one.kind == Assignment::Kind::wrong)
      throw EntryError(one.origin.text() + ": error: " + one.text, one.origin, begun(path));
    if (is_section(path))
      throw EntryError(one.origin.text() + ": error: " + path + " = " + shown(trimmed(one.text)) +
                           " is a section. Allowed: an object, or subsection " + one.key + " ... end.",
                       one.origin, path);
    set(path, one.text, one.origin, one.line);
  });
  return true;
}

// A section that stands in another one and is known outside: what follows is not of the section that it seems
// to be of.
bool Parameters::lacks_end(const std::string &path) const {
  const auto slash = path.rfind('/');
  return find(path) == nullptr && slash != std::string::npos && is_section(path.substr(slash + 1));
}

void Parameters::open(const Assignment &section, const FileText &file) {
  const std::string &path = section.section, outer = section_of(path);
  declare_written(path);
  if (is_section(path) || is_foreign(path)) return;
  const std::string message = section.origin.text() + ": error: " + shown(path);
  if (find(path) != nullptr)
    throw EntryError(message +
                         " is an object without \"value\", or a section. Allowed: a number, a text, true, "
                         "false.",
                     section.origin, path);
  if (!lacks_end(path)) throw unknown_section(path, section.origin);
  Origin opened;
  for (const Assignment &before : file.assignments) {
    if (&before == &section) break;
    if (before.kind == Assignment::Kind::section && before.section == outer) opened = before.origin;
  }
  throw EntryError(message + " is not a section. Is the \"end\" of section " + last_name(outer) + " (" +
                       opened.text() + ") missing before it?",
                   section.origin, path);
}

std::string Parameters::begun(const std::string &text) const {
  std::string longest;
  for (const Entry &entry : entries_)
    if (entry.path.size() > longest.size() && text.rfind(entry.path, 0) == 0) longest = entry.path;
  return longest;
}

void Parameters::set(const std::string &path, const std::string &text, const Origin &origin,
                     const std::string &line) {
  if (is_foreign(path)) return;
  declare_written(path);
  if (find(path) == nullptr) throw unknown_entry(path, origin);
  Entry &entry = declared(path);
  const std::string value = trimmed(text);
  const auto fail = [&](const std::string &reason) {
    throw EntryError(
        origin.text() + ": error: " + path + " = " + shown(value) + (value.empty() ? "" : " ") + reason,
        origin, path);
  };
  if (const std::string unseen = unseen_in(text, line); !unseen.empty() && !entry.is_file && !entry.is_text)
    fail(unseen);
  if (entry.origin.line > 0 && origin.depth >= entry.origin.depth)
    fail("is set twice: it was set to \"" + shown(entry.text) + "\" in " + entry.origin.text() +
         ". Allowed: once.");
  try {
    check_characters(value);
    if (value.empty() && !entry.default_text.empty()) throw ValueError("has no value");
    entry.read(value);
  } catch (const ValueError &error) {
    const std::string about = limits(entry);
    std::string reason = error.what();
    if (reason.back() != '.' && reason.back() != '?') reason += '.';
    if (first_look_alike(value)) reason += " It holds " + text_of_odd_character(value) + ".";
    fail(reason + (about.empty() ? "" : " Allowed: " + about + "."));
  }
  if (entry.origin.option == 0) entry.of_file = entry.text;
  entry.text = value;
  entry.origin = origin;
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
  const auto fail = [&](const std::string &what) {
    throw EntryError(origin.text() + ": error: \"" + shown(assignment) + "\" " + what, origin, "");
  };
  const auto equals = assignment.find('=');
  if (equals == std::string::npos)
    fail("sets nothing. Allowed: \"Section/Key = value\", e.g. \"Contact/Friction = 0.3\".");
  const std::string names = assignment.substr(0, equals), unseen = unseen_in(names, assignment);
  if (!unseen.empty()) fail(unseen);
  std::string path; // blanks beside slashes mean nothing
  for (std::size_t first = 0; first <= names.size();) {
    const std::size_t slash = std::min(names.find('/', first), names.size());
    path += (path.empty() ? "" : "/") + tidy(names.substr(first, slash - first));
    first = slash + 1;
  }
  set(path, assignment.substr(equals + 1), origin, assignment);
}

void Parameters::pretend(const std::string &path, const std::string &word) {
  Entry &entry = declared(path);
  entry.text = word.empty() ? entry.default_text : word;
  entry.read(entry.text);
}

void Parameters::refuse(const std::string &path, const std::string &reason) const {
  const Entry &entry = at(path);
  const Origin origin =
      entry.origin.file.empty() ? Origin{sources_.empty() ? "" : sources_.front()} : entry.origin;
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
    for (std::size_t at = message.find(faulty); at != std::string::npos; at = message.find(faulty, at + 1))
      if (is_section(faulty) || begun(message.substr(at)) == faulty) return true;
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

void Parameters::release() {
  for (Entry &entry : entries_)
    entry.read = nullptr, entry.idle.clear(), entry.needed.clear();
  for (Series &one : series_)
    one.declare = nullptr;
}

} // namespace platen::apps
