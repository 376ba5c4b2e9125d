#include "apps/scene/faults.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace platen::apps {
namespace {

constexpr std::size_t most_reported = 20;

// What stands on no line of its file comes after all that does.
std::tuple<std::size_t, int> place_of(const Origin &origin, const std::vector<std::string> &files) {
  if (origin.option > 0) return {files.size(), origin.option};
  const auto file = std::find(files.begin(), files.end(), origin.file);
  return {static_cast<std::size_t>(file - files.begin()),
          origin.line > 0 ? origin.line : std::numeric_limits<int>::max()};
}

} // namespace

bool Faults::concern(const std::string &entry) const {
  return std::any_of(all_.begin(), all_.end(), [&](const EntryError &one) {
    return !one.entry.empty() && (one.entry == entry || entry.rfind(one.entry + "/", 0) == 0);
  });
}

bool Faults::any_in(const std::string &section) const {
  return std::any_of(all_.begin(), all_.end(),
                     [&](const EntryError &one) { return one.entry.rfind(section + "/", 0) == 0; });
}

void Faults::keep_common(const Faults &others) {
  const auto lacks = [&](const EntryError &one) {
    return std::none_of(others.all_.begin(), others.all_.end(), [&](const EntryError &other) {
      return one.entry == other.entry && std::string(one.what()) == other.what();
    });
  };
  all_.erase(std::remove_if(all_.begin(), all_.end(), lacks), all_.end());
}

std::vector<EntryError> Faults::sorted(const std::vector<std::string> &files) const {
  std::vector<EntryError> sorted = all_;
  std::stable_sort(sorted.begin(), sorted.end(), [&](const EntryError &a, const EntryError &b) {
    return place_of(a.origin, files) < place_of(b.origin, files);
  });
  return sorted;
}

std::string Faults::text(const std::vector<std::string> &files) const {
  const std::vector<EntryError> told = sorted(files);
  std::string text;
  for (std::size_t k = 0; k < std::min(told.size(), most_reported); ++k)
    text += (k == 0 ? "" : "\n") + std::string(told[k].what());
  if (told.size() > most_reported)
    text += "\n... and " + std::to_string(told.size() - most_reported) + " more";
  return text;
}

} // namespace platen::apps
