#include "apps/run/specimen_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/program_of_test.h"
#include "dem/measure/fragments.h"
#include "dem/packing/quality.h"

namespace platen::apps {
namespace {

// Fewer have no inside that could bear a stress.
constexpr std::size_t fewest_spheres = 4;
// Share of the bonded spheres in one piece: packings leave some pairs aside, two halves are none.
constexpr double least_of_one_piece = 0.9;
// Soft packings and other programs leave a few percent; beyond, two spheres are one grain counted twice.
constexpr double deepest_allowed = 0.2; // of the smaller radius

const char *entry_of_packing(const Scene &scene) {
  return scene.specimen.packing == PackingKind::file ? "Specimen/File" : "Specimen/Sphere radius";
}

void add_pieces(SpecimenState &state, const dem::Specimen &specimen, const coupling::PlatenTest &test) {
  const dem::Model &model = test.model;
  const dem::Fragments found = dem::find_fragments(model.particles, model.bonds.get());
  state.pieces = found.count;
  state.loose = found.single;
  if (found.count == 0) return;
  const auto largest = static_cast<int>(std::max_element(found.particles.begin(), found.particles.end()) -
                                        found.particles.begin());
  state.largest_piece = static_cast<double>(found.particles[static_cast<std::size_t>(largest)]) /
                        static_cast<double>(state.spheres - static_cast<std::size_t>(found.single));
  const int axis = coupling::loaded_axis(test);
  const std::array<double, 2> ends = coupling::extent(specimen.shape, axis);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t row = 0; row < found.of_particle.size(); ++row) {
    if (found.of_particle[row] != largest) continue;
    const double x = model.particles.reference_position[row][axis], r = model.particles.radius[row];
    low = std::min(low, x - r);
    high = std::max(high, x + r);
  }
  state.spans = low - ends[0] <= state.reach && ends[1] - high <= state.reach;
}

void add_overlap(SpecimenState &state, const dem::Specimen &specimen) {
  for (const dem::TouchingPair &pair : dem::touching_pairs(specimen, 0)) {
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    const double overlap = -pair.gap / std::min(specimen.radius[a], specimen.radius[b]);
    if (overlap > state.deepest_overlap)
      state.deepest_overlap = overlap, state.deepest = {pair.first, pair.second};
  }
}

// Of the flaws that the scene gives, in their order.
std::vector<std::string> entries_of_flaws(const Scene &scene) {
  std::vector<std::string> entries;
  for (std::size_t k = 0; k < most_flaws; ++k)
    if (scene.specimen.flaws[k]) entries.push_back("Specimen/Flaw " + std::to_string(k + 1));
  return entries;
}

// What a specimen in pieces, or without bonds, is due to.
std::string cause_of_pieces(const Scene &scene) {
  const std::vector<std::string> flaws = entries_of_flaws(scene);
  if (!flaws.empty()) return flaws.front();
  if (scene.specimen.packing != PackingKind::file) return "Bond/Gap";
  return scene.specimen.bond_file.empty() ? "Specimen/File" : "Specimen/Bond file";
}

} // namespace

void require_spheres(const Scene &scene, const dem::Specimen &specimen) {
  if (specimen.size() >= fewest_spheres) return;
  refuse(scene, entry_of_packing(scene),
         fmt::format("makes {} sphere{}, which is no specimen. Allowed: {} or more.", specimen.size(),
                     specimen.size() == 1 ? "" : "s", fewest_spheres));
}

SpecimenState state_of(const Scene &scene, const dem::Specimen &specimen, const coupling::PlatenTest &test) {
  SpecimenState state;
  state.section = test.section();
  state.mean_radius = test.facts().mean_radius;
  if (scene.specimen.packing != PackingKind::file) state.radius_asked = scene.specimen.sphere_radius;
  state.spheres = specimen.size();
  state.bonds = test.model.bonds ? test.model.bonds->initial_count() : 0;
  if (test.model.bonds) state.in_flaw = test.model.bonds->in_flaw;
  const int axis = coupling::loaded_axis(test);
  state.from_ends = {coupling::distance_to_plane(specimen, coupling::low_side(axis)),
                     coupling::distance_to_plane(specimen, coupling::opposite(coupling::low_side(axis)))};
  // Ground ends are seated by a layer; as packed the platens meet the outermost spheres.
  const double diameter = 2 * test.facts().mean_radius;
  state.reach = are_ground(test.settings().ends)
                    ? 0.5 * test.settings().end_layer * diameter
                    : diameter + std::max({0.0, state.from_ends[0], state.from_ends[1]});
  add_overlap(state, specimen);
  if (test.model.bonds) add_pieces(state, specimen, test);
  return state;
}

void require_specimen(const Scene &scene, const SpecimenState &state) {
  if (state.deepest_overlap > deepest_allowed)
    refuse(scene, entry_of_packing(scene),
           fmt::format(
               "has spheres in one another: {} and {} overlap by {:.2g} of the smaller radius. Allowed: up "
               "to {:g}.",
               state.deepest[0], state.deepest[1], state.deepest_overlap, deepest_allowed));
  if (!scene.bond.parameters()) return;
  if (state.bonds == 0)
    refuse(scene, "Bond/Gap",
           "leaves no bond: no two spheres are that near. Allowed: a larger one, a denser packing, or "
           "Effects/Bond = none.");
  const std::vector<std::string> flaws = entries_of_flaws(scene);
  for (std::size_t k = 0; k < state.in_flaw.size(); ++k)
    if (state.in_flaw[k] == 0)
      refuse(scene, flaws.at(k), "passes no bond. Allowed: one within the specimen, wider than its spheres.");
  const std::string cause = cause_of_pieces(scene);
  if (state.largest_piece < least_of_one_piece)
    refuse(scene, cause,
           fmt::format(
               "leaves the specimen in {} pieces, the largest with {:.0f} % of the bonded spheres. Allowed: "
               "{:.0f} % or more, by a larger Bond/Gap or another packing.",
               state.pieces, 100 * state.largest_piece, 100 * least_of_one_piece));
  if (!state.spans)
    refuse(
        scene, cause,
        fmt::format("leaves no piece that reaches from platen to platen, within {:.3g} m of each. Allowed: a "
                    "deeper Specimen/End layer, or a packing that reaches its ends.",
                    state.reach));
}

std::string text_of(const SpecimenState &state) {
  std::string text;
  if (state.bonds > 0)
    text += fmt::format(
        "  pieces {}, the largest with {:.1f} % of the bonded spheres; {} spheres without a bond\n",
        state.pieces, 100 * state.largest_piece, state.loose);
  for (std::size_t k = 0; k < state.in_flaw.size(); ++k)
    text += fmt::format("  flaw {} of {}: {} bonds\n", k + 1, state.in_flaw.size(), state.in_flaw[k]);
  if (const std::string filled = text_of(state.section); !filled.empty())
    text += "  spheres and their pores fill " + filled + "\n";
  text += fmt::format("  mean radius {:.5g} mm", 1e3 * state.mean_radius);
  if (!std::isnan(state.radius_asked))
    text += fmt::format(", {:+.2f} % of the {:.5g} mm asked",
                        100 * (state.mean_radius / state.radius_asked - 1), 1e3 * state.radius_asked);
  text += "\n";
  return text + fmt::format(
                    "  deepest overlap {:.3g} of a radius, outermost spheres {:.3g} and {:.3g} mm from the "
                    "ends\n",
                    state.deepest_overlap, 1e3 * state.from_ends[0], 1e3 * state.from_ends[1]);
}

std::string text_of(const dem::SolidSection &section) {
  if (std::isnan(section.mean)) return "";
  return fmt::format("{:.1f} % of the shape's section, {:.1f} to {:.1f} % by height", 100 * section.mean,
                     100 * section.least, 100 * section.largest);
}

} // namespace platen::apps
