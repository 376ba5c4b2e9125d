// What elastic platens are made of, and the seat of the top one.
#include "apps/scene/scene_check.h"

#include <fmt/format.h>

#include "apps/scene/units.h"

namespace platen::apps {

void SceneCheck::layers_of(const std::string &path, const std::vector<NamedLayer> &layers, bool plate) const {
  if (layers.empty() || !plate) return;
  double sum = 0; // m
  for (const NamedLayer &layer : layers) {
    if (!given(layer.thickness))
      refuse(path, "gives " + layer.material + " no thickness. Allowed: \"" + layer.material + " 2 mm\".");
    sum += layer.thickness;
  }
  constexpr double round_off = 1e-9;
  const bool thick = parameters_.at("Platens/Thickness").changed();
  if (thick && sum > (1 + round_off) * scene_.platens.thickness)
    refuse(path, "is " + fmt::format("{:.6g}", sum) + " m together. Allowed: up to " +
                     shortest_text(scene_.platens.thickness) + " m, Platens/Thickness.");
}

void SceneCheck::layers() const {
  const Platens &platens = scene_.platens;
  const bool top_plate = platens.face(coupling::Side::top).mesh_file.empty(),
             bottom_plate = platens.face(coupling::Side::bottom).mesh_file.empty();
  layers_of("Platens/Layers", platens.layers,
            (top_plate && platens.top_layers.empty()) || (bottom_plate && platens.bottom_layers.empty()));
  layers_of("Platens/Top/Layers", platens.top_layers, top_plate);
  layers_of("Platens/Bottom/Layers", platens.bottom_layers, bottom_plate);
  if (platens.elastic->pad_thickness > 0 && !platens.layers.empty())
    refuse("Platens/Layers", "is another way to say Platens/Pad thickness. Allowed: one of them.");
}

void SceneCheck::seat() const {
  const auto refuse_seat = [&](const std::string &why) {
    refuse("Platens/Top/Seat", why + " Allowed: fixed.");
  };
  if (!program_.presses_specimens()) refuse_seat("is for platen-compress.");
  if (scene_.loading.bending()) refuse_seat("does not go with Loading/Test = three point bending.");
  if (scene_.model.scheme != dem::Scheme::velocity_verlet)
    refuse_seat("needs Integration/Scheme = velocity verlet.");
  if (scene_.loading.start_strain > 0)
    refuse_seat("needs Loading/Start strain = 0: the static solve is between ends that do not turn.");
}

} // namespace platen::apps
