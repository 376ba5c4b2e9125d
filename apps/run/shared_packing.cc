#include "apps/run/shared_packing.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

#include "apps/output/file.h"
#include "apps/output/file_lock.h"
#include "apps/output/sha256.h"
#include "apps/output/specimen_csv.h"
#include "apps/scene/parameters.h"
#include "apps/scene/version.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t name_digits = 16, sum_digits = 64;
constexpr std::string_view recipe_words = "# recipe: ", sum_words = "# sha256 of all above: ";
constexpr std::size_t last_line_bytes = sum_words.size() + sum_digits + 1;
constexpr const char *lock_name = "in_use";
// For the run that packs; after that, one packs for itself: the other may be on a machine that is lost.
constexpr std::chrono::hours patience{1};

// Of the specimen, but not of where its spheres are.
constexpr std::array<const char *, 11> no_part_of_it{
    "Specimen/File",      "Specimen/File format", "Specimen/File columns", "Specimen/Export",
    "Specimen/Bond file", "Specimen/Ends",        "Specimen/End layer",    "Specimen/Seat",
    "Specimen/Cache",     "Specimen/Notch depth", "Specimen/Notch width"};

// Of a file, what it holds.
std::string recipe_text(const Entry &entry) {
  if (!entry.is_file || entry.text.empty()) return entry.text;
  return sha256_of_file(resolved_path(entry)).value_or("missing");
}

std::string file_start(const std::string &recipe) {
  return fmt::format("{}{}\n", recipe_words, recipe);
}

// The byte of the lock file that stands for a packing.
std::uint64_t lock_byte(const fs::path &file) {
  constexpr std::size_t digits = 8; // as many bytes as any file system allows
  return std::stoull(file.filename().string().substr(0, digits), nullptr, 16);
}

// What speaks against a packing that is there; "" where nothing does.
std::string fault_of(const fs::path &file, const std::string &recipe) {
  std::error_code failure;
  if (!fs::is_regular_file(file, failure)) return "is no file";
  const std::uintmax_t size = fs::file_size(file, failure);
  const std::string start = file_start(recipe);
  if (failure || size < start.size() + last_line_bytes) return "is cut short";
  std::ifstream stream(file, std::ios::binary);
  std::string first(start.size(), '\0'), last(last_line_bytes, '\0');
  stream.read(first.data(), static_cast<std::streamsize>(first.size()));
  stream.seekg(static_cast<std::streamoff>(size - last_line_bytes));
  stream.read(last.data(), static_cast<std::streamsize>(last.size()));
  if (!stream) return "cannot be read";
  if (first != start) return "is of another recipe";
  const std::optional<std::string> sum = sha256_of_file(file, size - last_line_bytes);
  return sum && last == fmt::format("{}{}\n", sum_words, *sum) ? "" : "is not as it was written";
}

// Nothing where it is not there, or is damaged, which is reported.
std::optional<dem::Specimen> read(const fs::path &file, const std::string &recipe, RunLog &log) {
  std::error_code none;
  if (!fs::exists(fs::symlink_status(file, none))) return std::nullopt;
  std::string fault = fault_of(file, recipe);
  if (fault.empty()) try {
      SpecimenFile found = read_specimen_csv(file);
      if (found.states_shape) return std::move(found.specimen);
      fault = "states no shape";
    } catch (const InputError &error) { // gone or changed since it was looked at
      fault = error.what();
    }
  log.warning("{}: {}, the specimen is packed anew", file.string(), fault);
  return std::nullopt;
}

// Under a name of this process until it is whole: where nothing can be locked, others write it too.
fs::path part_of_this_process(const fs::path &file) {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host = {"unknown"};
  return file.parent_path() / fmt::format("{}.{}_{}.part.csv", file.stem().string(), host.data(), getpid());
}

void write(const fs::path &file, const std::string &recipe, const dem::Specimen &specimen) {
  const fs::path part = part_of_this_process(file);
  try {
    OutputFile to(part);
    to.write(file_start(recipe));
    write_specimen_csv(to, specimen);
    to.write(fmt::format("{}{}\n", sum_words, sha256_of_file(part).value_or("")));
    to.close();
    make_current(part, file);
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
}

// What writers of this packing have left that were killed; nobody else writes it while we hold it.
void remove_parts(const fs::path &file) {
  std::error_code ignored;
  const std::string start = file.stem().string() + '.', end = ".part.csv";
  for (const auto &entry : fs::directory_iterator(file.parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(start, 0) == 0 && name.size() > end.size() &&
        name.compare(name.size() - end.size(), end.size(), end) == 0)
      fs::remove(entry.path(), ignored);
  }
}

// The lock of a packing; null where another run has been at it for all our patience.
std::unique_ptr<FileLock> lock_of(const fs::path &file, RunLog &log) {
  create_folder(file.parent_path());
  return FileLock::take(file.parent_path() / lock_name, {lock_byte(file), 1}, patience,
                        [&] { log.detail("waits for the run that packs {}", file.string()); });
}

} // namespace

std::string packing_recipe(const Scene &scene, unsigned long seed) {
  if (scene.specimen.packing == PackingKind::file) return "";
  std::string recipe;
  for (const Entry &entry : scene.parameters->entries())
    if (entry.path.rfind("Specimen/", 0) == 0 && entry.path.rfind("Specimen/Flaw ", 0) != 0 &&
        std::find(no_part_of_it.begin(), no_part_of_it.end(), entry.path) == no_part_of_it.end())
      recipe += fmt::format("{} = {}; ", entry.path, recipe_text(entry));
  return fmt::format("{}Scene/Seed = {}; {}", recipe, seed, version_line());
}

std::string packing_name(const std::string &recipe) {
  return sha256_of(recipe).substr(0, name_digits) + ".csv";
}

dem::Specimen shared_packing(const Scene &scene, const fs::path &folder,
                             const std::function<dem::Specimen()> &pack, bool writes, RunLog &log) {
  const std::string recipe = packing_recipe(scene, scene.general.seed);
  const fs::path file = folder / packing_name(recipe);
  if (!writes) {
    std::optional<dem::Specimen> found = read(file, recipe, log);
    return found ? std::move(*found) : pack();
  }
  std::unique_ptr<FileLock> lock;
  try {
    lock = lock_of(file, log);
    if (std::optional<dem::Specimen> found = read(file, recipe, log)) return std::move(*found);
  } catch (const std::runtime_error &error) { // a folder that cannot be made or written
    log.warning("{}: the packing is not shared", error.what());
    return pack();
  }
  const dem::Specimen specimen = pack();
  try {
    if (lock != nullptr && lock->holds()) remove_parts(file);
    write(file, recipe, specimen);
  } catch (const OutputError &error) {
    log.warning("{}: the packing is not kept for other runs", error.what());
  }
  return specimen;
}

} // namespace platen::apps
