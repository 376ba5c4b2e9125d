// The checks of a scene, section by section; each adds what it finds, one fault of an entry.
#pragma once

#include <string>

#include "apps/scene/declare.h"
#include "apps/scene/scene.h"

namespace platen::apps {

class SceneCheck {
public:
  SceneCheck(Scene &scene, const Parameters &parameters, AppKind app, Faults &found)
      : scene_(scene), parameters_(parameters), app_(app), found_(found) {}

  void specimen() const;
  void effects() const;
  void needed() const;
  void bond() const;
  void size_correction() const;
  void calibrated_packing() const;
  void phases() const;
  void contact() const;
  void sides() const;
  void platens() const;
  void loading() const;
  void wave_transits() const;
  void start() const;
  void splitting() const;
  void bending() const;
  void cycles() const;
  void stages() const;
  void cell() const;
  void pair_test() const;
  void led_pair() const;
  void calibrate() const;
  void triaxial_strength() const;
  void target(const Target &target) const;
  void free_parameters() const;
  void calibrate_bounds() const;
  void bar_test() const;
  void study() const;
  void scale() const;
  void notes();

private:
  bool loads() const { return Situation{scene_, parameters_, app_}.loads(); }
  // Goes on: what comes after it has to hold without it.
  void refuse(const std::string &path, const std::string &reason) const;
  void need(const std::string &path, double value, const std::string &why) const {
    if (!given(value) && !Situation{scene_, parameters_, app_}.varied(path))
      refuse(path, "is not set: " + why + " Allowed: " + limits(parameters_.at(path)) + ".");
  }
  void readable(const std::string &path, const std::string &file, const std::string &why) const;
  void cross_section() const;
  void spheres_fit() const;
  void surfaces() const;
  void deformable_platens() const;
  void machine() const;
  void meshes() const;
  void layers() const;
  void layers_of(const std::string &path, const std::vector<NamedLayer> &layers, bool plate) const;
  void seat() const;
  void friction(coupling::Side of) const;
  void weakening(coupling::Side of) const;
  std::string set_to(const std::string &path) const;
  void proportions() const;
  double wave_speed() const;
  void waves() const;
  void bodies() const;
  void strips() const;
  void stage_rates() const;
  void step_count() const;
  void stresses() const;
  void stiffnesses() const;
  void pair_scale() const;
  void note(const std::string &path, const std::string &why);
  void notes_of_declarations();
  void bar_notes();
  void pair_notes();
  void size_note();
  void radius_note();

  Scene &scene_;
  const Parameters &parameters_;
  AppKind app_;
  Faults &found_;
};

} // namespace platen::apps
