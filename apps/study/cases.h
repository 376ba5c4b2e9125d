// What a study runs: cases, each a set of entries that differ from the scene, and seeds.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/scene.h"

namespace platen::apps {

enum class StudyKind { friction, slenderness, size, packing, rate, accuracy };
// Those that tell what platens do, and have StudyCase::surface.
inline bool of_platens(StudyKind kind) {
  return kind == StudyKind::friction || kind == StudyKind::slenderness;
}

struct StudyCase {
  std::string name;                   // of folders and tables: "sphere_radius_0.001"
  std::vector<double> labels;         // one for each column of StudyPlan::varied, SI; NaN where it has none
  std::vector<std::string> overrides; // "Section/Key = value"
  std::string surface = {};           // what the platens are, in words; studies of platens
};

// What trades accuracy for time, turned alone; all else is as the scene has it.
struct Knob {
  struct Value {
    std::string text;        // "0.9", "Effects/Rotation = off"
    double number;           // SI; NaN where it is none
    std::size_t of_case = 0; // StudyPlan::cases
  };
  std::string name;          // of tables: "safety"
  std::string entry, unit;   // "Integration/Safety", SI unit of the numbers; "" where there is none
  bool ordered = true;       // from coarse to fine; else each value but the last is a change of its own
  std::vector<Value> values; // the last is the reference of the others
};

struct StudyPlan {
  StudyKind kind = StudyKind::size;
  std::vector<std::string> varied; // columns that tell the cases apart
  std::vector<StudyCase> cases;    // in the order in which they run; no two the same
  std::vector<unsigned long> seeds;
  std::vector<Knob> knobs = {}; // study of accuracy
};

const char *word(StudyKind kind);
// The kinds that this version has.
const std::vector<StudyKind> &known_study_kinds();

// Throws InputError where the scene leaves a kind nothing to vary, or where a case is a scene that
// platen-compress would refuse; `overrides` are those of the command line.
StudyPlan plan_study(StudyKind kind, const Scene &scene, const std::vector<std::string> &overrides);

// All that makes one run of a case from the scene: the command line's, the case's and the seed.
std::vector<std::string> overrides_of(const StudyCase &of, unsigned long seed,
                                      const std::vector<std::string> &overrides);

} // namespace platen::apps
