// What a name that is not known was meant to be: the nearest one, longer keys that hold it, the right name in
// another place, characters that look alike.
#include <algorithm>
#include <utility>

#include "apps/scene/parameters.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

// Keys that are no more, and what is written instead.
constexpr const char *in_a_cell =
    "Calibrate/Target 1 = strength_pa at Loading/Confinement = particles, Loading/Confining pressure = 9 "
    "MPa: "
    "82 MPa";
constexpr std::pair<const char *, const char *> replaced[] = {
    {"Calibrate/Young modulus", "Calibrate/Target 1 = young modulus: 25 GPa"},
    {"Calibrate/Poisson ratio", "Calibrate/Target 1 = poisson ratio: 0.2"},
    {"Calibrate/Compressive strength", "Calibrate/Target 1 = strength_pa: 40 MPa"},
    {"Calibrate/Tensile strength", "Calibrate/Target 1 = tension: 4 MPa"},
    {"Calibrate/Triaxial strength", in_a_cell},
    {"Calibrate/Confining pressure", in_a_cell}};

std::string within(const std::string &section, const std::string &name) {
  return section.empty() ? name : section + "/" + name;
}

bool a_slip_apart(const std::string &a, const std::string &b) {
  const std::size_t longer = std::max(a.size(), b.size()), shorter = std::min(a.size(), b.size());
  return longer - shorter <= 1 && edit_distance(a, b) <= 1;
}

// ": it holds U+0421 (Cyrillic letter) in column 1" of what looks like a known name and is none.
std::string look_alike_in(const std::string &text) {
  return first_look_alike(text) ? ": it holds " + text_of_odd_character(text) : "";
}

// Whether `key` is some of the words of a longer one: "Friction" of "Friction static".
bool has_words(const std::string &longer, const std::string &key) {
  const auto padded = [](std::string text) {
    for (char &c : text)
      c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return " " + text + " ";
  };
  return padded(longer).find(padded(key)) != std::string::npos;
}

} // namespace

// All names that stand in a section, "" the file.
std::string Parameters::contents_of(const std::string &section) const {
  std::vector<std::string> names;
  for (const std::string &inner : sections_)
    if (section_of(inner) == section) names.push_back(last_name(inner));
  for (const Entry &entry : entries_)
    if (section_of(entry.path) == section) names.push_back(last_name(entry.path));
  return (section.empty() ? "\nSections: " : "\nSection " + section + " holds: ") + joined(names) + ".";
}

EntryError Parameters::unknown_section(const std::string &path, const Origin &origin) const {
  const std::string message =
      origin.text() + ": error: " + shown(path) + " is not a section" + look_alike_in(path) + ".";
  const std::string outer = section_of(path), name = last_name(path);
  if (!outer.empty() && is_section(name))
    return {message + " Is the \"end\" of section " + outer + " missing before it?", origin, path};
  for (const Series &one : series_)
    if (path.rfind(one.prefix, 0) == 0 &&
        path.find_first_not_of("0123456789", one.prefix.size()) == std::string::npos)
      return {message + " The last one is " + one.prefix + std::to_string(one.most) + ".", origin, path};
  std::vector<std::string> siblings = outer.empty() ? foreign_ : std::vector<std::string>{};
  for (const std::string &section : sections_)
    if (section_of(section) == outer) siblings.push_back(last_name(section));
  std::string nearest = nearest_word(name, siblings);
  if (!nearest.empty()) nearest = within(outer, nearest);
  for (const std::string &section : sections_) // right name, wrong place
    if (nearest.empty() && a_slip_apart(last_name(section), name)) nearest = section;
  if (nearest.empty()) return {message + contents_of(outer), origin, ""};
  return {message + " Did you mean \"" + nearest + "\"?", origin, nearest};
}

EntryError Parameters::unknown_entry(const std::string &path, const Origin &origin) const {
  constexpr std::size_t most_longer = 4; // more say nothing
  const std::string section = section_of(path), key = last_name(path);
  if (!section.empty() && !is_section(section)) return unknown_section(section, origin);
  const std::string message =
      origin.text() + ": error: " + shown(path) + " is not a parameter" + look_alike_in(path) + ".";
  for (const auto &[former, now] : replaced)
    if (path == former) return {message + " Allowed: " + now + ".", origin, ""};
  std::vector<std::string> keys, longer, everywhere;
  std::string elsewhere;
  for (const Entry &entry : entries_) {
    const std::string name = last_name(entry.path);
    everywhere.push_back(entry.path);
    if (elsewhere.empty() && a_slip_apart(name, key)) elsewhere = entry.path;
    if (section_of(entry.path) != section) continue;
    keys.push_back(name);
    if (has_words(name, key)) longer.push_back(entry.path);
  }
  std::string nearest = nearest_word(key, keys);
  if ((nearest.empty() || !a_slip_apart(nearest, key)) && !longer.empty() && longer.size() <= most_longer) {
    std::string names;
    for (std::size_t k = 0; k < longer.size(); ++k)
      names += (k == 0 ? "\"" : k + 1 < longer.size() ? ", \"" : " or \"") + longer[k] + "\"";
    return {message + " Did you mean " + names + "?", origin, longer.front()};
  }
  if (!nearest.empty())
    nearest = within(section, nearest);
  else
    nearest = !elsewhere.empty() ? elsewhere : nearest_word(path, everywhere);
  if (nearest.empty()) return {message + contents_of(section), origin, ""};
  const std::string about = limits(at(nearest));
  return {message + " Did you mean \"" + nearest + "\"" + (about.empty() ? "" : " (" + about + ")") + "?",
          origin, nearest};
}

} // namespace platen::apps
