// Sections of a scene that say what is done with the specimen: the settings of the library, and what a file
// says in other words than they do. All of them stand ready while a scene is read; what it does not choose is
// left out of the test (apps/run/problem_setup.h).
#pragma once

#include <string>

#include "apps/scene/quantities.h"
#include "coupling/platen_test_settings.h"

namespace platen::apps {

// What a platen's face is (apps/scene/surfaces.h); common: of one platen, what both are.
enum class SurfaceKind { common, custom, dry_steel, thesis, teflon, grease, brush, rubber_sheet, glued };

struct Face { // of one platen
  SurfaceKind surface = SurfaceKind::common;
  std::string mesh_file; // Gmsh; empty: a plate
};

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
  SurfaceKind surface = SurfaceKind::custom;
  dem::SurfaceFriction both{0.3, not_given, {}}; // what top and bottom take where the file gives none
  Face top_face, bottom_face;
  double mesh_unit = 1; // m, of the mesh files
  // From the specimen outward: of all platens, and of those that have their own.
  std::vector<NamedLayer> layers, top_layers, bottom_layers;
  std::vector<NamedMaterial> layer_materials;

  Platens() {
    elastic.emplace();
    top.friction_static = bottom.friction_static = not_given;
  }
  bool meshed() const { return !top_face.mesh_file.empty() || !bottom_face.mesh_file.empty(); }
};

enum class LoadingTest { compression, tension, hydrostatic, uniaxial_strain, three_point_bending };
inline const Words<LoadingTest> loading_tests{{"compression", LoadingTest::compression},
                                              {"tension", LoadingTest::tension},
                                              {"hydrostatic", LoadingTest::hydrostatic},
                                              {"uniaxial strain", LoadingTest::uniaxial_strain},
                                              {"three point bending", LoadingTest::three_point_bending}};
enum class ConfinementKind { none, particles, sleeve };

struct Loading : coupling::LoadingSettings {
  LoadingTest test = LoadingTest::compression;
  double stop_at_residual = 0.02;                      // fraction of the peak stress; 0: never
  ConfinementKind confinement = ConfinementKind::none; // `cell`, and its sleeve, count then

  Loading() {
    target_strain = 0.01;
    cell.emplace().sleeve.emplace();
  }
  bool confined() const { return confinement != ConfinementKind::none; }
  bool sleeved() const { return confinement == ConfinementKind::sleeve; }
  bool walled() const { return test == LoadingTest::uniaxial_strain; }
  bool bending() const { return test == LoadingTest::three_point_bending; }
  bool hydrostatic() const { return test == LoadingTest::hydrostatic; }
};

} // namespace platen::apps
