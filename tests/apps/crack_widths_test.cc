// Widths of cracks as a run reports them: what has come apart is what the specimen has grown by.
#include <algorithm>
#include <cmath>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class CrackWidths : public Crushed {};

// Pulled until it has come apart: then nothing is strained, and the crack is as wide as the specimen has
// grown.
const Words pulled{"Loading/Test = tension", "Platens/Attachment = glued", "Loading/Axial rate = 0.3 m/s",
                   "Loading/Target strain = 0.008", "Loading/Stop at residual = 0"};

TEST_F(CrackWidths, openings_across_a_pulled_specimen_are_its_elongation) {
  const nlohmann::json found = crush("pulled", pulled)["crack_widths"];
  const auto column = [&](const char *name) { return column_of(folder_ / "pulled/crack_state.csv", name); };
  const auto area = column("area_m2"), nz = column("nz"), jump = column("jump_z_m"),
             opening = column("opening_m"), slip = column("slip_m"), largest = column("largest_opening_m"),
             nx = column("nx"), ny = column("ny"), jx = column("jump_x_m"), jy = column("jump_y_m");
  ASSERT_GT(area.size(), 20u);
  EXPECT_EQ(lines_in(folder_ / "pulled/crack_state.csv"), lines_in(folder_ / "pulled/cracks.csv"));
  const double grown = -0.02 * column_of(folder_ / "pulled/history.csv", "axial_strain_platen").back(); // m
  double across = 0, sum = 0, wide = 0, all = 0, open = 0;
  for (std::size_t k = 0; k < area.size(); ++k) {
    const double along = jx[k] * nx[k] + jy[k] * ny[k] + jump[k] * nz[k];
    EXPECT_NEAR(opening[k], along, 1e-15);
    EXPECT_NEAR(opening[k] * opening[k] + slip[k] * slip[k],
                jx[k] * jx[k] + jy[k] * jy[k] + jump[k] * jump[k], 1e-15);
    EXPECT_GE(largest[k], opening[k]);
    all += area[k];
    wide += opening[k] > 100e-6 ? area[k] : 0;
    open += opening[k] > 0;
    if (std::abs(jump[k]) < 0.5 * grown) continue; // a crack beside the one that has parted it
    across += area[k] * std::abs(nz[k]) * std::abs(jump[k]);
    sum += area[k] * std::abs(nz[k]);
  }
  EXPECT_NEAR(across / sum / grown, 1, 0.01);
  EXPECT_EQ(found["open"], open);
  EXPECT_NEAR(found["share_above_100_um"], wide / all, 1e-12);
  EXPECT_EQ(found["largest_m"], *std::max_element(opening.begin(), opening.end()));
  EXPECT_TRUE(found["through_x_m"].is_null()); // a cylinder
  EXPECT_TRUE(found["through_z_m"].is_null()); // no way from end to end
  EXPECT_EQ(found["permeability_z_m2"], 0);
}

TEST_F(CrackWidths, a_test_without_a_crack_log_has_none) {
  const nlohmann::json found = crush("none", {"Effects/Crack log = off"});
  EXPECT_TRUE(found["crack_widths"].is_null());
  EXPECT_FALSE(fs::exists(folder_ / "none/crack_state.csv"));
}

TEST_F(CrackWidths, roughness_is_a_factor_on_what_flows) {
  const Words split{"Specimen/Height = 20 mm", "Platens/Friction static = 0", "Platens/Friction dynamic = 0",
                    "Loading/Stop at residual = 0.3"};
  const nlohmann::json smooth = crush("smooth", split)["crack_widths"],
                       rough = crush("rough", with(split, {"Output/Crack roughness = 0.25"}))["crack_widths"];
  EXPECT_GT(smooth["permeability_z_m2"], 0);
  EXPECT_GT(smooth["through_z_m"], 0);
  EXPECT_NEAR(rough["permeability_z_m2"].get<double>() / smooth["permeability_z_m2"].get<double>(), 0.25,
              1e-12);
  EXPECT_EQ(rough["through_z_m"], smooth["through_z_m"]);
  EXPECT_EQ(rough["roughness"], 0.25);
}

} // namespace
} // namespace platen::apps::testing
