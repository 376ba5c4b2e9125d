#include "apps/output/crack_discs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>

#include "apps/output/numbers.h"
#include "apps/output/vtu.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"
#include "base/pi.h"
#include "dem/bonds.h"

namespace platen::apps {
namespace {

constexpr std::size_t column_count = 13, mode_column = 9;

std::optional<double> number_of_mode(const std::string &mode) {
  if (mode == "tension") return static_cast<double>(dem::BondState::broken_in_tension);
  if (mode == "shear") return static_cast<double>(dem::BondState::broken_in_shear);
  return std::nullopt;
}

} // namespace

const std::vector<std::string> crack_columns{"time_s",   "axial_strain", "x_m",       "y_m",     "z_m",
                                             "nx",       "ny",           "nz",        "area_m2", "mode",
                                             "energy_j", "particle_a",   "particle_b"};

void write_crack_discs(const std::filesystem::path &csv, double end_time, const std::filesystem::path &vtu) {
  std::ifstream stream = open_file(csv);
  if (!stream) throw InputError(csv.string() + ": cannot be read");
  std::array<std::vector<double>, column_count> v;
  std::string line;
  std::getline(stream, line); // the header
  for (long number = 2; std::getline(stream, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    const std::string where = fmt::format("{}:{}: ", csv.string(), number);
    if (cells.size() != column_count)
      throw InputError(where + fmt::format("{} fields, {} are wanted", cells.size(), column_count));
    for (std::size_t k = 0; k < column_count; ++k) {
      const auto value = k == mode_column ? number_of_mode(cells[k]) : number_of(cells[k]);
      if (!value)
        throw InputError(where + fmt::format("{}: \"{}\" is not {}", crack_columns[k], cells[k],
                                             k == mode_column ? "tension or shear" : "a number"));
      v[k].push_back(*value);
    }
  }
  std::vector<Disc> discs;
  std::vector<Vector3> normal;
  for (std::size_t k = 0; k < v[0].size(); ++k) {
    normal.push_back({v[5][k], v[6][k], v[7][k]});
    discs.push_back({{v[2][k], v[3][k], v[4][k]}, normal.back(), std::sqrt(std::max(v[8][k], 0.0) / pi)});
  }
  const auto whole = [](const std::vector<double> &column) {
    return std::vector<int>(column.begin(), column.end());
  };
  write_discs(vtu, end_time, discs,
              {{"time", v[0]},
               {"mode", whole(v[mode_column])},
               {"energy", v[10]},
               {"area", v[8]},
               {"normal", normal},
               {"axial_strain", v[1]},
               {"particle_a", whole(v[11])},
               {"particle_b", whole(v[12])}});
}

} // namespace platen::apps
