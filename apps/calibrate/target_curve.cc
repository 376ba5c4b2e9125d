#include "apps/calibrate/target_curve.h"

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

// `text` is the line, of which a character that nobody sees is named.
[[noreturn]] void fail(const std::filesystem::path &path, int line, const std::string &reason,
                       const std::string &text = "") {
  const std::string odd = text_of_odd_character(text);
  throw InputError(path.string() + (line > 0 ? ":" + std::to_string(line) : "") + ": error: " + reason +
                   (odd.empty() ? "" : " The line holds " + odd + "."));
}

std::vector<std::string> cells_of_line(const std::string &line) {
  std::vector<std::string> cells = cells_of(line);
  for (std::string &cell : cells)
    cell = std::string(trimmed(cell));
  return cells;
}

// Pa of a unit of the stress column.
double read_header(const std::filesystem::path &path, int line, const std::string &text, TargetCurve &curve) {
  const std::vector<std::string> cells = cells_of_line(text);
  const bool known = cells.size() == 2 && (cells[0] == "strain_platen" || cells[0] == "strain_gauge") &&
                     (cells[1] == "stress_pa" || cells[1] == "stress_mpa");
  if (!known)
    fail(path, line, "the header \"" + text + "\" is not that of a curve. " + allowed_columns, text);
  curve.of_gauge = cells[0] == "strain_gauge";
  return cells[1] == "stress_mpa" ? 1e6 : 1;
}

void read_row(const std::filesystem::path &path, int line, const std::string &text, double unit,
              TargetCurve &curve) {
  const std::vector<std::string> cells = cells_of_line(text);
  if (cells.size() != 2)
    fail(path, line, "\"" + text + "\" has not two numbers. Allowed: strain, stress.", text);
  double numbers[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const auto number = number_of(cells[k]);
    if (!number || !std::isfinite(*number))
      fail(path, line, "\"" + cells[k] + "\" is not a finite number. Allowed: strain, stress.", text);
    numbers[k] = *number;
  }
  if (curve.strain.empty() ? numbers[0] < 0 : numbers[0] <= curve.strain.back())
    fail(path, line,
         "the strain " + cells[0] +
             " is not above the one before it. Allowed: strains from 0 on that ascend.");
  curve.strain.push_back(numbers[0]);
  curve.stress.push_back(unit * numbers[1]);
}

} // namespace

double TargetCurve::largest_stress() const {
  return *std::max_element(stress.begin(), stress.end());
}

double TargetCurve::stress_at(double at) const {
  double x = 0, y = 0;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    if (strain[k] >= at) return strain[k] == x ? stress[k] : y + (stress[k] - y) * (at - x) / (strain[k] - x);
    x = strain[k], y = stress[k];
  }
  return y;
}

std::vector<double> TargetCurve::sampled() const {
  std::vector<double> values;
  for (std::size_t k = 1; k <= curve_points; ++k)
    values.push_back(stress_at(last_strain() * static_cast<double>(k) / curve_points));
  return values;
}

TargetCurve read_target_curve(const std::filesystem::path &path) {
  std::ifstream file = open_file(path);
  if (!file) fail(path, 0, "cannot be read.");
  std::string all{std::istreambuf_iterator<char>(file), {}};
  if (all.rfind("\xef\xbb\xbf", 0) == 0) all.erase(0, 3);
  TargetCurve curve;
  double unit = 0; // until there was a header
  std::istringstream lines(with_plain_line_ends(all));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string text(trimmed(line));
    if (text.empty() || text[0] == '#') continue;
    if (unit == 0)
      unit = read_header(path, number, text, curve);
    else
      read_row(path, number, text, unit, curve);
  }
  if (unit == 0) fail(path, 0, std::string("has no header. ") + allowed_columns);
  if (curve.strain.empty() || curve.last_strain() == 0)
    fail(path, 0, "has no row with a strain above 0. Allowed: a row a point, strain and stress.");
  if (!(curve.largest_stress() > 0))
    fail(path, 0, "has no stress above 0. Allowed: compression is positive.");
  return curve;
}

std::vector<double> misses_of_curve(const TargetCurve &wanted, const std::vector<double> &stress) {
  std::vector<double> misses = wanted.sampled();
  const double largest = wanted.largest_stress();
  for (std::size_t k = 0; k < misses.size(); ++k)
    misses[k] = (stress[k] - misses[k]) / largest;
  return misses;
}

double root_mean_square(const std::vector<double> &values) {
  double squares = 0;
  for (const double value : values)
    squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

std::string branches_of_curve(const TargetCurve &wanted, const std::vector<double> &stress) {
  const std::vector<double> points = wanted.sampled(), misses = misses_of_curve(wanted, stress);
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
