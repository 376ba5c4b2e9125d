// Sections of a scene that say what is tested. NaN means "not given" where a member says so.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/quantities.h"
#include "apps/scene/specimen_file.h"
#include "dem/bond_choice.h"
#include "dem/contacts.h"
#include "dem/heterogeneity.h"
#include "dem/packing/advancing_front.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

enum class SpecimenShape { cylinder, box, bar, disc };
using RadiusKind = dem::RadiusDistribution::Kind;
enum class PackingKind { advancing_front, random_close, file };

constexpr std::size_t most_flaws = 8;

struct SpecimenSection {
  SpecimenShape shape = SpecimenShape::cylinder;
  double radius = not_given;                       // m; cylinder, round bar
  double height = not_given;                       // m, along z
  double width_x = not_given, width_y = not_given; // m; box, rectangular bar
  double sphere_radius = not_given;                // m, mean
  double radius_spread = 0;                        // kappa = (largest - smallest radius) / mean
  RadiusKind radius_distribution = RadiusKind::uniform;
  double second_radius_ratio = 0.5; // two sizes: second radius over the first
  double second_fraction = 0.5;     // two sizes: share of the number of spheres that has the second radius
  PackingKind packing = PackingKind::advancing_front;
  int tile_spheres = 0;                // random close: laid out of tiles of so many; 0: grown as a whole
  std::string file;                    // Packing = file; resolved against the folder of the scene
  SpecimenForm form;                   // of that file
  std::vector<SpecimenFormat> exports; // of a packing, besides specimen.csv
  std::string bond_file;               // names the bonded pairs; resolved as File
  std::array<std::optional<dem::Flaw>, most_flaws> flaws;
  dem::EndPreparation ends = dem::EndPreparation::as_packed;
  double end_layer = 1;          // mean sphere radii
  double end_height = not_given; // m, of ends that are not flat
  dem::FacedEnds end_faces = dem::FacedEnds::top;
  bool seat = false;
  bool net_section = false;
  dem::Notch notch;              // of a bar that is bent
  std::string cache = "default"; // folder of packings that are kept; default: that of the user; none: none

  bool round() const {
    return !std::isnan(radius);
  } // cross-section: circle of `radius`, else width_x x width_y
  // m, the least across its axis; NaN where it is not given.
  double width() const { return shape == SpecimenShape::box ? std::min(width_x, width_y) : 2 * radius; }
};

struct Effects { // the others stand in dem::ModelSettings, ContactSettings and Bond
  std::optional<dem::NormalContact> contact = dem::NormalContact::linear;
  bool gravity = false;
};

enum class PhasesBy { none, radius, file };

struct PhasesSection { // aggregates in a matrix
  PhasesBy by = PhasesBy::none;
  dem::Phases phases;
  std::string file; // by = file; resolved against the folder of the scene
};

} // namespace platen::apps
