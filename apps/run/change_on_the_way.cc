// What a script may change while a test runs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "apps/run/changed_scene.h"
#include "apps/run/compression_run.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

constexpr std::array<const char *, 7> changeable{
    "Contact/Friction", "Loading/Axial rate",  "Loading/Stop at residual",
    "Output/Every",     "Output/Fields every", "Checkpoint/Every",
    "Scene/Title"};

bool is_friction_of_platens(const std::string &entry) {
  const auto ends_with = [&](const std::string &end) {
    return entry.size() >= end.size() && entry.compare(entry.size() - end.size(), end.size(), end) == 0;
  };
  return entry.rfind("Platens/", 0) == 0 && (ends_with("Friction static") || ends_with("Friction dynamic"));
}

bool may_change(const std::string &entry) {
  return std::count(changeable.begin(), changeable.end(), entry) > 0 || is_friction_of_platens(entry);
}

// Of two numbers that may not be given.
bool differ(double a, double b) {
  return a != b && !(std::isnan(a) && std::isnan(b));
}

} // namespace

void CompressionRun::change(const Scene &now) {
  const std::vector<SceneChange> changes = differences(scene_, now, paths_.folder);
  for (const SceneChange &change : changes)
    if (!may_change(change.entry))
      refuse(now, change.entry,
             fmt::format("cannot be changed while a test runs. Allowed: {}, friction of platens.",
                         fmt::join(changeable, ", ")));
  // What is refused changes nothing: what was set before it is set back. The rate, which would not come back
  // to the same bits, goes last.
  std::vector<std::function<void()>> undo;
  const auto attempt = [&](const std::string &entry, const auto &act) {
    try {
      act();
    } catch (const std::invalid_argument &error) {
      for (const auto &back : undo)
        back();
      refuse(now, entry, std::string("cannot be changed now: ") + error.what() + ". Allowed: as it is.");
    }
  };
  for (const coupling::Side side : coupling::all_sides) {
    coupling::Platen *platen = test_->platen(side);
    if (platen == nullptr) continue;
    const coupling::PlatenSide &was = scene_.platens.at(side), &is = now.platens.at(side);
    if (was.friction_static == is.friction_static && was.dynamic() == is.dynamic()) continue;
    attempt(fmt::format("Platens/{}/Friction static", platen->name()), [&] { platen->set_friction(is); });
    undo.push_back([platen, &was] { platen->set_friction(was); });
  }
  const double friction = scene_.contact.friction;
  if (dem::Contacts *contacts = test_->model.contacts.get(); contacts && now.contact.friction != friction) {
    attempt("Contact/Friction", [&] { contacts->set_friction(now.contact.friction); });
    undo.push_back([contacts, friction] { contacts->set_friction(friction); });
  }
  if (differ(now.loading.rate, scene_.loading.rate))
    attempt("Loading/Axial rate", [&] { test_->change_rate(now.loading.rate); });
  for (const SceneChange &change : changes) {
    log_.info("changed at {:.6g} s, strain {:.6g}: {} = {}, was {}", test_->time(),
              test_->closure_strain(results_.axis()), change.entry, change.now, change.was);
    changes_.push_back({{"time_s", test_->time()},
                        {"strain", test_->closure_strain(results_.axis())},
                        {"entry", change.entry},
                        {"was", change.was},
                        {"now", change.now}});
  }
}

} // namespace platen::apps
