#include "coupling/platens_of_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/pi.h"
#include "base/portable.h"
#include "base/shortest_text.h"
#include "coupling/platen_layers.h"
#include "fem/grids.h"
#include "fem/load_solids.h"
#include "fem/rigid_body.h"

namespace platen::coupling {
double recess_of(const PlatenTestSettings &settings, Side side) {
  const std::optional<SleeveSettings> &tube = settings.loading.tube;
  return tube && (side == Side::bottom || (side == Side::top && tube->clearance == 0)) ? tube->recess : 0;
}

double platen_plane(const dem::Specimen &s, const PlatenTestSettings &settings, Side side) {
  const int axis = axis_of(side);
  const double outward = (is_high(side) ? 1 : -1) * recess_of(settings, side);
  if (are_ground(settings.ends)) return extent(s.shape, axis)[is_high(side)] + outward;
  double plane = (is_high(side) ? -1 : 1) * std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.size(); ++i)
    plane = is_high(side) ? std::max(plane, s.centre[i][axis] + s.radius[i])
                          : std::min(plane, s.centre[i][axis] - s.radius[i]);
  return plane + outward;
}

namespace {

// m, that the middle of a tilted platen's face lies above the edge that comes first.
double lift(const dem::Shape &shape, double tilt) {
  const bool disc = shape.kind == dem::ShapeKind::disc;
  return std::abs(portable::sin(tilt)) * (disc ? 0.5 * shape.width_y : half_width(shape));
}

} // namespace

double depth_of_end(const dem::Shape &shape, const PlatenTestSettings &settings, Side side,
                    const Vector3 &centre) {
  if (axis_of(side) != 2) return 0;
  const FacedEnds faces = settings.end_faces;
  const bool faced = faces == FacedEnds::both || (faces == FacedEnds::top) == (side == Side::top);
  const double tilt = side == Side::top ? settings.platens.tilt : 0;
  return (faced ? dem::depth_of_face(settings.ends, settings.end_height, shape, centre, settings.end_seed)
                : 0) +
         lift(shape, tilt) + portable::sin(tilt) * centre[tilted_along(shape)];
}

namespace {

// The middle of the top platen's face, about which it turns on a seat.
Vector3 seat_of(const dem::Specimen &s, const PlatenTestSettings &settings) {
  return {settings.platens.eccentricity, 0,
          platen_plane(s, settings, Side::top) + lift(s.shape, settings.platens.tilt)};
}

// A plane platen turned as it meets the specimen, whose edge it touches.
fem::Grid tilted(const fem::Grid &grid, const dem::Shape &shape, double tilt, double plane) {
  const double c = portable::cos(tilt), s = portable::sin(tilt), up = lift(shape, tilt);
  return fem::moved_grid(grid, [=, along = tilted_along(shape)](const Vector3 &x) {
    const double z = x.z - plane;
    Vector3 moved = x;
    moved[along] = c * x[along] - s * z;
    moved.z = plane + up + s * x[along] + c * z;
    return moved;
  });
}

// Elastic strips get elements about as wide as long: slender ones need a small time step and sink in.
std::array<int, 3> elements_of_plate(const PlatenSettings &p, double half_x, double half_y) {
  constexpr int least = 2;
  if (!p.elastic || !(p.strip_width > 0)) return {p.elements_across, p.elements_across, 2};
  const double size = 2 * std::max(half_x, half_y) / p.elements_across;
  const auto along = [&](double half) {
    return std::max(least, static_cast<int>(std::lround(2 * half / size)));
  };
  return {along(half_x), along(half_y), 2};
}

// The strips for a bar along x in bending: boxes along y, all alike, that form one body.
std::vector<fem::BoxPlate> bending_strips(const dem::Specimen &s, const PlatenTestSettings &settings,
                                          bool top) {
  const PlatenSettings &p = settings.platens;
  const double plane = platen_plane(s, settings, top ? Side::top : Side::bottom),
               thickness = thickness_of(p, top ? Side::top : Side::bottom),
               low = top ? plane : plane - thickness;
  const double x = 0.5 * p.strip_width, y = 0.5 * p.overhang * s.shape.width_y;
  std::vector<fem::BoxPlate> strips;
  for (const double middle : top ? std::vector{0.0} : std::vector{-0.5 * p.span, 0.5 * p.span})
    strips.push_back({{middle - x, -y, low}, {middle + x, y, low + thickness}, elements_of_plate(p, x, y)});
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

// Both ends of a platen along an axis in its plane: beyond the specimen, or short of a neighbour.
std::array<double, 2> reach(const dem::Shape &shape, const PlatenSettings &p, Side low_side) {
  std::array<double, 2> ends = extent(shape, axis_of(low_side));
  const double all = ends[1] - ends[0], middle = 0.5 * (ends[0] + ends[1]);
  for (const bool high : {false, true}) {
    const bool neighbour = p.side(high ? opposite(low_side) : low_side) != nullptr;
    const double half =
        neighbour ? 0.5 * all - edge_gap(shape, p, axis_of(low_side)) : 0.5 * p.overhang * all;
    ends[high] = middle + (high ? half : -half);
  }
  return ends;
}

// The plate for a side of a box, upright: its normal is the axis z of the grid.
fem::BoxPlate plate_of_box(const dem::Shape &shape, const PlatenSettings &p, Side side, double low) {
  constexpr std::array<Side, 3> low_sides{Side::left, Side::front, Side::bottom}; // along x, y, z
  const int axis = axis_of(side);
  const auto x = reach(shape, p, low_sides[static_cast<std::size_t>((axis + 1) % 3)]),
             y = reach(shape, p, low_sides[static_cast<std::size_t>((axis + 2) % 3)]);
  return {{x[0], y[0], low},
          {x[1], y[1], low + thickness_of(p, side)},
          {p.elements_across, p.elements_across, 2}};
}

// Reduces a plate to the strip for a disc.
void narrow_to_strip(fem::BoxPlate &plate, const PlatenSettings &p) {
  plate.low.x = -0.5 * p.strip_width, plate.high.x = 0.5 * p.strip_width;
  plate.elements = elements_of_plate(p, plate.high.x, plate.high.y);
}

fem::Grid platen_grid(const dem::Specimen &s, const PlatenTestSettings &settings, Side side) {
  const PlatenSettings &p = settings.platens;
  const bool high = is_high(side);
  const double plane = platen_plane(s, settings, side), thickness = thickness_of(p, side),
               low = high ? plane : plane - thickness;
  const auto made = [&](const auto &plate, double half_width) {
    return p.elastic ? fem::make_grid(plate, elements_of_layers(p, side, half_width)) : fem::make_grid(plate);
  };
  fem::Grid grid = p.side(side)->grid;
  double middle = 0; // of the side, along z
  if (grid)
    grid = fem::laid_platen(grid, !high, plane), middle = 0.5 * s.shape.height;
  else if (p.span > 0) {
    const std::vector<fem::BoxPlate> strips = bending_strips(s, settings, high);
    return made(strips, 0.5 * std::max(p.strip_width, strips[0].high.y - strips[0].low.y));
  } else if (s.shape.kind == dem::ShapeKind::cylinder)
    grid = made(fem::CylinderPlate{p.overhang * s.shape.radius, thickness, low, p.elements_across, 2},
                p.overhang * s.shape.radius);
  else {
    fem::BoxPlate plate = plate_of_box(s.shape, p, side, low);
    if (s.shape.kind == dem::ShapeKind::disc && p.strip_width > 0) narrow_to_strip(plate, p);
    grid = made(plate, 0.5 * std::max(plate.high.x - plate.low.x, plate.high.y - plate.low.y));
  }
  if (side == Side::top && p.tilt != 0) return tilted(grid, s.shape, p.tilt, plane);
  if (axis_of(side) == 2) return grid;
  return fem::moved_grid(grid, [&](const Vector3 &x) {
    return from_upright(side, x) + Vector3{0, 0, middle};
  });
}

} // namespace

double cells_of_platen(const dem::Shape &shape, const PlatenTestSettings &settings, Side side) {
  const PlatenSettings &p = settings.platens;
  if (p.side(side)->grid) return 0;
  // As in platen_grid, with layers through the thickness for elements of a rigid plate.
  const auto counted = [&](double in_plane, double half_width) {
    if (!p.elastic) return 2 * in_plane;
    double through = 0;
    for (const fem::Layer &layer : elements_of_layers(p, side, half_width))
      through += layer.elements;
    return through * in_plane;
  };
  const auto in_plane = [](const fem::BoxPlate &plate) {
    return static_cast<double>(plate.elements[0]) * plate.elements[1];
  };
  if (p.span > 0) {
    fem::BoxPlate strip;
    const double x = 0.5 * p.strip_width, y = 0.5 * p.overhang * shape.width_y;
    strip.elements = elements_of_plate(p, x, y);
    return (side == Side::top ? 1 : 2) * counted(in_plane(strip), std::max(x, y));
  }
  if (shape.kind == dem::ShapeKind::cylinder)
    return counted(fem::cells_in({1, 1, 0, p.elements_across, 1}), p.overhang * shape.radius);
  fem::BoxPlate plate = plate_of_box(shape, p, side, 0);
  if (shape.kind == dem::ShapeKind::disc && p.strip_width > 0) narrow_to_strip(plate, p);
  return counted(in_plane(plate), 0.5 * std::max(plate.high.x - plate.low.x, plate.high.y - plate.low.y));
}

namespace {

// The part of a platen that the specimen covers; for a disc the band within the depth of seats from its rim.
std::function<bool(const Vector3 &)> covered(const dem::Specimen &s, const PlatenTestSettings &settings,
                                             Side side) {
  const dem::Shape &shape = s.shape;
  if (shape.kind == dem::ShapeKind::cylinder)
    return [r = shape.radius](const Vector3 &x) { return x.x * x.x + x.y * x.y <= r * r; };
  std::array<std::array<double, 2>, 3> ends{extent(shape, 0), extent(shape, 1), extent(shape, 2)};
  if (shape.kind == dem::ShapeKind::disc) {
    const double depth = settings.end_layer * dem::mean_radius(s);
    const double half = std::min(shape.radius, std::sqrt(2 * shape.radius * depth));
    ends[0] = {-half, half};
  }
  return [ends, axis = axis_of(side)](const Vector3 &x) {
    for (const int k : {0, 1, 2}) {
      const std::array<double, 2> &end = ends[static_cast<std::size_t>(k)];
      if (k != axis && (x[k] < end[0] || x[k] > end[1])) return false;
    }
    return true;
  };
}

double platen_stiffness(const dem::Model &model, const PlatenTestSettings &settings) {
  const PlatenSettings &p = settings.platens;
  if (p.stiffness.kind == dem::Stiffness::Kind::absolute) return p.stiffness.value;
  return p.stiffness.value * mean_bond_stiffness(model);
}

// Of the specimen's side of an elastic platen; for a given mesh the softest material.
fem::Material material_of_face(const PlatenSettings &p, Side side) {
  if (!p.side(side)->grid) return layers_of(p, side).front().material;
  const std::vector<fem::Material> all = materials_of(p, side);
  return *std::min_element(all.begin(), all.end(), [](const fem::Material &a, const fem::Material &b) {
    return a.young_modulus < b.young_modulus;
  });
}

// Contacts of spheres on a far softer material would grow as wide as the spheres.
constexpr double softest_face = 0.1; // of the grains' modulus

dem::HertzOnPlane hertz_contact(const PlatenTestSettings &settings, Side side) {
  const PlatenSettings &p = settings.platens;
  if (!settings.model.contact)
    throw BadSetup("platens.contact",
                   "takes the moduli of grains that touch, but they have no contact. "
                   "Allowed: as grains, linear.");
  const dem::ContactSettings &grains = *settings.model.contact;
  dem::HertzOnPlane::Side platen;
  platen.poisson_ratio = p.material.poisson_ratio;
  if (p.contact_modulus > 0) {
    platen.young_modulus = p.contact_modulus;
  } else if (p.elastic) {
    const fem::Material face = material_of_face(p, side);
    platen.young_modulus = face.young_modulus, platen.poisson_ratio = face.poisson_ratio;
  }
  if (platen.young_modulus < softest_face * grains.young_modulus)
    throw BadSetup("platens.contact",
                   "is Hertz', whose contacts have to be small beside a sphere, and the "
                   "platen there has " +
                       text_of(platen.young_modulus) + " Pa. Allowed: linear, or " +
                       text_of(softest_face * grains.young_modulus) +
                       " Pa and more, a tenth of the grains'.");
  return dem::HertzOnPlane::between({grains.young_modulus, grains.poisson_ratio}, platen);
}

SurfaceContact contact_settings(const dem::Model &model, const dem::Specimen &s,
                                const PlatenTestSettings &settings, Side side, const fem::Body &body) {
  const PlatenSettings &p = settings.platens;
  SurfaceContact c;
  static_cast<dem::SurfaceFriction &>(c) = *p.side(side);
  if (presses_by_hertz(settings))
    c.hertz = hertz_contact(settings, side);
  else
    c.particle_stiffness = platen_stiffness(model, settings);
  c.face_compliance = body.face_compliance();
  c.tangential_ratio = p.tangential_ratio;
  c.damping = p.damping;
  c.attachment = p.glued && axis_of(side) == 2 ? Attachment::glued : Attachment::free;
  c.seat_modulus = settings.seat ? model.settings().bond_layout.modulus : 0.0;
  c.skin = PlatenTest::surface_skin * dem::mean_radius(s);
  c.instruction_set = model.settings().instruction_set;
  return c;
}

std::unique_ptr<fem::ElasticSolid> elastic_solid(const dem::Specimen &s, const PlatenTestSettings &settings,
                                                 Side side) {
  const PlatenSettings &p = settings.platens;
  fem::Clamp clamp;
  clamp.tag = is_high(side) ? fem::high_end_tag : fem::low_end_tag;
  if (side == Side::top && p.spherical_seat) {
    clamp.turns = true;
    clamp.seat = seat_of(s, settings);
  }
  if (side == Side::top && p.machine.yields()) clamp.slides = inward(side);
  fem::ElasticOptions options;
  options.degree = p.elastic->degree;
  options.motion = p.elastic->motion;
  if (options.motion == fem::ElasticMotion::explicit_steps) options.fastest_damping = p.elastic->damping;
  fem::load_solids();
  return std::make_unique<fem::ElasticSolid>(platen_grid(s, settings, side), materials_of(p, side), clamp,
                                             options);
}

// The spring behind a platen of this mass (kg); none without a machine.
std::optional<MachineSpring> spring_behind(const PlatenSettings &p, Side side, double own_mass) {
  MachineSettings machine = p.machine;
  if (side != Side::top || !machine.yields()) return std::nullopt;
  if (std::isnan(machine.mass)) machine.mass = own_mass;
  if (machine.mass < own_mass)
    throw BadSetup("platens.machine.mass",
                   "leaves out the platen. Allowed: at least its own " + text_of(own_mass) + " kg.");
  return MachineSpring(machine);
}

PlatenOfTest new_platen(const dem::Specimen &s, const PlatenTestSettings &settings, Side side,
                        const dem::Model &model) {
  const PlatenSettings &p = settings.platens;
  const auto on_machine = [&](std::unique_ptr<Platen> platen, const ElasticPlaten *elastic = nullptr) {
    if (const auto spring = spring_behind(p, side, platen->body().mass())) platen->stand_on(*spring);
    return PlatenOfTest{std::move(platen), elastic};
  };
  if (!p.elastic && p.spherical_seat && side == Side::top) {
    auto body = std::make_unique<fem::RigidBody>(platen_grid(s, settings, side), p.material,
                                                 seat_of(s, settings), p.seat_friction_arm);
    const SurfaceContact contact = contact_settings(model, s, settings, side, *body);
    return on_machine(std::make_unique<SeatedPlaten>(name_of(side), inward(side), std::move(body),
                                                     model.particles, contact));
  }
  if (!p.elastic) {
    auto body = std::make_unique<fem::RigidBody>(platen_grid(s, settings, side), p.material);
    const SurfaceContact contact = contact_settings(model, s, settings, side, *body);
    return on_machine(std::make_unique<RigidPlaten>(name_of(side), inward(side), std::move(body),
                                                    model.particles, contact));
  }
  auto solid = elastic_solid(s, settings, side);
  const SurfaceContact contact = contact_settings(model, s, settings, side, *solid);
  const FaceOf face{is_high(side) ? fem::low_end_tag : fem::high_end_tag, covered(s, settings, side)};
  auto platen = std::make_unique<ElasticPlaten>(
      name_of(side), inward(side), std::move(solid), model.particles, contact, face,
      p.elastic->motion == fem::ElasticMotion::quasi_static, p.elastic->steps_per_solve);
  const ElasticPlaten *elastic = platen.get();
  return on_machine(std::move(platen), elastic);
}

} // namespace

PlatenOfTest make_platen(const dem::Specimen &specimen, const PlatenTestSettings &settings, Side side,
                         const dem::Model &model) {
  const bool given = settings.platens.side(side)->grid != nullptr;
  try {
    PlatenOfTest made = new_platen(specimen, settings, side, model);
    if (given) require_short_of_neighbours(specimen, settings, side, made.platen->body().surface());
    return made;
  } catch (const std::invalid_argument &e) {
    if (given) throw BadSetup(std::string("platens.") + name_of(side) + ".grid", std::string(e.what()) + ".");
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

// Without bonds the stiffness that a bond would have still represents the grains; N/m.
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
