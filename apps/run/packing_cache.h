// Packings that the runs of this user share unless the scene says otherwise: made once, found by what they
// are made of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "apps/output/run_log.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/command_line.h"

namespace platen::apps {

// Beyond so much those that were not used for longest are removed, B.
constexpr std::uintmax_t packing_cache_bytes = std::uintmax_t(1) << 30;

// The folder that Specimen/Cache means; "" for none. `default` is PLATEN_CACHE where that is set, else
// platen/packings in XDG_CACHE_HOME or ~/.cache; none of a program whose commit is not known or whose source
// was changed since, because its packings have no name of their own.
std::filesystem::path packing_cache(const std::string &cache);

// What becomes of the packing of this scene: it is kept in the folder that the command line names, or in the
// cache. With `writes` it is left there.
KeepPacking keep_packing(const CommandLine &command, const Scene &scene, bool writes, RunLog &log);
// The same of the cache alone. Only of a scene whose Specimen is as it was read. Several threads may pack.
KeepPacking keep_in_cache(const Scene &scene, bool writes, RunLog &log);

// Removes those that were not used for longest until the others fit into `bytes`; never `newest`. What cannot
// be removed stays.
void trim_packings(const std::filesystem::path &folder, std::uintmax_t bytes,
                   const std::filesystem::path &newest);

} // namespace platen::apps
