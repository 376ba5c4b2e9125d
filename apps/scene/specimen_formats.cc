#include "apps/scene/specimen_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

#include "apps/output/numbers.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

using Reading = SpecimenReading;
using Part = Reading::Part;
enum SphereColumn : std::size_t { x, y, z, radius, id };

const KnownColumns &columns_of_spheres(bool with_ids) {
  static const KnownColumns spheres{
      {{"x", x}, {"y", y}, {"z", z}, {"radius", radius}, {"r", radius}, {"diameter", radius, 0.5}}, 4, 4};
  static const KnownColumns named = [] {
    KnownColumns all = spheres;
    all.words.push_back({"id", id});
    return all;
  }();
  return with_ids ? named : spheres;
}

bool begins(std::string_view line, std::string_view words) {
  return line.substr(0, words.size()) == words;
}

std::vector<std::string> words_of(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
    words.push_back(word);
  return words;
}

bool any_line(const std::vector<std::string> &lines, bool (*is)(const std::string &)) {
  return std::any_of(lines.begin(), lines.end(), is);
}

dem::Shape read_shape(std::string_view text, const TextPlace &place) {
  std::istringstream words{std::string(text)};
  std::string kind;
  words >> kind;
  dem::Shape shape;
  std::map<std::string, double *> wanted;
  if (kind == "cylinder")
    wanted = {{"radius_m", &shape.radius}, {"height_m", &shape.height}};
  else if (kind == "disc")
    wanted = {{"radius_m", &shape.radius}, {"thickness_m", &shape.width_y}};
  else if (kind == "box")
    wanted = {{"width_x_m", &shape.width_x}, {"width_y_m", &shape.width_y}, {"height_m", &shape.height}};
  else
    place.fail(fmt::format("shape \"{}\" is not known; allowed: cylinder, box, disc", kind));
  shape.kind = kind == "cylinder" ? dem::ShapeKind::cylinder : dem::ShapeKind::box;
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    const auto found = wanted.find(word.substr(0, equals));
    const auto value = equals == std::string::npos ? std::nullopt : number_of(word.substr(equals + 1));
    if (found == wanted.end() || !value || !std::isfinite(*value) || !(*value > 0))
      place.fail(fmt::format("shape {}: \"{}\" is no dimension of it with a positive number", kind, word));
    *found->second = *value;
    wanted.erase(found);
  }
  if (!wanted.empty()) place.fail(fmt::format("shape {}: {} is missing", kind, wanted.begin()->first));
  if (kind == "disc") return dem::disc(shape.radius, shape.width_y);
  return shape;
}

void take_columns(Reading &r, std::string_view line) {
  if (line.front() == '#') return r.take_comment(line);
  const bool words = r.read.specimen.size() == 0 && r.table.is_row_of_words(line);
  if (!r.form.columns.empty() && words)
    r.place.fail(
        fmt::format("\"{}\" is a header, and Specimen/File columns names the columns too. Allowed: "
                    "one of them.",
                    cut_short(line)));
  if (r.table.is_named()) return r.take_row(line);
  if (!words)
    r.place.fail(
        fmt::format("\"{}\" is not the header line, which names the columns as in \"{}\". Allowed: "
                    "a header, or Specimen/File columns for a file without one.",
                    cut_short(line), specimen_header));
  r.table.take_header(line, r.place);
}

// "#format x_y_z_r_matId": the names of the columns. Of attrs nobody says how many values they are.
void take_yade(Reading &r, std::string_view line) {
  constexpr std::string_view format = "#format";
  const bool names = begins(line, format);
  std::string columns = names ? std::string(trimmed(line.substr(format.size()))) : "x_y_z_r";
  std::replace(columns.begin(), columns.end(), '_', ' ');
  if (names || (!r.table.is_named() && line.front() != '#'))
    r.table.take_names(columns, ' ', names ? "#format" : "Yade's x_y_z_r", r.place,
                       columns.find("attrs") == columns.npos ? 0 : TextTable::any);
  if (line.front() == '#')
    r.take_comment(line);
  else
    r.take_row(line);
}

// Lengths are m in SI; of a file that does not say so it is told.
void take_units(Reading &r, const std::string &units) {
  if (units != "si" && units != "lj")
    r.place.fail(fmt::format("units are \"{}\". Allowed: si, lengths in m.", cut_short(units)));
  r.states_si = units == "si";
}

void take_count(Reading &r, std::string_view text) {
  const std::optional<double> count = number_of(text);
  if (!count || *count != std::floor(*count) || *count < 0)
    r.place.fail(fmt::format("\"{}\" is no number of atoms. Allowed: a whole number.", cut_short(text)));
  r.atoms = count;
}

void take_bounds(Reading &r, const std::vector<std::string> &words, const std::string &axis) {
  const std::optional<double> low = number_of(words.at(0)), high = number_of(words.at(1));
  if (!low || !high)
    r.place.fail(fmt::format("bounds \"{}\" and \"{}\" of the box{} are not two numbers", cut_short(words[0]),
                             cut_short(words[1]), axis));
  if (!(*low < *high))
    r.place.fail(fmt::format("the box{} is flat, from {} to {}. Allowed: the first number below the second.",
                             axis, *low, *high));
}

void require_all_atoms(Reading &r) {
  if (!r.atoms) r.place.fail("nothing says how many atoms there are");
  const std::size_t found = r.read.specimen.size();
  if (static_cast<double>(found) != *r.atoms)
    r.place.fail(fmt::format("lists {} atoms, where {} are told", found, *r.atoms));
}

void end_lammps(Reading &r) {
  r.place.line = 0;
  if (!r.has_atoms) r.place.fail("lists no atoms");
  require_all_atoms(r);
  if (!r.states_si) r.read.notes.emplace_back("lengths without a unit: m");
}

void take_data_header(Reading &r, std::string_view line) {
  const std::vector<std::string> words = words_of(line);
  if (words.size() == 2 && words[1] == "atoms") return take_count(r, words[0]);
  if (words.size() == 4 && words[2].size() == 3 && words[2].substr(1) == "lo")
    take_bounds(r, words, std::string(" along ") + words[2][0]);
}

void take_data(Reading &r, std::string_view line) {
  constexpr std::string_view units = "units = ";
  if (r.place.line == 1) { // a title, whatever stands there
    if (const auto at = line.find(units); at != line.npos)
      take_units(r, std::string(trimmed(line.substr(at + units.size()))));
    return r.take_comment(line);
  }
  const auto hash = std::min(line.find('#'), line.size());
  const std::string_view text = trimmed(line.substr(0, hash)),
                         style = hash < line.size() ? trimmed(line.substr(hash + 1)) : "";
  if (text.empty()) return r.take_comment(line);
  if (std::isalpha(static_cast<unsigned char>(text.front())) != 0) {
    r.part = text == "Atoms" ? Part::atoms : Part::other;
    if (r.part == Part::other) return;
    if (!style.empty() && style != "sphere")
      r.place.fail(fmt::format("atoms are of style \"{}\". Allowed: sphere.", cut_short(style)));
    constexpr std::size_t image_flags = 3;
    r.table.take_names("id type diameter density x y z", ' ', "atom style sphere", r.place, image_flags);
    r.has_atoms = true;
  } else if (r.part == Part::header) {
    take_data_header(r, text);
  } else if (r.part == Part::atoms) {
    r.take_row(text);
  }
}

// "ATOMS id type xu yu zu radius": coordinates that are not wrapped are as good.
void take_atom_columns(Reading &r, std::string_view names) {
  std::string columns;
  for (std::string word : words_of(names)) {
    const bool coordinate = word.find_first_of("xyz") == 0;
    if (coordinate && (word.substr(1) == "s" || word.substr(1) == "su"))
      r.place.fail(fmt::format(
          "\"{}\" is a scaled coordinate, a share of the box. Allowed: x, y, z, or xu, yu, zu.", word));
    if (coordinate && word.substr(1) == "u") word.resize(1);
    columns += word + ' ';
  }
  r.table.take_names(columns, ' ', "ITEM: ATOMS", r.place);
  r.read.specimen = {}, r.read.ids.clear();
  r.has_atoms = true;
}

void take_item(Reading &r, std::string_view item) {
  constexpr std::string_view atoms = "ATOMS";
  const bool new_frame = item == "TIMESTEP" && r.has_atoms;
  if (new_frame) require_all_atoms(r);
  r.part = item == "NUMBER OF ATOMS"    ? Part::count
           : item == "UNITS"            ? Part::units
           : begins(item, "BOX BOUNDS") ? Part::bounds
           : begins(item, atoms)        ? Part::atoms
                                        : Part::other;
  if (r.part == Part::atoms) take_atom_columns(r, item.substr(atoms.size()));
}

void take_dump(Reading &r, std::string_view line) {
  constexpr std::string_view item = "ITEM:";
  if (begins(line, item)) return take_item(r, trimmed(line.substr(item.size())));
  if (r.part == Part::atoms) return r.take_row(line);
  if (r.part == Part::units) return take_units(r, std::string(line));
  if (r.part == Part::count) return take_count(r, line);
  if (r.part != Part::bounds) return;
  std::vector<std::string> words = words_of(line);
  words.resize(2);
  take_bounds(r, words, "");
}

void end_at_once(Reading &) {}

} // namespace

SpecimenReading::SpecimenReading(const SpecimenForm &how)
    : form(how), table(columns_of_spheres(how.with_ids)) {}

void SpecimenReading::take_row(std::string_view line) {
  table.read_row(line, place);
  const double r = table.value(radius);
  if (!(r > 0)) place.fail(fmt::format("column {}: {} is not positive", cut_short(table.label(radius)), r));
  read.specimen.centre.push_back({table.value(x), table.value(y), table.value(z)});
  read.specimen.radius.push_back(r);
  if (form.with_ids && table.has(id)) read.ids.push_back(table.value(id));
}

void SpecimenReading::take_comment(std::string_view line) {
  if (!begins(line, specimen_shape_words)) return;
  read.specimen.shape = read_shape(line.substr(specimen_shape_words.size()), place);
  read.states_shape = true;
}

const std::vector<SpecimenFormatRule> &specimen_formats() {
  using Lines = std::vector<std::string>;
  static const std::vector<SpecimenFormatRule> all{
      {"lammps dump", SpecimenFormat::lammps_dump,
       [](const Lines &first) { return begins(first.front(), "ITEM:"); }, take_dump, end_lammps},
      {"lammps data", SpecimenFormat::lammps_data,
       [](const Lines &first) {
         return any_line(first, [](const std::string &line) {
           const std::vector<std::string> words = words_of(line);
           return words.size() == 2 && words[1] == "atoms" && number_of(words[0]);
         });
       },
       take_data, end_lammps},
      {"yade", SpecimenFormat::yade,
       [](const Lines &first) {
         return any_line(first, [](const std::string &line) { return begins(line, "#format "); });
       },
       take_yade, end_at_once},
      {"columns", SpecimenFormat::columns, [](const Lines &) { return true; }, take_columns, end_at_once}};
  return all;
}

} // namespace platen::apps
