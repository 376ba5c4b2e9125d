#include "apps/run/packing_cache.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "apps/run/shared_packing.h"
#include "apps/scene/version.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

std::string environment(const char *name) {
  const char *value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// A folder of our own in that of the user's caches.
fs::path folder_of_user() {
  const std::string caches = environment("XDG_CACHE_HOME"), home = environment("HOME");
  if (!caches.empty() && fs::path(caches).is_absolute()) return fs::path(caches) / "platen" / "packings";
  return home.empty() ? fs::path() : fs::path(home) / ".cache" / "platen" / "packings";
}

// A cache that nobody asked for and that cannot be written is none.
bool can_be_written(const fs::path &folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  return fs::is_directory(folder, failure);
}

} // namespace

fs::path packing_cache(const std::string &cache) {
  if (cache == "none" || cache.empty()) return {};
  if (cache != "default") return cache;
  const std::string named = environment("PLATEN_CACHE");
  if (named == "none") return {};
  if (!named.empty()) return named;
  if (!has_commit_of_its_own()) return {};
  return folder_of_user();
}

void trim_packings(const fs::path &folder, std::uintmax_t bytes, const fs::path &newest) {
  struct Kept {
    fs::path path;
    std::uintmax_t size;
    fs::file_time_type used;
  };
  std::vector<Kept> kept;
  std::error_code failure;
  for (const auto &entry : fs::directory_iterator(folder, failure)) {
    std::error_code gone;
    const Kept one{entry.path(), entry.file_size(gone), entry.last_write_time(gone)};
    if (!gone && one.path.extension() == ".csv") kept.push_back(one);
  }
  std::sort(kept.begin(), kept.end(), [](const Kept &a, const Kept &b) { return a.used > b.used; });
  std::uintmax_t used = 0;
  for (const Kept &one : kept) {
    used += one.size;
    if (used > bytes && one.path.filename() != newest.filename()) fs::remove(one.path, failure);
  }
}

KeepPacking keep_packing(const CommandLine &command, const Scene &scene, bool writes, RunLog &log) {
  if (command.packings.empty()) return keep_in_cache(scene, writes, log);
  if (scene.specimen.packing == PackingKind::file) return {};
  return [folder = fs::path(command.packings), writes, &scene,
          &log](const std::function<dem::Specimen()> &pack) {
    return shared_packing(scene, folder, pack, writes, log);
  };
}

KeepPacking keep_in_cache(const Scene &scene, bool writes, RunLog &log) {
  if (scene.specimen.packing == PackingKind::file) return {};
  const fs::path folder = packing_cache(scene.specimen.cache);
  if (folder.empty() || (writes && !can_be_written(folder))) return {};
  return [folder, writes, &scene, &log](const std::function<dem::Specimen()> &pack) {
    dem::Specimen specimen = shared_packing(scene, folder, pack, writes, log);
    if (!writes) return specimen;
    const fs::path file = folder / packing_name(packing_recipe(scene, scene.general.seed));
    std::error_code none;
    fs::last_write_time(file, fs::file_time_type::clock::now(), none);
    trim_packings(folder, packing_cache_bytes, file);
    return specimen;
  };
}

} // namespace platen::apps
