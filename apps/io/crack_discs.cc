#include "apps/io/crack_discs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "apps/io/errors.h"
#include "apps/io/numbers.h"
#include "apps/io/vtu.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"
#include "base/pi.h"
#include "dem/bonds.h"

namespace platen::apps {
namespace {

constexpr std::array<const char *, 13> columns{"time_s",   "axial_strain", "x_m",       "y_m",     "z_m",
                                               "nx",       "ny",           "nz",        "area_m2", "mode",
                                               "energy_j", "particle_a",   "particle_b"};
constexpr std::size_t mode_column = 9;

} // namespace

void write_crack_discs(const std::filesystem::path &csv, double end_time, const std::filesystem::path &vtu) {
  std::ifstream stream = open_file(csv);
  if (!stream) throw InputError(csv.string() + ": cannot be read");
  std::vector<Disc> discs;
  std::vector<double> time, energy, area, strain;
  std::vector<Vector3> normal;
  std::vector<int> mode, first, second;
  std::string line;
  std::getline(stream, line); // the header
  for (long number = 2; std::getline(stream, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    const auto damaged = [&](const std::string &what) {
      return InputError(fmt::format("{}:{}: {}", csv.string(), number, what));
    };
    if (cells.size() != columns.size())
      throw damaged(fmt::format("{} fields, {} are wanted", cells.size(), columns.size()));
    std::array<double, columns.size()> v{};
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (k == mode_column) continue;
      const auto value = number_of(cells[k]);
      if (!value) throw damaged(fmt::format("{}: \"{}\" is not a number", columns[k], cells[k]));
      v[k] = *value;
    }
    const bool tension = cells[mode_column] == "tension";
    if (!tension && cells[mode_column] != "shear")
      throw damaged(fmt::format("mode: \"{}\", allowed are tension, shear", cells[mode_column]));
    discs.push_back({{v[2], v[3], v[4]}, {v[5], v[6], v[7]}, std::sqrt(std::max(v[8], 0.0) / pi)});
    time.push_back(v[0]), strain.push_back(v[1]), area.push_back(v[8]), energy.push_back(v[10]);
    normal.push_back(discs.back().normal);
    mode.push_back(
        static_cast<int>(tension ? dem::BondState::broken_in_tension : dem::BondState::broken_in_shear));
    first.push_back(static_cast<int>(v[11])), second.push_back(static_cast<int>(v[12]));
  }
  write_discs(vtu, end_time, discs,
              {{"time", std::move(time)},
               {"mode", std::move(mode)},
               {"energy", std::move(energy)},
               {"area", std::move(area)},
               {"normal", normal},
               {"axial_strain", std::move(strain)},
               {"particle_a", std::move(first)},
               {"particle_b", std::move(second)}});
}

} // namespace platen::apps
