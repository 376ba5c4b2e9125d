// What a study runs: cases, each a set of entries that differ from the scene, and seeds.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "apps/output/summary.h"
#include "apps/run/needs.h"
#include "apps/scene/scene.h"
#include "apps/scene/units.h"

namespace platen::apps {

enum class StudyKind { friction, slenderness, size, packing, rate, accuracy, vary, target };
// Those that tell what platens do, and have StudyCase::surface.
inline bool of_platens(StudyKind kind) {
  return kind == StudyKind::friction || kind == StudyKind::slenderness;
}

struct StudyCase {
  std::string name = {};                   // of folders and tables: "sphere_radius_1_mm"
  std::vector<std::string> overrides = {}; // "Section/Key = value"
  std::vector<double> labels = {};         // one for each of StudyPlan::varied, SI; NaN where it has none
  std::vector<std::string> words = {};     // by label: where it is a word instead of a number; else ""
  std::string surface = {};                // what the platens are, in words; studies of platens
  std::vector<std::string> packings = {};  // by seed: packing_name of its specimen; "" of one from a file
  std::string scene = {};                  // that its entries change; "": the study's
  std::string envelope = {};               // its name but for its pressure: what one failure envelope is of
  CountedCosts costs = {};                 // of a run, counted from its scene; NaN where that cannot be
  bool is_expected = true;                 // whether what the scene expects holds for it

  Json label(std::size_t k) const {
    return k < words.size() && !words[k].empty() ? Json(words[k]) : Json(labels[k]);
  }
};

// What trades accuracy for time, turned alone; all else is as the scene has it.
struct StudiedParameter {
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
  std::vector<unsigned long> seeds = {};
  std::vector<StudiedParameter> parameters = {}; // study of accuracy

  // The place of a column in `varied`; their number where it is none of them.
  std::size_t place_of(const std::string &column) const;
};

const char *word(StudyKind kind);
// Of a word of study_words (study_section.h): the command line has refused any other.
StudyKind study_kind(const std::string &word);

// Throws InputError where the scene leaves a kind nothing to vary, or where a case is a scene that
// platen-compress would refuse; `overrides` are those of the command line.
StudyPlan plan_study(StudyKind kind, const Scene &scene, const std::vector<std::string> &overrides);

// All that makes one run of a case from the scene: the command line's, the case's and the seed.
std::vector<std::string> overrides_of(const StudyCase &of, unsigned long seed,
                                      const std::vector<std::string> &overrides);

// The scene that a case leads to. Throws InputError, naming the case, where platen-compress would refuse it.
Scene scene_of(const StudyCase &of, StudyKind kind, const Scene &scene, unsigned long seed,
               const std::vector<std::string> &overrides);

// A column of study.csv that tells cases apart, in the order of the tables.
struct CaseColumn {
  const char *name;            // "sphere_radius_m"
  double (*of)(const Scene &); // of the scene that a case leads to, SI; NaN where it has none
  const char *head = nullptr;  // on the screen, in multiples of `unit`; null: it is not shown
  double unit = 1;
};
// Null of one that only a study of any entries has.
const CaseColumn *case_column(const std::string &name);

// Cases of the studies of platens: what faces the specimen, and how slender it is. Platens x slendernesses x
// sphere radii x pressures of the scene's section Study; a list that is empty leaves what the scene has. A
// specimen of another height is packed anew with the same recipe, spheres, width and seed, and pressed at the
// same speed: so many wave transits to the same strain, whatever the height. Throw InputError where there is
// nothing to vary or the scene contradicts it.
StudyPlan plan_friction(const Scene &scene);
StudyPlan plan_slenderness(const Scene &scene); // one kind of platens
// What the platens of a scene are, in words.
std::string surface_of(const Scene &scene);
// Their coefficients of friction; null where they differ or are glued.
const dem::SurfaceFriction *common_friction(const Scene &scene);

// Cases of the study of accuracy: what trades accuracy for time, one thing at a time. A case for each value
// of each list of the section Study that such a study knows, all else as the scene has it; what the scene has
// itself is one case, `base`, whichever lists hold it. Lists go from coarse to fine, their last value is the
// reference of the others; that of Study/Effects list is the scene as it is. Throws InputError where nothing
// is varied, a list goes the wrong way, or the scene contradicts it.
StudyPlan plan_accuracy(const Scene &scene);
// Whether a column of such a study decides anything in the scene that a case leads to.
bool decides(const std::string &column, const Scene &scene);

// Cases of a target: the scene at each speed of Study/Wave crossings list, and what a gain is over likewise;
// the fastest again with half the step and with coarser spheres, where these are asked for. Seeds are those
// of the pilot; which further ones are run is decided as it goes (target_study.h). Half a step and coarser
// spheres are those of each scene itself. Throws InputError where a scene leaves nothing to plan.
StudyPlan plan_target(const Scene &scene, const std::vector<std::string> &overrides);

// What the plans of several kinds need.

// A case of each value of a list by of(value); of an empty list the scene as it is.
template <class Value, class Of>
std::vector<StudyCase> cases_of(const std::vector<Value> &list, const Of &of) {
  std::vector<StudyCase> cases(list.empty() ? 1 : 0);
  for (const Value &value : list)
    cases.push_back(of(value));
  return cases;
}
// Both together: names, entries and labels one after the other.
StudyCase joined(StudyCase a, const StudyCase &b);
// Each of the first with each of the second, which changes more slowly.
std::vector<StudyCase> times(const std::vector<StudyCase> &first, const std::vector<StudyCase> &second);
// Its place in the plan; what two lists lead to is one case, which runs once.
std::size_t add(StudyPlan &plan, StudyCase one);
// Throws InputError where a run may end before its stress has fallen to 0.8 of the peak, where damage is
// measured and from where on a run is known to have peaked.
void require_fall(const Scene &scene);

// "Section/Key = value unit".
inline std::string set(const std::string &path, double value, const std::string &unit) {
  return path + " = " + shortest_text(value) + (unit.empty() ? "" : " " + unit);
}

// Three widths of 0.05 m are 0.15 m, whatever the product's last bit.
inline double to_twelve_digits(double value) {
  return std::stod(fmt::format("{:.12g}", value));
}

// For a name: without the last bit that a unit's conversion may leave (0.9 mm is 0.0009000000000000001 m).
inline std::string in_name(double value) {
  return fmt::format("{:.12g}", value);
}
// The same in the unit that is usual: "1.4_mm" of 0.0014 m.
inline std::string in_name(double value, const std::string &si_unit) {
  return in_usual_unit(value, si_unit, "_");
}

// For a name: letters and digits in lower case, one underscore for each run of anything else.
std::string as_name(const std::string &words);

} // namespace platen::apps
