// Sections of a scene that say what is done with the specimen: the settings of the library, and what a file
// says in other words than they do. All of them stand ready while a scene is read; what it does not choose is
// left out of the test (apps/run/problem_setup.h).
#pragma once

#include <algorithm>
#include <array>
#include <string>

#include "apps/scene/quantities.h"
#include "apps/scene/scene_stages.h"
#include "coupling/platen_test_settings.h"

namespace platen::apps {

// What a platen's face is (apps/scene/surfaces.h); common: of one platen, what both are.
enum class SurfaceKind {
  common,
  custom,
  dry_steel,
  weakening_steel,
  thesis,
  teflon,
  grease,
  brush,
  rubber_sheet,
  glued
};

struct Face { // of one platen
  SurfaceKind surface = SurfaceKind::common;
  std::string mesh_file; // Gmsh; empty: a plate
};

// Which sides of a box have platens: top and bottom, and those along x, along y, or both.
enum class PlatenSides { two, four_x, four_y, six };
inline const Words<PlatenSides> platen_sides{{"two", PlatenSides::two},
                                             {"four x", PlatenSides::four_x},
                                             {"four y", PlatenSides::four_y},
                                             {"six", PlatenSides::six}};

// In the order of scenes.
constexpr std::array<coupling::Side, coupling::side_count> sides_of_scene{
    coupling::Side::top,   coupling::Side::bottom, coupling::Side::left,
    coupling::Side::right, coupling::Side::front,  coupling::Side::back};

// "Platens/Left"
inline std::string section_of(coupling::Side side) {
  std::string name = coupling::name_of(side);
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return "Platens/" + name;
}
// Of a platen that yields, as a scene says it (apps/scene/layers.h).
struct NamedLayer {
  std::string material;
  double thickness = not_given; // m
};
struct NamedMaterial {
  std::string name;
  fem::Material material;
};

struct Platens : coupling::PlatenSettings {
  bool deformable = false; // `elastic` counts then
  bool yielding = false;   // `elastic->metal` counts then
  SurfaceKind surface = SurfaceKind::custom;
  dem::SurfaceFriction both{0.3, not_given, {}}; // what a side takes where the file gives none
  PlatenSides sides = PlatenSides::two;
  std::array<Face, coupling::side_count> faces; // by side
  double mesh_unit = 1;                         // m, of the mesh files
  // From the specimen outward: of all platens, and of those that have their own.
  std::vector<NamedLayer> layers, top_layers, bottom_layers;
  std::vector<NamedMaterial> layer_materials;

  Platens() {
    elastic.emplace().metal.emplace();
    left.emplace(), right.emplace(), front.emplace(), back.emplace();
    for (const coupling::Side side : coupling::all_sides)
      at(side).friction_static = not_given;
  }
  // All sides stand ready; these have platens.
  bool has(coupling::Side side) const {
    const int axis = coupling::axis_of(side);
    return axis == 2 || sides == PlatenSides::six ||
           sides == (axis == 0 ? PlatenSides::four_x : PlatenSides::four_y);
  }
  template <class Holds> // of a side
  bool any_of(const Holds &holds) const {
    return std::any_of(coupling::all_sides.begin(), coupling::all_sides.end(),
                       [&](coupling::Side side) { return has(side) && holds(side); });
  }
  coupling::PlatenSide &at(coupling::Side side_of) {
    return const_cast<coupling::PlatenSide &>(*side(side_of));
  }
  const coupling::PlatenSide &at(coupling::Side side_of) const { return *side(side_of); }
  Face &face(coupling::Side side) { return faces[static_cast<std::size_t>(side)]; }
  const Face &face(coupling::Side side) const { return faces[static_cast<std::size_t>(side)]; }
  bool meshed() const {
    return any_of([this](coupling::Side side) { return !face(side).mesh_file.empty(); });
  }
};

enum class LoadingTest { compression, tension, hydrostatic, uniaxial_strain, three_point_bending };
inline const Words<LoadingTest> loading_tests{{"compression", LoadingTest::compression},
                                              {"tension", LoadingTest::tension},
                                              {"hydrostatic", LoadingTest::hydrostatic},
                                              {"uniaxial strain", LoadingTest::uniaxial_strain},
                                              {"three point bending", LoadingTest::three_point_bending}};
enum class ConfinementKind { none, particles, sleeve };
enum class SleeveKind { rubber, tube, wrap };
enum class Steel { custom, s235, s275, s355 };

struct Loading : coupling::LoadingSettings {
  LoadingTest test = LoadingTest::compression;
  double stop_at_residual = 0.02;                       // fraction of the peak stress; 0: never
  ConfinementKind confinement = ConfinementKind::none;  // `cell`, and its sleeve, count then
  std::array<StageSection, most_stages> stage_sections; // what `stages` are made of

  SleeveKind sleeve_kind = SleeveKind::rubber;
  Steel steel = Steel::custom;
  std::string hardening_file; // of a tube

  Loading() {
    target_strain = 0.01;
    coupling::SleeveSettings &sleeve = cell.emplace().sleeve.emplace();
    sleeve.metal.emplace(), sleeve.wrap.emplace();
  }
  bool staged() const { return !stages.empty(); }
  bool sleeved() const { return confinement == ConfinementKind::sleeve; } // of finite elements, any kind
  // A wall that the specimen presses, tube or wrap.
  bool tubed() const { return sleeved() && sleeve_kind != SleeveKind::rubber; }
  bool wrapped() const { return sleeved() && sleeve_kind == SleeveKind::wrap; }
  bool confined() const { return confinement != ConfinementKind::none && !tubed(); } // by a pressure
  bool walled() const { return test == LoadingTest::uniaxial_strain; }
  bool bending() const { return test == LoadingTest::three_point_bending; }
  bool hydrostatic() const { return test == LoadingTest::hydrostatic; }
};

} // namespace platen::apps
