// What entries make together: proportions, waves, steps, stresses. Each of them may be in its own range and
// the whole still be a slip of a unit, or two numbers in each other's place. Orders of magnitude, before
// anything is packed; a run checks once more when its time step is known (apps/run/compression_setup.cc).
#include "apps/scene/scene_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/pi.h"

namespace platen::apps {
namespace {

// Heights over widths: fibres and sheets are within, a height in metres for one in millimetres is not.
constexpr double most_slender = 200;
// m/s; of gels with masses scaled up; twice diamond's, whose 18 km/s are the fastest that there is, for bonds
// are stiffer than what they make. A density in g/cm3 for one in kg/m3 is beyond.
constexpr double slowest_wave = 1e-3, fastest_wave = 4e4;
constexpr double softest_body = 1e-6;      // modulus over that of bonds: rubber beside concrete has 1e-4
constexpr double widest_strip = 0.3;       // of a disc's diameter
constexpr double most_of_wave_speed = 0.1; // of a platen; above it nothing is in equilibrium anywhere
// Steps of a test: enough to see something, and no more than a machine can make.
constexpr double fewest_steps = 100, most_steps = 1e12;
// Time step over the time that a wave takes across a radius: 0.1 to 0.6 of packings with linear contacts.
constexpr double smallest_step = 0.03, largest_step = 1;
// Strength over modulus: strain at which a bond breaks.
constexpr double least_strain_at_break = 1e-9, most_strain_at_break = 1;
// Over the modulus: the specimen would lose a tenth of its size; or nothing that a test could show.
constexpr double most_pressure = 0.1, least_pressure = 1e-9;

std::string number(double value) {
  return fmt::format("{:.3g}", value);
}

} // namespace

// "Specimen/Height = 40 mm"
std::string SceneCheck::set_to(const std::string &path) const {
  const Entry &entry = parameters_.at(path);
  return path + (entry.text.empty() ? "" : " = " + entry.text);
}

void SceneCheck::proportions() const {
  const SpecimenSection &s = scene_.specimen;
  if (!program_.packs || s.packing == PackingKind::file || !given(s.height)) return;
  const double width = s.round() ? 2 * s.radius : std::fmin(s.width_x, s.width_y);
  const std::string of =
      s.round() ? "Specimen/Radius" : "Specimen/Width " + std::string(s.width_x <= s.width_y ? "x" : "y");
  // Specimens are some thirty spheres across; without a sphere, as large as a hand.
  const double usual = given(s.sphere_radius) ? 30 * s.sphere_radius : 0.1; // m
  const auto proportion = [&](const std::string &path, double extent) {
    const double over = extent / width;
    if (!(over > most_slender || over < 1 / most_slender)) return;
    const std::string allowed =
        " Allowed: " + number(1 / most_slender) + " ... " + number(most_slender) + ".";
    if (std::abs(std::log(width / usual)) > std::abs(std::log(extent / usual)))
      return refuse(of,
                    "gives a width that is " + number(1 / over) + " times " + set_to(path) + "." + allowed);
    refuse(path, "is " + number(over) + " times the width that " + set_to(of) + " gives." + allowed);
  };
  proportion("Specimen/Height", s.height);
  if (!s.round() && of != "Specimen/Width x" && given(s.width_x)) proportion("Specimen/Width x", s.width_x);
  if (!s.round() && of != "Specimen/Width y" && given(s.width_y)) proportion("Specimen/Width y", s.width_y);
  if (loads() && scene_.loading.sleeved() && s.round() && scene_.loading.cell->sleeve->thickness > s.radius)
    refuse("Sleeve/Thickness", "is more than " + set_to("Specimen/Radius") + ". Allowed: up to that.");
  if (loads() && scene_.platens.deformable && scene_.platens.thickness > 100 * std::fmax(s.height, width))
    refuse("Platens/Thickness", "is more than a hundred times the specimen's size. Allowed: up to that.");
}

// m/s, along a chain of bonds with what makes masses larger; not a number where the scene does not give it.
double SceneCheck::wave_speed() const {
  if (!scene_.bond.bonded()) return not_given;
  return std::sqrt(scene_.model.bond_layout.modulus / (scene_.model.density * scene_.model.mass_scaling));
}

void SceneCheck::waves() const {
  const double speed = wave_speed();
  const std::string pair = parameters_.at("Material/Density").changed() ? "Material/Density" : "Bond/Modulus",
                    other = pair == "Bond/Modulus" ? "Material/Density" : "Bond/Modulus";
  if (speed < slowest_wave || speed > fastest_wave)
    refuse(pair, "does not go with " + set_to(other) + ": waves would run at " + number(speed) +
                     " m/s. Allowed: " + number(slowest_wave) + " ... " + number(fastest_wave) + " m/s.");
  const double rate = scene_.loading.rate * scene_.loading.rate_multiplier;
  const std::string multiplied =
      scene_.loading.rate_multiplier > 1 ? "with " + set_to("Loading/Hurry") + " " : "";
  if (loads() && rate > most_of_wave_speed * speed)
    refuse("Loading/Axial rate", multiplied + "is " + number(rate / speed) + " times the speed of waves, " +
                                     number(speed) + " m/s by " + set_to("Bond/Modulus") + " and " +
                                     set_to("Material/Density") + ". Allowed: up to " +
                                     number(most_of_wave_speed) + " times.");
  if (loads()) stage_rates();
}

// Of deformable platens and a sleeve: beside bonds they may be soft, but not nothing.
void SceneCheck::bodies() const {
  const double bond = scene_.model.bond_layout.modulus;
  const auto soft = [&](const char *path, double modulus) {
    if (scene_.bond.bonded() && modulus < softest_body * bond)
      refuse(path, "is " + number(modulus / bond) + " of " + set_to("Bond/Modulus") +
                       ": it bears nothing. Allowed: " + number(softest_body) + " of it or more.");
  };
  if (!loads()) return;
  if (scene_.loading.sleeved()) soft("Sleeve/Modulus", scene_.loading.cell->sleeve->young_modulus);
  if (!scene_.platens.deformable) return;
  const fem::Material &body = scene_.platens.material;
  soft("Platens/Young modulus", body.young_modulus);
  const double speed = std::sqrt(body.young_modulus / body.density);
  if (speed > fastest_wave)
    refuse("Platens/Density", "does not go with " + set_to("Platens/Young modulus") +
                                  ": waves would run at " + number(speed) + " m/s. Allowed: up to " +
                                  number(fastest_wave) + " m/s.");
}

// Strips stand for lines: 0.05 to 0.1 of the diameter in standards.
void SceneCheck::strips() const {
  const double diameter = 2 * scene_.specimen.radius, strip = scene_.platens.strip_width;
  if (program_.presses == Presses::discs && given(diameter) && strip > widest_strip * diameter)
    refuse("Platens/Strip width", "is " + number(strip / diameter) + " of the diameter that " +
                                      set_to("Specimen/Radius") +
                                      " gives: such a disc is crushed, not split. Allowed: up to " +
                                      number(widest_strip) + " of it.");
}

void SceneCheck::stage_rates() const {
  for (std::size_t k = 0; k < scene_.loading.stage_sections.size(); ++k)
    for (const coupling::SideGroup group : coupling::all_side_groups) {
      const auto &control = scene_.loading.stage_sections[k].controls.at(static_cast<std::size_t>(group));
      if (control && control->mode == coupling::SideControl::Mode::rate &&
          std::abs(control->value) > most_of_wave_speed * wave_speed())
        refuse(section_of_stage(k + 1) + "/" + key_of(group),
               "is more than " + number(most_of_wave_speed) + " of the speed of waves, " +
                   number(wave_speed()) + " m/s by " + set_to("Bond/Modulus") + " and " +
                   set_to("Material/Density") + ".");
    }
}

void SceneCheck::step_count() const {
  const Loading &l = scene_.loading;
  const SpecimenSection &s = scene_.specimen;
  if (!loads() || program_.presses == Presses::trials || l.servo || l.staged() || l.hydrostatic() ||
      l.bending())
    return;
  const double length = program_.presses == Presses::discs ? 2 * s.radius : s.height,
               crossing = s.sphere_radius / wave_speed(); // s, of a radius
  const bool by_transits = situation().rate_by_transits();
  const double seconds = by_transits ? 1e3 * l.target_strain * l.wave_transits * length / wave_speed()
                                     : l.target_strain * length / l.rate;
  const std::string rate = by_transits ? "Loading/Wave crossings" : "Loading/Axial rate";
  const auto refuse_count = [&](double steps, const char *bound) {
    refuse(rate, "comes to " + set_to("Loading/Target strain") + " in " + number(seconds) + " s, which are " +
                     bound + number(steps) + " time steps of spheres of " + set_to("Specimen/Sphere radius") +
                     ". Allowed: " + number(fewest_steps) + " ... " + number(most_steps) + ".");
  };
  const double most = seconds / (smallest_step * crossing), least = seconds / (largest_step * crossing);
  if (most < fewest_steps) refuse_count(most, "at most ");
  if (least > most_steps) refuse_count(least, "at least ");
}

void SceneCheck::stresses() const {
  const double modulus = scene_.model.bond_layout.modulus;
  if (!scene_.bond.bonded() || !given(modulus)) return;
  for (const auto &[path, member] :
       {std::pair<const char *, const char *>{"Bond/Tensile strength", "tensile_strength"},
        {"Bond/Shear strength", "shear_strength"}}) {
    const double strain = scene_.bond.number(member) / modulus;
    if (strain > most_strain_at_break || (strain > 0 && strain < least_strain_at_break))
      refuse(path, "over " + set_to("Bond/Modulus") + " is a strain at break of " + number(strain) +
                       ". Allowed: " + number(least_strain_at_break) + " ... " +
                       number(most_strain_at_break) + ".");
  }
  const auto pressed = [&](const std::string &path, double pressure) {
    if (pressure > most_pressure * modulus || (pressure > 0 && pressure < least_pressure * modulus))
      refuse(path, "is " + number(pressure / modulus) + " of " + set_to("Bond/Modulus") +
                       ". Allowed: 0, or " + number(least_pressure) + " ... " + number(most_pressure) +
                       " of it.");
  };
  if (loads() && scene_.loading.confined())
    pressed("Loading/Confining pressure", scene_.loading.cell->pressure);
  if (loads() && scene_.loading.servo) pressed("Platens/Top/Stress", scene_.loading.top_stress);
  if (!loads()) return;
  for (std::size_t k = 0; k < scene_.loading.stage_sections.size(); ++k)
    for (const coupling::SideGroup group : coupling::all_side_groups) {
      const auto &control = scene_.loading.stage_sections[k].controls.at(static_cast<std::size_t>(group));
      using Mode = coupling::SideControl::Mode;
      if (control && (control->mode == Mode::stress || control->mode == Mode::pressure))
        pressed(section_of_stage(k + 1) + "/" + key_of(group), control->value);
    }
}

// Absolute ones beside the bond of two mean spheres.
void SceneCheck::stiffnesses() const {
  const double radius = scene_.specimen.sphere_radius;
  if (!scene_.bond.bonded() || !given(radius) || !program_.bonds) return;
  const dem::BondLayout &layout = scene_.model.bond_layout;
  const bool own = layout.radius_rule == dem::RadiusRule::given && given(layout.radius);
  const double thick =
      layout.radius_multiplier * (own ? layout.radius / radius : 1); // over the spheres' radius
  const double bond = 0.5 * pi * layout.modulus * radius * thick * thick;
  constexpr double widest = 1e6; // a time step follows both
  const auto compare = [&](const char *path, const Stiffness &stiffness) {
    const double over = stiffness.value / bond;
    if (stiffness.kind == Stiffness::Kind::absolute && (over > widest || over < 1 / widest))
      refuse(path, "is " + number(over) + " times that of a bond, which " + set_to("Bond/Modulus") + " and " +
                       set_to("Specimen/Sphere radius") + " give. Allowed: " + number(1 / widest) + " ... " +
                       number(widest) + " times.");
  };
  if (scene_.effects.contact == dem::NormalContact::linear)
    compare("Contact/Stiffness", scene_.contact.stiffness);
  if (loads() && !scene_.hertz_on_platens()) compare("Platens/Stiffness", scene_.platens.stiffness);
}

void SceneCheck::scale() const {
  proportions();
  if (!program_.bonds) return;
  waves();
  bodies();
  strips();
  step_count();
  stresses();
  stiffnesses();
}

} // namespace platen::apps
