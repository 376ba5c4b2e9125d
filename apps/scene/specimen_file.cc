#include "apps/scene/specimen_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "apps/output/numbers.h"
#include "apps/scene/specimen_formats.h"

namespace platen::apps {
namespace {

// The lines of a file by which its format is seen, without empty ones.
std::vector<std::string> first_lines(const std::filesystem::path &path) {
  constexpr std::size_t enough = 30;
  TextPlace place;
  std::vector<std::string> lines;
  read_lines(path, place, [&](std::string_view line) {
    if (!trimmed(line).empty()) lines.emplace_back(trimmed(line));
    return lines.size() < enough && place.line < enough;
  });
  return lines;
}

const SpecimenFormatRule &format_of(const std::filesystem::path &path, SpecimenFormat wanted) {
  const std::vector<SpecimenFormatRule> &all = specimen_formats();
  if (wanted == SpecimenFormat::automatic) {
    const std::vector<std::string> lines = first_lines(path);
    if (lines.empty()) return all.back();
    return *std::find_if(all.begin(), all.end(),
                         [&](const SpecimenFormatRule &rule) { return rule.is_one(lines); });
  }
  return *std::find_if(all.begin(), all.end(),
                       [&](const SpecimenFormatRule &rule) { return rule.format == wanted; });
}

// Stands the spheres on z = 0, in the middle, and takes for the shape what their surfaces reach.
void fill(dem::ShapeKind kind, SpecimenFile &file) {
  dem::Specimen &specimen = file.specimen;
  const dem::BoundingBox box = dem::bounding_box(specimen);
  const Vector3 from{0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y), box.low.z};
  const Vector3 widths = box.high - box.low;
  double reach = 0; // from the axis
  for (std::size_t k = 0; k < specimen.size(); ++k) {
    Vector3 &c = specimen.centre[k];
    c = c - from;
    reach = std::max(reach, std::hypot(c.x, c.y) + specimen.radius[k]);
  }
  const bool round = kind == dem::ShapeKind::cylinder;
  specimen.shape = round ? dem::cylinder(reach, widths.z) : dem::box(widths.x, widths.y, widths.z);
  file.notes.push_back(fmt::format(
      "neither it nor the scene states the shape: {}, which the spheres reach",
      round ? fmt::format("a cylinder of radius {:.6g} mm and height {:.6g} mm", 1e3 * reach, 1e3 * widths.z)
            : fmt::format("a box of {:.6g} x {:.6g} x {:.6g} mm", 1e3 * widths.x, 1e3 * widths.y,
                          1e3 * widths.z)));
  if (norm(from) > 0)
    file.notes.push_back(
        fmt::format("spheres are moved by {:.6g}, {:.6g}, {:.6g} mm, onto z = 0 and about x = y = 0",
                    -1e3 * from.x, -1e3 * from.y, -1e3 * from.z));
}

} // namespace

SpecimenFile read_specimen_file(const std::filesystem::path &path, const SpecimenForm &form) {
  const SpecimenFormatRule &rule = format_of(path, form.format);
  SpecimenReading reading(form);
  reading.place.file = path.string();
  if (!form.columns.empty() && rule.format != SpecimenFormat::columns)
    reading.place.fail(
        fmt::format("is of format {}, which names its columns itself. Allowed: Specimen/File "
                    "columns of files without a header.",
                    rule.word));
  if (!form.columns.empty())
    reading.table.take_names(form.columns, '\0', "Specimen/File columns", reading.place);
  read_lines(path, reading.place, [&](std::string_view line) {
    if (const std::string_view text = trimmed(line); !text.empty()) rule.take(reading, text);
    return true;
  });
  rule.end(reading);
  if (reading.read.specimen.size() == 0) reading.place.fail("the file holds no sphere");
  SpecimenFile &read = reading.read;
  for (std::string &note : reading.table.notes())
    read.notes.push_back(std::move(note));
  if (!read.states_shape && form.filled) fill(*form.filled, read);
  return std::move(read);
}

std::vector<int> read_id_list(const std::filesystem::path &path, std::size_t spheres) {
  TextPlace place;
  std::vector<int> ids;
  std::map<int, std::size_t> line_of;
  read_lines(path, place, [&](std::string_view line) {
    const std::string_view text = trimmed(line.substr(0, line.find('#')));
    if (text.empty()) return true;
    int id = -1;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (failure != std::errc() || end != text.data() + text.size() || id < 0)
      place.fail(
          fmt::format("\"{}\" is no id. Allowed: a whole number, 0 or more, a line.", cut_short(text)));
    if (static_cast<std::size_t>(id) >= spheres)
      place.fail(fmt::format("names sphere {}, but the specimen has {}. Allowed: 0 ... {}.", id, spheres,
                             spheres - 1));
    const auto [found, fresh] = line_of.try_emplace(id, place.line);
    if (!fresh) place.fail(fmt::format("{} stands in line {} too.", id, found->second));
    ids.push_back(id);
    return true;
  });
  return ids;
}

} // namespace platen::apps
