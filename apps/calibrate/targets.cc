#include "apps/calibrate/targets.h"

#include <algorithm>

#include "apps/scene/parameters.h"
#include "apps/scene/surfaces.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

Range range_of(TargetKind kind) {
  if (kind == TargetKind::secant_ratio) return between_open(0, 0.5);
  return kind == TargetKind::poisson_ratio ? between_open(-1, 0.5) : above(0);
}

double friction_of(const StudySurface &face) {
  if (!std::isnan(face.friction)) return face.friction;
  for (const auto &[key, text] : surface(face.kind).entries)
    if (key == "Friction static") return read_quantity(text, "1", at_least(0));
  return not_given;
}

double value_of(const Parameters &parameters, const std::string &section, const TargetSection &from) {
  const std::string entry = section + "/Value", kind = tidy(parameters.at(section + "/Kind").text);
  if (from.kind == TargetKind::curve) {
    if (!from.value.empty())
      parameters.refuse(entry, "is one number, and Kind = curve has a File of them. Allowed: no value.");
    return not_given;
  }
  const std::string unit = unit_of(from.kind),
                    allowed = " Allowed: " + allowed_text(range_of(from.kind), unit) + ".";
  if (from.value.empty()) parameters.refuse(entry, "is not set: Kind = " + kind + " wants one." + allowed);
  try {
    return Quantity(kind, unit, range_of(from.kind)).read(from.value);
  } catch (const ValueError &error) {
    parameters.refuse(entry, std::string(error.what()) + ". Wanted for Kind = " + kind + "." + allowed);
  }
}

Target target_of(const Parameters &parameters, const std::string &section, const TargetSection &from,
                 const Calibrate &c) {
  Target to;
  to.kind = from.kind;
  to.value = value_of(parameters, section, from);
  to.weight = from.weight;
  to.tolerance = std::isnan(from.tolerance) ? c.tolerance : from.tolerance;
  to.pressure = from.pressure, to.sleeve = from.cell == ConfinementKind::sleeve;
  to.box = from.form == TargetForm::box;
  to.slenderness = from.slenderness;
  if (!from.platens.empty()) to.friction = friction_of(from.platens.front());
  if (!from.other_platens.empty()) to.other_friction = friction_of(from.other_platens.front());
  to.rate = from.rate, to.strain = from.strain;
  if (from.kind == TargetKind::curve) to.file = resolved_path(parameters.at(section + "/File"));
  to.entry = section + "/Kind";
  return to;
}

} // namespace

std::string section_of_target(std::size_t number) {
  return "Calibrate/Target " + std::to_string(number);
}

std::vector<Knob> read_knobs(const std::string &text) {
  std::vector<std::string> words;
  for (const auto &one : free_knobs)
    words.push_back(one.first);
  std::vector<Knob> knobs;
  std::string all = tidy(text);
  while (!all.empty()) {
    const std::size_t comma = std::min(all.find(','), all.size());
    const Knob knob = free_knobs[read_word(tidy(all.substr(0, comma)), words)].second;
    if (std::find(knobs.begin(), knobs.end(), knob) != knobs.end())
      throw ValueError("holds " + word_of(free_knobs, knob) + " twice");
    knobs.push_back(knob);
    all = comma < all.size() ? tidy(all.substr(comma + 1)) : "";
  }
  return knobs;
}

std::vector<StudySurface> read_platens_of_target(const std::string &text) {
  std::vector<StudySurface> faces = read_surfaces(text);
  if (faces.size() > 1) throw ValueError("holds more than one face");
  for (const StudySurface &face : faces)
    if (std::isnan(friction_of(face)) || (std::isnan(face.friction) && !surface(face.kind).of_one_side))
      throw ValueError("is more than friction: such platens are the scene's, for all targets");
  return faces;
}

std::string unit_of(TargetKind kind) {
  switch (kind) {
    case TargetKind::none:
    case TargetKind::curve:
      return "";
    case TargetKind::poisson_ratio:
    case TargetKind::strain_at_peak:
    case TargetKind::gain_by_friction:
    case TargetKind::cube_over_prism:
    case TargetKind::slenderness:
    case TargetKind::secant_ratio:
      return "1";
    default:
      return "Pa";
  }
}

std::vector<Target> targets_of(Parameters &parameters, const Calibrate &c) {
  std::vector<Target> all;
  const auto add = [&](TargetKind kind, double value, const char *key) {
    if (std::isnan(value)) return;
    all.emplace_back();
    all.back().kind = kind, all.back().value = value, all.back().tolerance = c.tolerance;
    all.back().entry = std::string("Calibrate/") + key;
  };
  add(TargetKind::young_modulus, c.young_modulus, "Young modulus");
  add(TargetKind::poisson_ratio, c.poisson_ratio, "Poisson ratio");
  add(TargetKind::strength, c.compressive_strength, "Compressive strength");
  add(TargetKind::tension, c.tensile_strength, "Tensile strength");
  add(TargetKind::strength_at_pressure, c.triaxial_strength, "Triaxial strength");
  if (!std::isnan(c.triaxial_strength)) all.back().pressure = c.confining_pressure;
  for (std::size_t k = 0; k < c.target_sections.size(); ++k) {
    const std::string section = section_of_target(k + 1);
    if (c.target_sections[k].kind != TargetKind::none) {
      parameters.attempt([&] { all.push_back(target_of(parameters, section, c.target_sections[k], c)); });
      continue;
    }
    for (const Entry &entry : parameters.entries())
      if (entry.path.rfind(section + "/", 0) == 0 && entry.changed() && !parameters.faults().any_in(section))
        parameters.attempt([&] {
          parameters.refuse(entry.path, "is of a target without a kind: " + section + "/Kind is not set.");
        });
  }
  return all;
}

} // namespace platen::apps
