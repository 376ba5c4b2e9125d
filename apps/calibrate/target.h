// What is wanted of a specimen, as a scene says it in one line:
//   strength_pa at Loading/Confinement = particles, Loading/Confining pressure = 9 MPa: 82 MPa +- 3 %
//   strength_pa over Platens/Friction static = 0: 1.4
//   curve 1 at Platens/Friction static = 0.1: +- 5 %
#pragma once

#include <string>
#include <vector>

#include "apps/scene/declare.h"

namespace platen::apps {

class Parameters;

// How a target goes with bonds: what the search expects of it before there are trials.
enum class TargetKind {
  young_modulus,        // of a static solve
  poisson_ratio,        // of a static solve
  strength,             // uniaxial
  strain_at_peak,       //
  tension,              // between glued ends, or of a disc that is split
  strength_at_pressure, //
  ratio,                // of one figure in two tests
  secant_ratio,         // Poisson's ratio to 40 % of the strength
  curve,                // stresses of a laboratory
  other                 // nothing is known beforehand
};

struct Target {
  TargetKind kind = TargetKind::strength;
  std::string figure;               // a number of summary.json; "" of a curve
  std::string program = "compress"; // or "brazilian"; "" of a static solve
  std::string key, name;            // "triaxial_strength_pa" of summary.json; "strength at 9 MPa"
  // Of its test, and of that whose figure it is over, "Section/Key = value"; the latter is the same test but
  // for what the line says of it.
  std::vector<std::string> entries, over;
  double value = not_given;     // SI; of a curve: not given
  double tolerance = not_given; // relative; of a curve: root mean square over its largest stress
  std::string file;             // of a curve; resolved
  std::string text;             // as it stands in the scene
  std::string entry;            // that says it, "Calibrate/Target 1"
  int curve_file = 0;           // 2: Calibrate/Curve 2
  int number = 0;               // 3: Calibrate/Target 3; 0 of what is only watched

  bool is_elastic() const { return program.empty(); }
  std::string words() const; // "(3) strength at 9 MPa, MPa"
  double unit() const;       // that words() names, SI
};

constexpr std::size_t most_targets = 20, most_curves = 3;

// A line as above; "" is none: its text is "". Throws ValueError.
Target read_target(const std::string &line);
// Of what stands in front of a line, "young modulus": without entries and value.
Target target_of(const std::string &what);

// Whether one of "Section/Key = value" is of that path.
bool sets(const std::vector<std::string> &entries, const std::string &path);
// What tests of tension and of splitting need beside what the line says of them: ends, speed, largest strain.
void complete_test(Target &target, const Scene &scene, double tension_rate);

extern const char *const target_allowed;

} // namespace platen::apps
