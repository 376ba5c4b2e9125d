#include "coupling/platens_of_test.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/pi.h"
#include "base/shortest_text.h"
#include "fem/grids.h"
#include "fem/rigid_body.h"

namespace platen::coupling {

double platen_plane(const dem::Specimen &s, bool above, Ends ends) {
  if (ends == Ends::ground) return above ? s.shape.height : 0.0;
  double z = above ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.size(); ++i)
    z = above ? std::max(z, s.centre[i].z + s.radius[i]) : std::min(z, s.centre[i].z - s.radius[i]);
  return z;
}

namespace {

void require_bar(const dem::Shape &shape, const PlatenTestSettings &settings) {
  const PlatenSettings &p = settings.platens;
  if (settings.ends != Ends::ground)
    throw BadSetup("ends", "would let a bar rock on its outermost spheres. Allowed: ground.");
  if (shape.kind != dem::ShapeKind::box)
    throw BadSetup("platens.span", "bends bars of rectangular section. Allowed: a specimen that is a box.");
  if (!(p.strip_width > 0))
    throw BadSetup("platens.strip_width", "has to be given: a bar is bent by strips. Allowed: > 0 m.");
  if (!(p.span > p.strip_width))
    throw BadSetup("platens.span",
                   "leaves no gap between the lower strips. Allowed: above `platens.strip_width`, " +
                       text_of(p.strip_width) + " m.");
  if (p.span + p.strip_width > shape.width_x)
    throw BadSetup("platens.span", "is too long for a bar of " + text_of(shape.width_x) +
                                       " m: the lower strips have to lie under it. Allowed: up to " +
                                       text_of(shape.width_x - p.strip_width) + " m.");
}

// The strips between which a bar along x is bent: boxes along y, all alike, that make up one rigid body.
std::vector<fem::BoxPlate> bending_strips(const dem::Specimen &s, const PlatenTestSettings &settings,
                                          bool top) {
  const PlatenSettings &p = settings.platens;
  require_bar(s.shape, settings);
  const double plane = platen_plane(s, top, settings.ends), low = top ? plane : plane - p.thickness;
  const double x = 0.5 * p.strip_width, y = 0.5 * p.overhang * s.shape.width_y;
  std::vector<fem::BoxPlate> strips;
  for (const double middle : top ? std::vector{0.0} : std::vector{-0.5 * p.span, 0.5 * p.span})
    strips.push_back({{middle - x, -y, low},
                      {middle + x, y, low + p.thickness},
                      {p.elements_across, p.elements_across, 2}});
  return strips;
}

// A sphere of the specimen lies within `depth` (m) of the strip's face.
bool meets_a_sphere(const fem::BoxPlate &strip, const dem::Specimen &specimen, bool top, double depth) {
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector3 &c = specimen.centre[i];
    const double gap = (top ? strip.low.z - c.z : c.z - strip.high.z) - specimen.radius[i];
    if (gap <= depth && c.x >= strip.low.x && c.x <= strip.high.x) return true;
  }
  return false;
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

fem::Grid platen_grid(const dem::Specimen &s, const PlatenTestSettings &settings, bool top) {
  const PlatenSettings &p = settings.platens;
  const double plane = platen_plane(s, top, settings.ends), low = top ? plane : plane - p.thickness;
  if (const fem::Grid &given = top ? p.top.grid : p.bottom.grid) return fem::laid_platen(given, !top, plane);
  if (p.span > 0) return fem::make_grid(bending_strips(s, settings, top));
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
                                " physical volumes: the second needs `platens.elastic.pad_modulus`");
  if (given && fem::materials_of(given) > 2)
    throw std::invalid_argument("has " + std::to_string(fem::materials_of(given)) +
                                " physical volumes: at most two are known, platen and pad");
  if (given ? fem::materials_of(given) > 1 : p.elastic->pad_thickness > 0)
    materials.insert(!given && top ? materials.begin() : materials.end(), p.elastic->pad);
  return materials;
}

// What the specimen covers of a platen.
bool covers(const dem::Shape &shape, double x, double y) {
  if (shape.kind == dem::ShapeKind::cylinder) return x * x + y * y <= shape.radius * shape.radius;
  return std::abs(x) <= 0.5 * shape.width_x && std::abs(y) <= 0.5 * shape.width_y;
}

double platen_stiffness(const dem::Model &model, const PlatenTestSettings &settings) {
  const PlatenSettings &p = settings.platens;
  if (p.stiffness.kind == dem::Stiffness::Kind::absolute) return p.stiffness.value;
  return p.stiffness.value * mean_bond_stiffness(model);
}

SurfaceContact contact_settings(const dem::Model &model, const dem::Specimen &s,
                                const PlatenTestSettings &settings, bool top, const fem::Body &body) {
  const PlatenSettings &p = settings.platens;
  SurfaceContact c;
  static_cast<dem::SurfaceFriction &>(c) = top ? p.top : p.bottom;
  c.particle_stiffness = platen_stiffness(model, settings);
  c.face_compliance = body.face_compliance();
  c.tangential_ratio = p.tangential_ratio;
  c.damping = p.damping;
  c.attachment = p.glued ? Attachment::glued : Attachment::free;
  c.seat_modulus = settings.seat ? model.settings().bond_layout.modulus : 0.0;
  c.skin = PlatenTest::surface_skin * dem::mean_radius(s);
  return c;
}

std::unique_ptr<fem::ElasticSolid> elastic_solid(const dem::Specimen &s, const PlatenTestSettings &settings,
                                                 bool top) {
  const PlatenSettings &p = settings.platens;
  fem::Clamp clamp;
  clamp.tag = top ? fem::high_end_tag : fem::low_end_tag;
  if (top && p.elastic->seat) {
    clamp.turns = true;
    clamp.seat = {0, 0, platen_plane(s, true, settings.ends)};
  }
  fem::ElasticOptions options;
  options.degree = p.elastic->degree;
  options.motion = p.elastic->motion;
  if (options.motion == fem::ElasticMotion::explicit_steps) options.fastest_damping = p.elastic->damping;
  return std::make_unique<fem::ElasticSolid>(
      platen_grid(s, settings, top), platen_materials(p, (top ? p.top : p.bottom).grid, top), clamp, options);
}

PlatenOfTest new_platen(const dem::Specimen &s, const PlatenTestSettings &settings, bool top,
                        const dem::Model &model) {
  const PlatenSettings &p = settings.platens;
  const std::string name = top ? "top" : "bottom";
  if (!p.elastic) {
    auto body = std::make_unique<fem::RigidBody>(platen_grid(s, settings, top), p.material);
    const SurfaceContact contact = contact_settings(model, s, settings, top, *body);
    return {std::make_unique<RigidPlaten>(name, std::move(body), model.particles, contact)};
  }
  auto solid = elastic_solid(s, settings, top);
  const SurfaceContact contact = contact_settings(model, s, settings, top, *solid);
  const FaceOf face{top ? fem::low_end_tag : fem::high_end_tag,
                    [shape = s.shape](double x, double y) { return covers(shape, x, y); }};
  auto platen = std::make_unique<ElasticPlaten>(name, std::move(solid), model.particles, contact, face,
                                                p.elastic->motion == fem::ElasticMotion::quasi_static,
                                                p.elastic->steps_per_solve);
  const ElasticPlaten *elastic = platen.get();
  return {std::move(platen), elastic};
}

} // namespace

PlatenOfTest make_platen(const dem::Specimen &specimen, const PlatenTestSettings &settings, bool above,
                         const dem::Model &model) {
  const std::string side = above ? "platens.top" : "platens.bottom";
  const bool given = (above ? settings.platens.top : settings.platens.bottom).grid != nullptr;
  try {
    return new_platen(specimen, settings, above, model);
  } catch (const std::invalid_argument &e) {
    if (given) throw BadSetup(side + ".grid", std::string(e.what()) + ".");
    throw BadSetup("platens.elements_across", std::string("is not possible: ") + e.what() + ".");
  }
}

void require_strips_to_meet(const dem::Specimen &specimen, const PlatenTestSettings &settings, double depth) {
  for (const bool above : {true, false})
    for (const fem::BoxPlate &strip : bending_strips(specimen, settings, above))
      if (!meets_a_sphere(strip, specimen, above, depth))
        throw BadSetup("platens.strip_width",
                       "leaves a strip without a sphere. Allowed: wider strips, or a deeper `end_layer`.");
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

} // namespace platen::coupling
