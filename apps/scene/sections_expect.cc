// Numbers and words of summary.json that a scene may state beforehand.
#include "apps/scene/sections.h"
#include "dem/measure/failure_pattern.h"

namespace platen::apps {
namespace {

struct ExpectedNumber {
  const char *key;  // of summary.json; a member of an object after "/"
  const char *unit; // of the number in summary.json
};

constexpr ExpectedNumber expected_numbers[] = {
    {"particles", "1"},
    {"bonds", "1"},
    {"coordination_number", "1"},
    {"packing_fraction", "1"},
    {"grain_density_kg_m3", "kg/m3"},
    {"steps", "1"},
    {"time_step_s", "s"},
    {"strength_pa", "Pa"},
    {"strain_at_peak_platen", "1"},
    {"strain_at_peak_gauge", "1"},
    {"youngs_modulus_gauge_pa", "Pa"},
    {"youngs_modulus_platen_pa", "Pa"},
    {"deviator_strength_pa", "Pa"},
    {"bulk_modulus_pa", "Pa"},
    {"constrained_modulus_pa", "Pa"},
    {"failure_load_n", "N"},
    {"cracks_on_loaded_diameter", "1"},
    {"first_cracks_in_middle_of_diameter", "1"},
    {"deflection_at_peak_m", "m"},
    {"flexural_modulus_pa", "Pa"},
    {"moment_over_nominal", "1"},
    {"cracks_near_midspan", "1"},
    {"lateral_over_axial_stress", "1"},
    {"side_stress_at_peak_pa/left", "Pa"},
    {"side_stress_at_peak_pa/right", "Pa"},
    {"side_stress_at_peak_pa/front", "Pa"},
    {"side_stress_at_peak_pa/back", "Pa"},
    {"poisson_ratio", "1"},
    {"broken_tension", "1"},
    {"broken_shear", "1"},
    {"energy_residual_relative", "1"},
    {"kinetic_to_internal_max", "1"},
    {"end_damage_top", "1"},
    {"end_damage_bottom", "1"},
    {"middle_damage", "1"},
    {"end_spread", "1"},
    {"barrel_at_peak", "1"},
    {"fragments", "1"},
    {"cone_top/height_m", "m"},
    {"cone_top/half_angle_deg", "degree"},
    {"cone_top/volume_fraction", "1"},
    {"cone_top/apex_depth_m", "m"},
    {"cone_top/confidence", "1"},
    {"cone_bottom/height_m", "m"},
    {"cone_bottom/half_angle_deg", "degree"},
    {"cone_bottom/volume_fraction", "1"},
    {"cone_bottom/apex_depth_m", "m"},
    {"cone_bottom/confidence", "1"},
    {"final_cone_top/height_m", "m"},
    {"final_cone_top/half_angle_deg", "degree"},
    {"final_cone_top/volume_fraction", "1"},
    {"final_cone_top/apex_depth_m", "m"},
    {"final_cone_top/confidence", "1"},
    {"final_cone_bottom/height_m", "m"},
    {"final_cone_bottom/half_angle_deg", "degree"},
    {"final_cone_bottom/volume_fraction", "1"},
    {"final_cone_bottom/apex_depth_m", "m"},
    {"final_cone_bottom/confidence", "1"},
    {"crack_planes/count", "1"},
    {"crack_planes/share", "1"},
    {"crack_planes/steep_share", "1"},
    {"crack_planes/mean_inclination_deg", "degree"},
    {"acoustic/events", "1"},
    {"acoustic/largest_magnitude", "1"},
    {"acoustic/b_before", "1"},
    {"acoustic/b_after", "1"},
    {"bulk/youngs_modulus_pa", "Pa"},
    {"bulk/poisson_ratio", "1"},
    {"effective_radius_m", "m"},
    {"density_kg_m3", "kg/m3"},
    {"tension/static_error", "1"},
    {"tension/dynamic_error", "1"},
    {"bending/static_error", "1"},
    {"bending/static_error_effective", "1"},
    {"bending/dynamic_error", "1"},
    {"bending/dynamic_error_effective", "1"},
    {"torsion/static_error", "1"},
    {"torsion/static_error_effective", "1"},
    {"torsion/dynamic_error", "1"},
    {"torsion/dynamic_error_effective", "1"},
    {"impact/wave_error", "1"},
};

} // namespace

void declare_expect(Parameters &parameters, std::vector<Expectation> &expect) {
  Section section(parameters, "Expect");
  for (const ExpectedNumber &number : expected_numbers)
    section.expectation(number.key, expect, number.unit,
                        "Range of the number in summary.json, one side may be left out; empty: not checked.");
  for (const char *key : {"pattern", "final_pattern"})
    section.expected_words(key, expect, {dem::pattern_words.begin(), dem::pattern_words.end()},
                           "Words of which summary.json has one; empty: not checked.");
}

} // namespace platen::apps
