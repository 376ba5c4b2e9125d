// Packings that several runs share: each is made once and kept in a folder, by the recipe that it is made of.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "apps/output/run_log.h"
#include "apps/scene/scene.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

// All that decides the packing of a scene, in one line: its entries under Specimen but for those of the ends,
// the seed, and the version of the program. "" of a specimen that is read from a file. With `seed` in place
// of the scene's.
std::string packing_recipe(const Scene &scene, unsigned long seed);
// "packings/<digits of the recipe's SHA-256>.csv" without its folder.
std::string packing_name(const std::string &recipe);

// The scene's packing as `pack` gives it, to the last bit: from `folder` where one of its recipe is there and
// is as it was written (its last line is a checksum), else packed, and with `writes` left there. Of several
// runs that want it at once, on any machine that sees the folder, one packs and the others wait; on a file
// system without locks each packs. A file that is damaged is reported and made anew; one that cannot be kept
// is reported and does no harm.
dem::Specimen shared_packing(const Scene &scene, const std::filesystem::path &folder,
                             const std::function<dem::Specimen()> &pack, bool writes, RunLog &log);

} // namespace platen::apps
