// A scene as the apps use it: every parameter of a scene file, checked, converted to SI and put into plain
// structs, one for each section of the file. NaN means "not given" where a member says so.
#pragma once

#include <any>
#include <filesystem>
#include <iosfwd>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene/quality.h"
#include "apps/scene/quantities.h"
#include "apps/scene/scene_bond.h"
#include "apps/scene/scene_loading.h"
#include "apps/scene/scene_specimen.h"
#include "dem/model.h"

namespace platen::apps {

class Parameters;
struct Program;

struct General { // section Scene
  std::string title;
  unsigned long seed = 1;
  Quality quality = Quality::custom;
  std::string standard = "none"; // by which the test is reported (apps/scene/standards.h)
};

struct Output {
  Interval every;        // rows of history.csv; none: the app chooses
  Interval fields_every; // frames of the .pvd series; none: the app chooses
  bool fields = true;
  double sound_share = 0.7;   // of its bonds, that a sphere of an intact piece has kept
  double crack_roughness = 1; // what a rough crack lets through over a smooth one
  double event_reach = 5,
         event_time = 1; // of acoustic events: mean radii; times that a wave takes over that reach
};

struct Checkpoint {
  Interval every{Interval::Kind::time, 600}; // time: s of wall clock; none: no checkpoints
};

struct Scene {
  std::string name = "default"; // file name without its ending
  std::string path;             // as given on the command line
  General general;
  SpecimenSection specimen;
  dem::ModelSettings model; // of Material, Effects, Bond and Integration; what is optional in it stands below
  Effects effects;
  Bond bond;
  PhasesSection phases;
  dem::ContactSettings contact; // and of Material
  Platens platens;
  Loading loading;
  coupling::TimeStepSettings time_step;
  Output output;
  Checkpoint checkpoint;
  std::vector<Expectation> expect;  // only those that the scene gives
  std::any section;                 // of the program: what its own section says
  const Program *program = nullptr; // that reads the scene
  std::vector<std::string> notes;   // entries that were set and have no effect here, one line each
  std::shared_ptr<const Parameters> parameters; // the same entries as text

  // The settings of the program's own section, which the second makes if there are none. Throws
  // std::bad_any_cast for those of another program.
  template <class Section>
  const Section &own() const {
    return std::any_cast<const Section &>(section);
  }
  template <class Section>
  Section &own() {
    if (!section.has_value()) section.emplace<Section>();
    return std::any_cast<Section &>(section);
  }

  // Whether grains press on platens by Hertz' law.
  bool hertz_on_platens() const {
    if (platens.contact != coupling::PlatenContact::as_grains)
      return platens.contact == coupling::PlatenContact::hertz;
    return !platens.glued && effects.contact == dem::NormalContact::hertz;
  }
};

// Every entry at its default, nothing required. Never throws InputError.
Scene default_scene(const Program &program);

// Reads `path` (.prm or .json), applies overrides ("Section/Key = value", in order), converts and checks all.
// Keys of sections that other programs own are passed over. Throws InputError with all that is wrong: file,
// line, key, value, what is allowed of each. `program` has to outlive the scene.
Scene read_scene(const std::string &path, const std::vector<std::string> &overrides, const Program &program);

// Throws InputError on behalf of an entry, with the place where it was set: "case.prm:14: error: ...".
[[noreturn]] void refuse(const Scene &scene, const std::string &entry, const std::string &reason);

// All parameters as used, defaults included, as a .prm that reads back to the same numbers bit for bit; paths
// of files are written so that they hold from `folder`, where the text will lie.
std::string scene_text(const Scene &scene, const std::filesystem::path &folder);

// The text of a scene that scene_text gave for `folder`, as this program writes it: entries that it lacks,
// because the program that wrote it had none, stand there with their defaults. As it is where it cannot be
// read.
std::string completed_scene_text(const std::string &path, const std::string &folder, const Program &program);

// Every parameter that a program reads with value, default, unit, range and meaning: as .prm, or as JSON
// (readable as a scene too). `part` is a section or an entry that is printed alone, "" all. Throws InputError
// for one that is not known, or that the program does not read.
void print_parameters(const Scene &scene, const std::string &part, bool as_json, std::ostream &out);

} // namespace platen::apps
