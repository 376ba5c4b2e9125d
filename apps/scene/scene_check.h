// The checks of a scene, section by section; each adds what it finds, one fault of an entry.
#pragma once

#include <string>

#include "apps/scene/declare.h"
#include "apps/scene/scene.h"

namespace platen::apps {

class SceneCheck {
public:
  SceneCheck(Scene &scene, const Parameters &parameters, const Program &program, Faults &found)
      : scene_(scene), parameters_(parameters), program_(program), found_(found) {}

  void specimen() const;
  void effects() const;
  void needed() const;
  void bond() const;
  void size_correction() const;
  void calibrated_packing() const;
  void phases() const;
  void contact() const;
  void platens() const;
  void loading() const;
  void asked_of_program() const;
  void test() const; // by the rules of the library
  void scale() const;
  void standard() const;
  void notes();

  // For what programs check of their own sections.
  const Scene &scene() const { return scene_; }
  const Parameters &parameters() const { return parameters_; }
  bool loads() const { return situation().loads(); }
  // Goes on: what comes after it has to hold without it.
  void refuse(const std::string &path, const std::string &reason) const;
  void need(const std::string &path, double value, const std::string &why) const {
    if (!given(value) && !situation().given_by_program(path))
      refuse(path, "is not set: " + why + " Allowed: " + limits(parameters_.at(path)) + ".");
  }
  void readable(const std::string &path, const std::string &file, const std::string &why) const;
  // Says that an entry which the scene sets has no effect.
  void note(const std::string &path, const std::string &why) const;
  std::string set_to(const std::string &path) const; // "Specimen/Height = 40 mm"

private:
  Situation situation() const { return {scene_, parameters_, program_}; }
  void cross_section() const;
  void spheres_fit() const;
  void surfaces() const;
  void tube() const;
  void meshes() const;
  void layers() const;
  void layers_of(const std::string &path, const std::vector<NamedLayer> &layers, bool plate) const;
  void proportions() const;
  double wave_speed() const;
  void waves() const;
  void bodies() const;
  void strips() const;
  void stage_rates() const;
  void step_count() const;
  void stresses() const;
  void stiffnesses() const;
  void notes_of_declarations();
  void size_note();
  void radius_note();

  Scene &scene_;
  const Parameters &parameters_;
  const Program &program_;
  Faults &found_;
};

// Contradictions and what is missing, with their places; adds to scene.notes.
Faults check_scene(Scene &scene, const Parameters &parameters, const Program &program);

} // namespace platen::apps
