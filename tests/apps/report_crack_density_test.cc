#include "apps/report/cracks.h"
#include "base/pi.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "apps/report_example.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

const Extent cylinder{Extent::Form::cylinder, 0.025, 0.0, 0.1, 0.025};
const Extent disc{Extent::Form::disc, 0.025, 0.0, 0.05, 0.01};

TEST(ReportCrackDensity, the_density_times_the_volume_gives_back_every_crack) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-1, 1);
  std::vector<Crack> cracks(500);
  for (Crack &crack : cracks) // some outside the extent: splinters count where they left it
    crack.place = {0.02 * draw(random), 0.02 * draw(random), 0.05 + 0.06 * draw(random)};
  const DensityMap map = crack_density(cracks, {}, cylinder);
  EXPECT_FALSE(map.is_share);
  double sum = 0;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      const double inner = map.radius * column / map.columns, outer = map.radius * (column + 1) / map.columns;
      sum += map.at(column, row) * pi * (outer * outer - inner * inner) * (map.top - map.bottom) / map.rows;
    }
  EXPECT_NEAR(sum, 500, 1e-9 * 500);
}

TEST(ReportCrackDensity, a_ring_of_cracks_lies_in_its_ring_whatever_the_angle) {
  std::vector<Crack> cracks;
  for (int k = 0; k < 36; ++k)
    cracks.push_back({{0.016 * std::cos(k), 0.016 * std::sin(k), 0.07}, 0, 0, 1, 1e-6, true});
  const DensityMap map = crack_density(cracks, {}, cylinder);
  int filled = 0;
  for (const double value : map.values)
    filled += value > 0 ? 1 : 0;
  EXPECT_EQ(filled, 1);
  EXPECT_GT(map.at(static_cast<int>(0.016 / 0.025 * map.columns), static_cast<int>(0.7 * map.rows)), 0);
}

TEST(ReportCrackDensity, a_disc_counts_by_the_distance_from_its_loaded_diameter) {
  // A split through the whole thickness lies in the innermost column, wherever along the axis of the disc.
  std::vector<Crack> cracks;
  for (int k = -9; k <= 9; ++k)
    cracks.push_back({{0.0005, 0.001 * k, 0.025}, 1, 0, 0, 1e-6, true});
  const DensityMap map = crack_density(cracks, {}, disc);
  EXPECT_TRUE(map.is_plane);
  double sum = 0;
  for (int row = 0; row < map.rows; ++row)
    sum += map.at(0, row) * 2 * map.radius / map.columns * 2 * disc.half_depth * (map.top - map.bottom) /
           map.rows;
  EXPECT_NEAR(sum, 19, 1e-9);
  for (int column = 1; column < map.columns; ++column)
    for (int row = 0; row < map.rows; ++row)
      EXPECT_EQ(map.at(column, row), 0);
}

TEST(ReportCrackDensity, the_share_is_one_where_all_bonds_broke_and_unknown_where_there_are_few) {
  std::vector<Position> bonds(20, {0.001, 0, 0.001});
  bonds.insert(bonds.end(), 10, {0.001, 0, 0.099});
  bonds.push_back({0.024, 0, 0.05}); // alone in its cell
  std::vector<Crack> cracks(20);
  for (Crack &crack : cracks)
    crack.place = bonds.front();
  const DensityMap map = crack_density(cracks, bonds, cylinder);
  EXPECT_TRUE(map.is_share);
  EXPECT_EQ(map.at(0, 0), 1);
  EXPECT_EQ(map.at(0, map.rows - 1), 0);
  EXPECT_TRUE(std::isnan(map.at(map.columns - 1, map.rows / 2)));
}

TEST(ReportCrackDensity, only_cracks_up_to_the_time_count_and_lie_where_their_spheres_lay) {
  const TestFolder folder;
  write_example(folder.path(), {});
  const CsvTable table = read_csv(folder / "cracks.csv", {"mode"});
  const Spheres before = read_spheres(read_pvd(folder / "specimen.pvd").front());
  EXPECT_TRUE(cracks_until(table, example_peak_time, before).empty());
  std::vector<Crack> cracks = cracks_until(table, example_fall_time, before);
  EXPECT_EQ(cracks.size(), table.rows);

  CsvTable shifted =
      table; // a place at the break that is far off does not matter where the spheres are known
  shifted.numbers["z_m"].assign(table.rows, 7.0);
  cracks = cracks_until(shifted, example_fall_time, before);
  for (const Crack &crack : cracks)
    EXPECT_LT(crack.place[2], 0.1);
  EXPECT_EQ(cracks_until(shifted, example_fall_time, Spheres{}).front().place[2], 7.0);
}

TEST(ReportCrackDensity, no_cell_of_a_real_folder_has_more_breaks_than_bonds) {
  const TestFolder folder;
  write_example(folder.path(), {});
  const Spheres before = read_spheres(read_pvd(folder / "specimen.pvd").front());
  const std::vector<Position> bonds = bond_midpoints(read_pvd(folder / "bonds.pvd").front());
  const auto cracks = cracks_until(read_csv(folder / "cracks.csv", {"mode"}), example_end_time, before);
  const DensityMap map = crack_density(cracks, bonds, extent_of(before));
  double middle = 0, ends = 0;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      const double share = map.at(column, row), height = (row + 0.5) / map.rows;
      if (std::isnan(share)) continue;
      EXPECT_LE(share, 1);
      (std::abs(height - 0.5) < 0.2 ? middle : ends) += std::abs(height - 0.5) < 0.2    ? share
                                                        : std::abs(height - 0.5) > 0.35 ? share
                                                                                        : 0;
    }
  EXPECT_GT(middle, 0);
  EXPECT_EQ(ends, 0); // an hourglass: the ends are sound
}

TEST(ReportCrackDensity, a_mode_that_is_no_mode_is_refused) {
  const TestFolder folder;
  write_example(folder.path(), {});
  CsvTable table = read_csv(folder / "cracks.csv", {"mode"});
  table.words["mode"][4] = "bending";
  EXPECT_THROW(cracks_until(table, example_end_time, {}), InputError);
}

} // namespace
} // namespace platen::apps::report
