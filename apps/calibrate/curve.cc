#include "apps/calibrate/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "apps/output/numbers.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

constexpr const char *allowed_columns =
    "Allowed: strain_platen or strain_gauge, then stress_pa or stress_mpa, with a comma between them; "
    "platen-report --laboratory FILE --curve NEW makes one of a laboratory's file.";

// A line of the file without the blanks around it; number 0: the file.
struct Line {
  const std::filesystem::path &path;
  int number = 0;
  std::string text = "";

  [[noreturn]] void fail(const std::string &reason) const {
    const std::string odd = text_of_odd_character(text); // that nobody sees
    throw InputError(path.string() + (number > 0 ? ":" + std::to_string(number) : "") + ": error: " + reason +
                     (odd.empty() ? "" : " The line holds " + odd + "."));
  }
  std::vector<std::string> cells() const {
    std::vector<std::string> cells = cells_of(text);
    for (std::string &cell : cells)
      cell = std::string(trimmed(cell));
    return cells;
  }
};

// Pa of a unit of the stress column.
double read_header(const Line &line, Curve &curve) {
  const std::vector<std::string> cells = line.cells();
  if (cells.size() != 2 || (cells[0] != "strain_platen" && cells[0] != "strain_gauge") ||
      (cells[1] != "stress_pa" && cells[1] != "stress_mpa"))
    line.fail("the header \"" + line.text + "\" is not that of a curve. " + allowed_columns);
  curve.of_gauge = cells[0] == "strain_gauge";
  return cells[1] == "stress_mpa" ? 1e6 : 1;
}

void read_row(const Line &line, double unit, Curve &curve) {
  const std::vector<std::string> cells = line.cells();
  if (cells.size() != 2) line.fail("\"" + line.text + "\" has not two numbers. Allowed: strain, stress.");
  std::vector<double> numbers;
  for (const std::string &cell : cells) {
    numbers.push_back(number_of(cell).value_or(not_given));
    if (!std::isfinite(numbers.back()))
      line.fail("\"" + cell + "\" is not a finite number. Allowed: strain, stress.");
  }
  if (curve.strain.empty() ? numbers[0] < 0 : numbers[0] <= curve.strain.back())
    line.fail("the strain " + cells[0] +
              " is not above the one before it. Allowed: strains from 0 on that ascend.");
  curve.strain.push_back(numbers[0]);
  curve.stress.push_back(unit * numbers[1]);
}

} // namespace

double Curve::largest_stress() const {
  return *std::max_element(stress.begin(), stress.end());
}

double Curve::stress_at(double at) const {
  double x = 0, y = 0;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    if (strain[k] >= at) return strain[k] == x ? stress[k] : y + (stress[k] - y) * (at - x) / (strain[k] - x);
    x = strain[k], y = stress[k];
  }
  return y;
}

std::vector<double> Curve::sampled(double last) const {
  std::vector<double> values;
  for (std::size_t step = 1; step <= curve_points; ++step)
    values.push_back(stress_at(strain_of(step, last)));
  return values;
}

std::vector<double> Curve::misses(const std::vector<double> &of) const {
  std::vector<double> misses = sampled();
  const double largest = largest_stress();
  for (std::size_t k = 0; k < misses.size(); ++k)
    misses[k] = (of[k] - misses[k]) / largest;
  return misses;
}

Curve read_curve(const std::filesystem::path &path) {
  Line line{path};
  std::ifstream file = open_file(path);
  if (!file) line.fail("cannot be read.");
  std::string all{std::istreambuf_iterator<char>(file), {}};
  if (all.rfind("\xef\xbb\xbf", 0) == 0) all.erase(0, 3);
  Curve curve;
  double unit = 0; // until there was a header
  std::istringstream lines(with_plain_line_ends(all));
  for (std::string whole; std::getline(lines, whole);) {
    ++line.number, line.text = std::string(trimmed(whole));
    if (line.text.empty() || line.text[0] == '#') continue;
    if (unit == 0)
      unit = read_header(line, curve);
    else
      read_row(line, unit, curve);
  }
  line.number = 0, line.text = "";
  if (unit == 0) line.fail(std::string("has no header. ") + allowed_columns);
  if (curve.strain.empty() || curve.last_strain() == 0)
    line.fail("has no row with a strain above 0. Allowed: a row a point, strain and stress.");
  if (!(curve.largest_stress() > 0)) line.fail("has no stress above 0. Allowed: compression is positive.");
  return curve;
}

Curve curve_of_run(const std::filesystem::path &history, const Json &summary, bool of_gauge) {
  const double sign = text_in(summary, "test") == "tension" ? -1 : 1,
               from = number_in(summary, "consolidation_end_time_s");
  std::ifstream file(history);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = cells_of(line);
  std::vector<std::string> cells;
  const auto number = [&](const char *name) {
    const auto column = std::find(header.begin(), header.end(), name) - header.begin();
    return number_of(cells.at(static_cast<std::size_t>(column))).value_or(not_given);
  };
  Curve curve;
  double first_strain = 0, first_stress = 0;
  while (std::getline(file, line)) {
    cells = cells_of(line);
    if (cells.size() != header.size()) break;
    if (number("time_s") < from) continue;
    const double strain = number(of_gauge ? "axial_strain_gauge" : "axial_strain_platen"),
                 stress = 0.5 * (number("axial_stress_top_pa") + number("axial_stress_bottom_pa"));
    if (curve.strain.empty() && !std::isnan(from)) first_strain = strain, first_stress = stress;
    curve.strain.push_back(sign * (strain - first_strain));
    curve.stress.push_back(sign * (stress - first_stress));
  }
  return curve;
}

double root_mean_square(const std::vector<double> &values) {
  double squares = 0;
  for (const double value : values)
    squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

std::string branches_of_curve(const Curve &wanted, const std::vector<double> &stress) {
  const std::vector<double> points = wanted.sampled(), misses = wanted.misses(stress);
  const auto split = std::max_element(points.begin(), points.end()) - points.begin() + 1;
  std::string text =
      fmt::format("largest stress {:.3g} of {:.3g} MPa, rising branch off by {:.3g} %",
                  1e-6 * *std::max_element(stress.begin(), stress.end()), 1e-6 * wanted.largest_stress(),
                  100 * root_mean_square({misses.begin(), misses.begin() + split}));
  if (misses.begin() + split != misses.end())
    text += fmt::format(", after the peak by {:.3g} %",
                        100 * root_mean_square({misses.begin() + split, misses.end()}));
  return text;
}

} // namespace platen::apps
