// A problem at its start: platens against the specimen, layers, ramps and what holds the lateral surface.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "coupling/bending.h"
#include "coupling/problem.h"
#include "coupling/text_of.h"
#include "dem/measure/moduli.h"
#include "fem/grids.h"
#include "fem/platen_mesh.h"
#include "fem/rigid_body.h"

namespace platen::coupling {
namespace {

constexpr double pi = 3.14159265358979323846;
// Within the tenth to tenfold that the servo is safe for: the stress follows within some hundred steps of a
// hard specimen.
constexpr double servo_gain = 5;
// A bar is loaded within this many of its own periods where nothing else is said.
constexpr double swings_of_ramp = 2;

// As packed, a platen meets the outermost sphere; ground, it lies in the end plane.
double platen_plane(const dem::Specimen &s, bool top, Ends ends) {
  if (ends == Ends::ground) return top ? s.shape.height : 0.0;
  double z = top ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.size(); ++i)
    z = top ? std::max(z, s.centre[i].z + s.radius[i]) : std::min(z, s.centre[i].z - s.radius[i]);
  return z;
}

void require_bar(const dem::Shape &shape, const ProblemSettings &settings) {
  const PlatenSettings &p = settings.platens;
  if (settings.ends != Ends::ground)
    throw BadSetup("Specimen/Ends", "would let a bar rock on its outermost spheres. Allowed: ground.");
  if (shape.kind != dem::ShapeKind::box)
    throw BadSetup("Loading/Test", "bends bars of rectangular section. Allowed: Specimen/Shape = box, bar.");
  if (!(p.strip_width > 0))
    throw BadSetup("Platens/Strip width", "has to be given: a bar is bent by strips. Allowed: > 0 m.");
  if (!(p.span > p.strip_width))
    throw BadSetup("Platens/Span",
                   "leaves no gap between the lower strips. Allowed: above Platens/Strip "
                   "width, " +
                       text_of(p.strip_width) + " m.");
  if (p.span + p.strip_width > shape.width_x)
    throw BadSetup("Platens/Span", "is too long for a bar of " + text_of(shape.width_x) +
                                       " m: the lower strips have to lie under it. Allowed: up to " +
                                       text_of(shape.width_x - p.strip_width) + " m.");
}

Strips bending_strips(const dem::Specimen &s, const ProblemSettings &settings, bool top) {
  const PlatenSettings &p = settings.platens;
  require_bar(s.shape, settings);
  Strips strips;
  strips.middles = top ? std::vector<double>{0} : std::vector<double>{-0.5 * p.span, 0.5 * p.span};
  strips.width = p.strip_width;
  strips.length = p.overhang * s.shape.width_y;
  strips.z_low =
      top ? platen_plane(s, true, settings.ends) : platen_plane(s, false, settings.ends) - p.thickness;
  strips.thickness = p.thickness;
  strips.elements_across = p.elements_across;
  strips.presses_from_above = top;
  return strips;
}

// Elements of elastic platens are about as thick as wide; a sheet of one would not bulge at degree 1.
std::vector<fem::Layer> layers_of(const PlatenSettings &p, double half_width, bool top) {
  const auto layer = [&](double thickness, int least) {
    const double alike = 0.5 * p.elements_across * thickness / half_width;
    return fem::Layer{thickness, std::max(least, static_cast<int>(std::lround(alike)))};
  };
  if (p.elastic->pad_thickness == 0) return {layer(p.thickness, 2)};
  const fem::Layer pad = layer(p.elastic->pad_thickness, 2 / p.elastic->degree),
                   rest = layer(p.thickness - p.elastic->pad_thickness, 1);
  return top ? std::vector{pad, rest} : std::vector{rest, pad};
}

fem::Grid platen_grid(const dem::Specimen &s, const ProblemSettings &settings, bool top) {
  const PlatenSettings &p = settings.platens;
  const double plane = platen_plane(s, top, settings.ends), low = top ? plane : plane - p.thickness;
  if (const fem::Grid &given = top ? p.top.grid : p.bottom.grid) return fem::laid_platen(given, !top, plane);
  if (p.span > 0) return make_grid(bending_strips(s, settings, top));
  if (s.shape.kind == dem::ShapeKind::cylinder) {
    const fem::CylinderPlate plate{p.overhang * s.shape.radius, p.thickness, low, p.elements_across, 2};
    return p.elastic ? fem::make_grid(plate, layers_of(p, plate.radius, top)) : fem::make_grid(plate);
  }
  const bool strip = s.shape.kind == dem::ShapeKind::disc && p.strip_width > 0;
  const double x = strip ? 0.5 * p.strip_width : 0.5 * p.overhang * s.shape.width_x,
               y = 0.5 * p.overhang * s.shape.width_y;
  const fem::BoxPlate plate{
      {-x, -y, low}, {x, y, low + p.thickness}, {p.elements_across, p.elements_across, 2}};
  return p.elastic ? fem::make_grid(plate, layers_of(p, std::max(x, y), top)) : fem::make_grid(plate);
}

// From the low end; of a given grid in the order of its materials.
std::vector<fem::Material> platen_materials(const PlatenSettings &p, const fem::Grid &given, bool top) {
  std::vector<fem::Material> materials{p.material};
  if (given && fem::materials_of(given) > 1 && !(p.elastic->pad.young_modulus > 0))
    throw std::invalid_argument("has " + std::to_string(fem::materials_of(given)) +
                                " physical volumes: the second needs Platens/Pad modulus, Pad Poisson ratio "
                                "and Pad density");
  if (given && fem::materials_of(given) > 2)
    throw std::invalid_argument("has " + std::to_string(fem::materials_of(given)) +
                                " physical volumes: at most two are known, platen and pad");
  if (given ? fem::materials_of(given) > 1 : p.elastic->pad_thickness > 0)
    materials.insert(!given && top ? materials.begin() : materials.end(), p.elastic->pad);
  return materials;
}

std::unique_ptr<fem::Body> new_platen(const dem::Specimen &s, const ProblemSettings &settings, bool top) {
  const PlatenSettings &p = settings.platens;
  if (!p.elastic) return std::make_unique<fem::RigidBody>(platen_grid(s, settings, top), p.material);
  fem::Grip grip;
  grip.tag = top ? fem::high_end_tag : fem::low_end_tag;
  if (top && p.elastic->seat) {
    grip.turns = true;
    grip.seat = {0, 0, platen_plane(s, true, settings.ends)};
  }
  fem::ElasticOptions options;
  options.degree = p.elastic->degree;
  options.motion = p.elastic->motion;
  if (options.motion == fem::ElasticMotion::explicit_steps) options.fastest_damping = p.elastic->damping;
  return std::make_unique<fem::ElasticSolid>(
      platen_grid(s, settings, top), platen_materials(p, (top ? p.top : p.bottom).grid, top), grip, options);
}

std::unique_ptr<fem::Body> make_platen(const dem::Specimen &s, const ProblemSettings &settings, bool top) {
  const bool given = (top ? settings.platens.top : settings.platens.bottom).grid != nullptr;
  try {
    return new_platen(s, settings, top);
  } catch (const std::invalid_argument &e) {
    const std::string mesh = top ? "Platens/Top/Mesh file" : "Platens/Bottom/Mesh file";
    if (given) throw BadSetup(mesh, std::string(e.what()) + ".");
    throw BadSetup("Platens/Elements across", std::string("is not possible: ") + e.what() + ".");
  }
}

// What the specimen covers of a platen.
bool covers(const dem::Shape &shape, double x, double y) {
  if (shape.kind == dem::ShapeKind::cylinder) return x * x + y * y <= shape.radius * shape.radius;
  return std::abs(x) <= 0.5 * shape.width_x && std::abs(y) <= 0.5 * shape.width_y;
}

// Without bonds the stiffness that a bond would have still measures the grains; N/m.
double mean_bond_stiffness(const dem::Model &model) {
  double sum = 0;
  if (model.bonds && model.bonds->size() > 0) {
    const dem::Bonds &b = *model.bonds;
    for (std::size_t k = 0; k < b.size(); ++k)
      sum += pi * b.bond_radius[k] * b.bond_radius[k] * b.normal_stiffness[k];
    return sum / static_cast<double>(b.size());
  }
  for (const double r : model.particles.radius)
    sum += model.settings().bond_layout.axial_stiffness(r, r);
  return sum / static_cast<double>(std::max<std::size_t>(model.particles.size(), 1));
}

double platen_stiffness(const dem::Model &model, const ProblemSettings &settings) {
  const PlatenSettings &p = settings.platens;
  if (p.stiffness_absolute > 0) return p.stiffness_absolute;
  return p.stiffness_of_bond * mean_bond_stiffness(model);
}

SurfaceContact layer_settings(const dem::Model &model, const dem::Specimen &s,
                              const ProblemSettings &settings, const PlatenSide &side,
                              const fem::Body &body) {
  const PlatenSettings &p = settings.platens;
  SurfaceContact c;
  c.particle_stiffness = platen_stiffness(model, settings);
  c.face_compliance = body.face_compliance();
  c.tangential_ratio = p.tangential_ratio;
  c.friction_static = side.friction_static;
  c.friction_dynamic = side.friction_dynamic;
  c.weakening = side.weakening;
  c.damping = p.damping;
  c.attachment = p.glued ? Attachment::glued : Attachment::free;
  c.seat_modulus = settings.seat ? model.settings().bond_layout.modulus : 0.0;
  c.skin = Problem::surface_skin * dem::mean_radius(s);
  return c;
}

} // namespace

Problem::Problem(const dem::Specimen &specimen, const ProblemSettings &settings)
    : model(specimen, settings.model),
      top_body_(make_platen(specimen, settings, true)),
      bottom_body_(make_platen(specimen, settings, false)),
      top(*top_body_),
      bottom(*bottom_body_),
      top_layer(model.particles, top, layer_settings(model, specimen, settings, settings.platens.top, top)),
      bottom_layer(model.particles, bottom,
                   layer_settings(model, specimen, settings, settings.platens.bottom, bottom)),
      settings_(settings),
      shape_(specimen.shape),
      bottom_plane_(platen_plane(specimen, false, settings.ends)),
      top_plane_(platen_plane(specimen, true, settings.ends)),
      mean_radius_(dem::mean_radius(specimen)) {
  if (deformable()) {
    const auto inside = [&](double x, double y) { return covers(shape_, x, y); };
    top_face_ = MeanPlace(top.surface(), fem::low_end_tag, inside);
    bottom_face_ = MeanPlace(bottom.surface(), fem::high_end_tag, inside);
  }
  double solid = 0;
  for (const double r : specimen.radius)
    solid += 4.0 / 3.0 * pi * r * r * r;
  packing_fraction_ = solid / shape_.volume();
  if (settings.ends == Ends::ground || settings.platens.glued) {
    const double depth = settings.end_layer * dem::mean_radius(specimen);
    const int seats = std::min(top_layer.seat_within(model.particles, top, depth, bent()),
                               bottom_layer.seat_within(model.particles, bottom, depth, bent()));
    if (seats == 0)
      throw BadSetup("Specimen/End layer",
                     "leaves a platen without a sphere. Allowed: a deeper layer, or a specimen that reaches "
                     "its end planes.");
  }
  for (const bool above : {true, false})
    if (bent() && !each_meets_a_sphere(bending_strips(specimen, settings, above), specimen,
                                       settings.end_layer * dem::mean_radius(specimen)))
      throw BadSetup(
          "Platens/Strip width",
          "leaves a strip without a sphere. Allowed: wider strips, or a deeper Specimen/End layer.");
  voigt_modulus_ = model.bonds ? dem::network_moduli(*model.bonds, shape_.volume()).young_voigt : 0.0;
  grain_density_ = dem::grain_density(specimen, settings.model.density, settings.model.density_of);
  const double density = grain_density_ * settings.model.mass_scaling * packing_fraction_;
  wave_crossing_ = voigt_modulus_ > 0 ? shape_.height * std::sqrt(density / voigt_modulus_) : 0.0;
  if (settings.loading.crossings > 0) {
    if (wave_crossing_ == 0)
      throw BadSetup("Loading/Wave crossings", "needs bonds: they carry the wave. Allowed: an Axial rate.");
    settings_.loading.rate = 1e-3 * shape_.height / (settings.loading.crossings * wave_crossing_);
  }
  ramp_ = settings.loading.ramp > 0 ? settings.loading.ramp
          : bent()                  ? swings_of_ramp * swing()
                                    : 10 * wave_crossing_;
  if (settings.loading.hurry > 1) {
    if (!(wave_crossing_ > 0) || !(ramp_ > 0))
      throw BadSetup("Loading/Hurry", "needs bonds: they tell when the specimen fails. Allowed: 1.");
    pace_ = std::make_unique<Pace>(Pace::Parameters{settings.loading.hurry, bent() ? swing() : wave_crossing_,
                                                    ramp_, static_cast<double>(model.bonds->size())});
  }
  if (settings.loading.servo)
    servo_ = std::make_unique<Servo>(Servo::Parameters{
        settings.loading.servo_gain > 0 ? settings.loading.servo_gain : servo_gain, settings_.loading.rate});
  if (settings.loading.cell) start_cell(*settings.loading.cell, mean_bond_stiffness(model));
  if (settings.loading.wall_stiffness > 0)
    wall_ = std::make_unique<dem::LateralWall>(model.particles, shape_,
                                               settings.loading.wall_stiffness * mean_bond_stiffness(model),
                                               settings.loading.wall_layer * dem::mean_radius(specimen));
  half_lightest_ = 0.5 * *std::min_element(model.particles.mass.begin(), model.particles.mass.end());
  // Pairs that are about to touch count in the first step too.
  if (model.contacts) model.contacts->search(model.particles, model.bonds.get(), 0.0);
  choose_step(true);
  if (sleeve_ && settings.loading.cell->sleeve->mass_scaling == 0)
    start_sleeve(*settings.loading.cell, mean_bond_stiffness(model), cheap_mass_of_sleeve());
  if (!quasi_static()) return;
  top_loads_ = MeanLoads(top.surface().vertices.size());
  bottom_loads_ = MeanLoads(bottom.surface().vertices.size());
  // Lists that choose_step has made.
  const auto support = [&](const ContactLayer &layer, fem::Body &body) {
    static_cast<fem::ElasticSolid &>(body).set_support(layer.vertex_springs(model.particles, body).stiffness);
  };
  support(top_layer, top);
  support(bottom_layer, bottom);
}

} // namespace platen::coupling
