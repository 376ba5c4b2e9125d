#include "apps/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>

#include "apps/scene/declare.h"
#include "apps/scene/layers.h"
#include "apps/scene/regular_file.h"
#include "apps/scene/scene_check.h"
#include "apps/scene/specimen_file.h"
#include "apps/scene/surfaces.h"
#include "apps/scene/tubes.h"

namespace platen::apps {
namespace {

// What the spheres of a file without a shape fill, where the scene has no length of it either.
std::optional<dem::ShapeKind> filled_by_spheres(const SpecimenSection &specimen, bool states_shape) {
  for (const double length : {specimen.height, specimen.radius, specimen.width_x, specimen.width_y})
    if (!std::isnan(length)) return std::nullopt;
  const bool round = specimen.shape == SpecimenShape::cylinder || specimen.shape == SpecimenShape::disc;
  return states_shape && round ? dem::ShapeKind::cylinder : dem::ShapeKind::box;
}

// The specimen of a file stands for the entries that the scene leaves out: lengths are in units of its mean
// radius, its height and its width. A radius that the scene has for spheres of another size has no effect.
// Throws EntryError for a file that cannot be read as one.
void supply_specimen(Scene &scene, Parameters &parameters) {
  const char *const shape_entry = "Specimen/Shape";
  constexpr double same_radius = 0.1; // drawn radii have another mean than their distribution
  SpecimenSection &to = scene.specimen;
  const Entry &entry = parameters.at("Specimen/File");
  if (to.packing != PackingKind::file || !open_file(to.file)) return; // which the checks refuse
  to.form.filled = filled_by_spheres(to, !parameters.at(shape_entry).origin.file.empty());
  SpecimenFile file;
  try {
    file = read_specimen_file(to.file, to.form);
  } catch (const InputError &error) {
    throw EntryError(error.what(), entry.origin, entry.path);
  }
  for (const std::string &note : file.notes)
    scene.notes.push_back(entry.origin.text() + ": note: " + entry.path + " = " + entry.text + ", " + note +
                          ".");
  const auto take = [](double &own, double found) { own = std::isnan(own) ? found : own; };
  const double radius = dem::mean_radius(file.specimen);
  if (!(std::abs(to.sphere_radius / radius - 1) <= same_radius)) to.sphere_radius = radius;
  if (!file.states_shape && !to.form.filled) return;
  // Else the scene as it is written would ask for a cylinder.
  if (!file.states_shape && *to.form.filled == dem::ShapeKind::box && to.shape == SpecimenShape::cylinder)
    parameters.supply(shape_entry, "box");
  const dem::Shape &shape = file.specimen.shape;
  const bool disc = shape.kind == dem::ShapeKind::disc, box = shape.kind == dem::ShapeKind::box;
  take(to.height, disc ? shape.width_y : shape.height);
  if (box)
    take(to.width_x, shape.width_x), take(to.width_y, shape.width_y);
  else
    take(to.radius, shape.radius);
  if (parameters.at(shape_entry).changed()) return;
  to.shape = box ? SpecimenShape::box : disc ? SpecimenShape::disc : SpecimenShape::cylinder;
}

// Without a pressure there is no cell, so that a series over pressures may begin with none.
void leave_out_cell(Scene &scene, const Parameters &parameters, const Program &program) {
  Loading &loading = scene.loading;
  const bool none =
      loading.cell->pressure == 0 && !parameters.at("Loading/Confining pressure").origin.file.empty();
  const bool varied = Situation{scene, parameters, program}.given_by_program("Loading/Confining pressure");
  if (none && !loading.tubed() && !loading.staged() && !loading.hydrostatic() && !varied)
    loading.confinement = ConfinementKind::none;
}

// Fills what one entry takes from another, so that the apps need not know the rules.
void inherit(Scene &scene, Parameters &parameters, const Program &program) {
  supply_quality(parameters, scene.general.quality);
  supply_surfaces(parameters, scene.platens);
  supply_tube(parameters, scene.loading);
  Platens &platens = scene.platens;
  const auto take = [](double &own, double common) { own = std::isnan(own) ? common : own; };
  for (const coupling::Side which : coupling::all_sides) {
    dem::SurfaceFriction &side = platens.at(which);
    const dem::SurfaceFriction &both = platens.both;
    take(side.friction_static, both.friction_static);
    take(side.friction_dynamic, both.friction_dynamic);
    side.friction_dynamic = side.dynamic();
    if (has_word(parameters, section_of(which) + "/Friction law", {"common"}))
      side.weakening.by = both.weakening.by;
    take(side.weakening.slip_length, both.weakening.slip_length);
    take(side.weakening.slip_velocity, both.weakening.slip_velocity);
    platens.face(which).mesh_file = resolved_path(parameters.at(section_of(which) + "/Mesh file"));
  }
  scene.specimen.file = resolved_path(parameters.at("Specimen/File"));
  scene.specimen.bond_file = resolved_path(parameters.at("Specimen/Bond file"));
  scene.loading.hardening_file = resolved_path(parameters.at("Sleeve/Hardening file"));
  parameters.attempt([&] { supply_specimen(scene, parameters); });
  parameters.attempt([&] { supply_layers(parameters, platens); });
  if (platens.thickness == 0 && !std::isnan(scene.specimen.height))
    platens.thickness = 0.1 * scene.specimen.height;
  scene.loading.stages = stages_of(scene.loading.stage_sections);
  leave_out_cell(scene, parameters, program);
  scene.phases.file = resolved_path(parameters.at("Phases/File"));
  for (Expectation &expectation : scene.expect)
    expectation.origin = parameters.at("Expect/" + expectation.key).origin.text();
  if (program.complete != nullptr) program.complete(parameters, scene);
}

void keep(Scene &scene, Parameters &parameters) {
  parameters.release();
  scene.parameters = std::make_shared<const Parameters>(std::move(parameters));
}

// What holds whatever a word was meant to be that could not be read: it decides what else is needed.
Faults found_in(Scene &scene, Parameters &parameters, const Program &program) {
  Faults found = check_scene(scene, parameters, program);
  for (const EntryError &fault : parameters.faults().all()) {
    const Entry *entry = parameters.find(fault.entry);
    if (entry == nullptr || found.empty()) continue;
    for (const std::string &word : std::vector<std::string>(entry->words)) {
      parameters.pretend(fault.entry, word);
      found.keep_common(check_scene(scene, parameters, program));
    }
    if (!entry->words.empty()) parameters.pretend(fault.entry, "");
  }
  return found;
}

void declare(Scene &scene, Parameters &parameters, const Program &program) {
  scene.program = &program;
  declare_scene(parameters, scene);
  if (program.declare != nullptr) program.declare(parameters, scene);
  for (const std::string &section : program.foreign)
    parameters.pass_over(section);
}

enum class Contradictions { refused, left };

Scene read(const std::string &path, const std::vector<std::string> &overrides, const Program &program,
           Contradictions contradictions) {
  Scene scene;
  Parameters parameters;
  declare(scene, parameters, program);
  scene.path = path;
  scene.name = std::filesystem::path(path).stem().string();
  parameters.apply(file_assignments(path));
  for (std::size_t k = 0; k < overrides.size(); ++k)
    parameters.attempt([&] { parameters.override_entry(overrides[k], static_cast<int>(k) + 1); });
  if (parameters.whole()) inherit(scene, parameters, program);
  if (parameters.whole() && contradictions == Contradictions::refused)
    parameters.add_independent(found_in(scene, parameters, program));
  parameters.throw_faults();
  keep(scene, parameters);
  return scene;
}

} // namespace

Scene default_scene(const Program &program) {
  Scene scene;
  Parameters parameters;
  declare(scene, parameters, program);
  inherit(scene, parameters, program);
  keep(scene, parameters);
  return scene;
}

Scene read_scene(const std::string &path, const std::vector<std::string> &overrides, const Program &program) {
  return read(path, overrides, program, Contradictions::refused);
}

std::string completed_scene_text(const std::string &path, const std::string &folder, const Program &program) {
  try {
    return scene_text(read(path, {}, program, Contradictions::left), folder);
  } catch (const InputError &) {
    std::ostringstream text;
    text << open_file(path).rdbuf();
    return text.str();
  }
}

void refuse(const Scene &scene, const std::string &entry, const std::string &reason) {
  if (scene.parameters && scene.parameters->find(entry)) scene.parameters->refuse(entry, reason);
  throw InputError("error: " + entry + " " + reason);
}

} // namespace platen::apps
