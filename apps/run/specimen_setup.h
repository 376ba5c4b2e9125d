// From the section Specimen of a scene to a packing of spheres.
#pragma once

#include <functional>
#include <string>

#include "apps/scene/settings.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

// How often a packing of tiles repeats itself, within a percent.
struct Tiling {
  double tiles = 0;  // volume of the specimen over that of a tile; 0 where it is grown as a whole
  double period = 0; // m, along x, y and z
};
Tiling tiling_of(const Scene &scene, const dem::Shape &shape);
// A line for the screen; none where nothing repeats itself.
std::string text_of(const Tiling &tiling);

// Throws InputError where more spheres fill the shape than the memory of this machine holds, or fewer than
// two tiles do.
void check_count(const Scene &scene, const dem::Shape &shape);

// What becomes of a packing: calls `pack`, or takes what it would give from elsewhere.
using KeepPacking = std::function<dem::Specimen(const std::function<dem::Specimen()> &pack)>;

// Packs the spheres of a scene, or reads them from Specimen/File; the seed of the scene decides all random
// numbers.
// A file's own shape holds; dimensions in the scene must agree with it within 1e-6, and are needed where the
// file states none. Throws InputError: the file is malformed, holds spheres that coincide or reach out of the
// shape by more than 0.01 mean radii, contradicts the scene; or the scene asks for two sizes in a random
// close packing. Throws std::invalid_argument and std::runtime_error as the packers do (does not fit, does
// not jam).
dem::Specimen make_specimen(const Scene &scene);

// The same for bonds between the spheres. Throws InputError too where Bond/Gap reaches past neighbours.
// `keep`, where it is given, is asked for a packing; for a specimen of a file it is not.
dem::Specimen make_bonded_specimen(const Scene &scene, const KeepPacking &keep = {});

// Throws InputError where this machine's memory cannot hold the spheres that fill the specimen; make_specimen
// does so too.
void require_room(const Scene &scene);

// The phases of the scene fit this specimen: none is empty, and every id of Phases/File is a sphere's.
// make_specimen sees to it; for specimens that come from elsewhere. Throws InputError, naming the line.
void check_phases(const Scene &scene, const dem::Specimen &specimen);

} // namespace platen::apps
