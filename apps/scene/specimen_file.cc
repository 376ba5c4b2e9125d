#include "apps/scene/specimen_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

#include "apps/output/numbers.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

constexpr const char *columns[] = {"x_m", "y_m", "z_m", "radius_m"};
constexpr std::size_t shown = 60; // characters of a faulty line, which may be anything

// A file while it is read: knows where it is, for messages.
struct Place {
  std::string file;
  std::size_t line = 0;
  std::string_view text; // of that line, of which a character that nobody sees is named
  [[noreturn]] void fail(const std::string &what) const {
    const std::string odd = text_of_odd_character(text);
    throw InputError(
        fmt::format("{}:{}: error: {}{}", file, line, what, odd.empty() ? "" : "; the line holds " + odd));
  }
};

// Calls take(line) for each line and keeps the place. Lines end with \n, \r\n or \r.
template <class Take>
void read_lines(const std::filesystem::path &path, Place &place, const Take &take) {
  place.file = path.string();
  std::ifstream stream = open_file(path);
  if (!stream) throw InputError(place.file + ": error: cannot be read");
  for (std::string whole; std::getline(stream, whole);) {
    if (!whole.empty() && whole.back() == '\r') whole.pop_back();
    for (std::size_t first = 0; first <= whole.size();) {
      const std::size_t end = std::min(whole.find('\r', first), whole.size());
      ++place.line;
      place.text = std::string_view(whole).substr(first, end - first);
      take(place.text);
      first = end + 1;
    }
  }
  place.text = {};
  if (stream.bad()) throw InputError(place.file + ": error: cannot be read to its end");
}

dem::Shape read_shape(std::string_view text, const Place &place) {
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

void read_row(std::string_view row, const Place &place, dem::Specimen &specimen) {
  double values[4] = {};
  std::size_t begin = 0;
  for (int k = 0; k < 4; ++k) {
    const auto comma = row.find(',', begin);
    if ((comma == std::string_view::npos) != (k == 3))
      place.fail(fmt::format("a row has four values ({})", specimen_header));
    const std::string_view text = trimmed(row.substr(begin, comma - begin));
    const auto value = number_of(text);
    if (!value || !std::isfinite(*value))
      place.fail(fmt::format("column {}: \"{}\" is not a finite number", columns[k], text));
    values[k] = *value;
    begin = comma + 1;
  }
  if (!(values[3] > 0)) place.fail(fmt::format("column radius_m: {} is not positive", values[3]));
  specimen.centre.push_back({values[0], values[1], values[2]});
  specimen.radius.push_back(values[3]);
}

} // namespace

SpecimenFile read_specimen_csv(const std::filesystem::path &path) {
  Place place;
  SpecimenFile read;
  bool has_header = false;
  read_lines(path, place, [&](std::string_view line) {
    if (place.line == 1 && line.substr(0, 3) == "\xef\xbb\xbf") line.remove_prefix(3);
    line = trimmed(line);
    if (line.empty()) return;
    if (line.front() == '#') {
      if (line.substr(0, specimen_shape_words.size()) != specimen_shape_words) return;
      read.specimen.shape = read_shape(line.substr(specimen_shape_words.size()), place);
      read.states_shape = true;
    } else if (has_header) {
      read_row(line, place, read.specimen);
    } else if (line == specimen_header) {
      has_header = true;
    } else {
      place.fail(fmt::format("\"{}\" is not the header line \"{}\"", line.substr(0, shown), specimen_header));
    }
  });
  if (read.specimen.size() == 0) place.fail("the file holds no sphere");
  return read;
}

std::vector<int> read_id_list(const std::filesystem::path &path, std::size_t spheres) {
  Place place;
  std::vector<int> ids;
  std::map<int, std::size_t> line_of;
  read_lines(path, place, [&](std::string_view line) {
    const std::string_view text = trimmed(line.substr(0, line.find('#')));
    if (text.empty()) return;
    int id = -1;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (failure != std::errc() || end != text.data() + text.size() || id < 0)
      place.fail(
          fmt::format("\"{}\" is no id. Allowed: a whole number, 0 or more, a line.", text.substr(0, shown)));
    if (static_cast<std::size_t>(id) >= spheres)
      place.fail(fmt::format("names sphere {}, but the specimen has {}. Allowed: 0 ... {}.", id, spheres,
                             spheres - 1));
    const auto [found, fresh] = line_of.try_emplace(id, place.line);
    if (!fresh) place.fail(fmt::format("{} stands in line {} too.", id, found->second));
    ids.push_back(id);
  });
  return ids;
}

} // namespace platen::apps
