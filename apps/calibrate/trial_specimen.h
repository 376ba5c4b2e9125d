// One test of one specimen, as the targets ask for it: what is crushed, between what, how far.
#pragma once

#include <string>

#include "apps/scene/declare.h"
#include "apps/scene/scene.h"

namespace platen::apps {

enum class TestKind { elastic, compression, tension, splitting };

struct SpecimenTest {
  TestKind kind = TestKind::elastic;
  bool box = false;               // instead of the scene's cylinder, as wide
  bool round = false;             // a cylinder instead of the scene's box
  double slenderness = not_given; // the scene's height where not given
  double friction = not_given;    // of the platens; as the scene has them where not given
  double pressure = 0;            // Pa, of a cell
  bool sleeve = false;
  double rate = not_given, strain = not_given; // m/s, 1; what follows from the scene where not given
  // Stresses are kept at `curve_points` equal steps of strain up to here, peak or not; 0: none are.
  double curve_strain = 0;
  bool curve_of_gauge = false; // else strain between the platens

  std::string name() const; // "compression box 1 friction 0", without commas: one test
  std::string form() const; // of its specimen, "box_1"; "" is the scene's
  bool loads() const { return kind != TestKind::elastic; }
};
constexpr std::size_t curve_points = 16;

// The same but for what is kept of the curve.
bool same_test(const SpecimenTest &a, const SpecimenTest &b);

// The scene whose specimen is of this form; then the one that is loaded so.
Scene scene_of_form(const Scene &scene, const SpecimenTest &test);
Scene scene_of_test(const Scene &scene, const SpecimenTest &test);

} // namespace platen::apps
