#include "fem/elastic_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace platen::fem {
namespace {

void require(bool holds, const std::string &what) {
  if (!holds) throw std::invalid_argument("elastic solid: " + what);
}

void check(const Grip &grip, const ElasticOptions &options) {
  const bool is_static = options.motion == ElasticMotion::quasi_static;
  require(!(grip.turns && grip.slides), "a grip that turns on a seat must be glued, not sliding");
  require(!(grip.turns && grip.tag == no_grip), "there is no grip to turn");
  require(!(is_static && grip.tag == no_grip), "a quasi-static body needs a grip");
  require(grip.inertia >= 0, "the seat's inertia must not be negative");
  require(grip.damping >= 0, "the seat's damping must not be negative");
  require(grip.turns || (grip.inertia == 0 && grip.damping == 0),
          "inertia and damping of a seat need a grip that turns");
  require(options.mass_damping >= 0 && options.stiffness_damping >= 0 && options.fastest_damping >= 0,
          "damping must not be negative");
  require(!is_static ||
              (options.mass_damping == 0 && options.stiffness_damping == 0 && options.fastest_damping == 0),
          "a quasi-static body has no inertia to damp");
}

// A component that the grip's normal has beside its axis, and still counts as along it.
constexpr double skew = 1e-9;

std::size_t grip_axis(const SurfaceMesh &surface, int tag) {
  Point normal{};
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    if (surface.face_tags[f] == tag) normal = normal + face_area_vector(surface, f);
  normal = (1 / norm(normal)) * normal;
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(normal[k]) > 1 - skew) return k;
  require(false, "a sliding grip must face along x, y or z");
  return 0;
}

std::array<double, 9> inverse(const std::array<double, 9> &a) {
  const Point x = {a[0], a[1], a[2]}, y = {a[3], a[4], a[5]}, z = {a[6], a[7], a[8]};
  const Point yz = cross(y, z), zx = cross(z, x), xy = cross(x, y);
  const double s = 1 / dot(x, yz);
  return {s * yz[0], s * zx[0], s * xy[0], s * yz[1], s * zx[1], s * xy[1], s * yz[2], s * zx[2], s * xy[2]};
}

} // namespace

ElasticSolid::ElasticSolid(Grid grid, std::vector<Material> materials, const Grip &grip,
                           const ElasticOptions &options)
    : model_(make_elastic_model(std::move(grid), options.degree, std::move(materials))),
      grip_(grip),
      options_(options) {
  check(grip, options);
  NodeSurface extracted = node_surface(model_);
  set_surface(std::move(extracted.surface));
  node_of_ = std::move(extracted.node);

  const std::size_t n = model_.nodes.size();
  for (std::size_t i = 0; i < n; ++i) {
    mass_ += model_.mass[i];
    pivot_ = pivot_ + model_.mass[i] * model_.nodes[i];
  }
  pivot_ = grip.turns ? grip.seat : (1 / mass_) * pivot_;
  held_.assign(n, {0, 0, 0});
  if (grip.tag != no_grip) hold(grip);
  moved_.assign(n, Point{}), rate_.assign(n, Point{});
  if (is_static())
    start_.assign(n, Point{}), target_.assign(n, Point{});
  else
    strained_.assign(n, Point{}), force_.assign(n, Point{});
  if (grip.turns) weigh_rotor();
  stable_step_ = std::numeric_limits<double>::infinity();
  if (is_static()) return;
  // A grip that turns as one is no faster than its nodes are by themselves.
  const Held none(n, {0, 0, 0});
  const double square =
      largest_eigenvalue(model_.stiffness, model_.mass, grip.turns ? none : held_, model_.cell_bound);
  stable_step_ = 2 / std::sqrt(square);
  options_.stiffness_damping += 2 * options.fastest_damping / std::sqrt(square);
  if (options_.stiffness_damping > 0)
    stable_step_ = std::min(stable_step_, 2 / (options_.stiffness_damping * square));
}

void ElasticSolid::hold(const Grip &grip) {
  grip_nodes_ = nodes_on(model_, grip.tag);
  require(!grip_nodes_.empty(), "no face has the grip's tag " + std::to_string(grip.tag));
  if (!grip.slides) {
    for (const int i : grip_nodes_)
      held_[static_cast<std::size_t>(i)] = {1, 1, 1};
    return;
  }
  const std::size_t axis = grip_axis(surface_, grip.tag);
  Point middle{};
  for (const int i : grip_nodes_) {
    held_[static_cast<std::size_t>(i)][axis] = 1;
    middle =
        middle + (1 / static_cast<double>(grip_nodes_.size())) * model_.nodes[static_cast<std::size_t>(i)];
  }
  if (is_static()) pin_sliding_grip(middle, axis);
}

// The node nearest to the middle is held sideways, and the one farthest from it along one axis against spin.
void ElasticSolid::pin_sliding_grip(const Point &middle, std::size_t axis) {
  const std::size_t along = (axis + 1) % 3, across = (axis + 2) % 3;
  const auto place = [&](int node) { return model_.nodes[static_cast<std::size_t>(node)]; };
  const int centre = *std::min_element(grip_nodes_.begin(), grip_nodes_.end(), [&](int a, int b) {
    return norm(place(a) - middle) < norm(place(b) - middle);
  });
  const int far = *std::max_element(grip_nodes_.begin(), grip_nodes_.end(), [&](int a, int b) {
    return std::abs(place(a)[along] - place(centre)[along]) <
           std::abs(place(b)[along] - place(centre)[along]);
  });
  held_[static_cast<std::size_t>(centre)] = {1, 1, 1};
  held_[static_cast<std::size_t>(far)][across] = 1;
}

void ElasticSolid::weigh_rotor() {
  for (const std::size_t k : {0, 4, 8})
    rotor_[k] = grip_.inertia;
  const auto add = [&](std::size_t i) {
    const Point r = model_.nodes[i] - pivot_;
    rotor_arm_ = rotor_arm_ + model_.mass[i] * r;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        rotor_[3 * a + b] += model_.mass[i] * ((a == b ? dot(r, r) : 0.0) - r[a] * r[b]);
  };
  if (is_static()) {
    for (std::size_t i = 0; i < model_.nodes.size(); ++i)
      add(i);
  } else {
    for (const int i : grip_nodes_)
      add(static_cast<std::size_t>(i));
  }
  rotor_inverse_ = inverse(rotor_);
}

double ElasticSolid::largest_move(double dt) const {
  double velocity = 0, acceleration = 0;
  for (const Point &v : surface_.velocities)
    velocity = std::max(velocity, norm(v));
  if (!is_static())
    for (const int i : node_of_) {
      const auto node = static_cast<std::size_t>(i);
      acceleration = std::max(acceleration, norm(force_[node]) / model_.mass[node]);
    }
  return std::abs(dt) * (velocity + std::abs(dt) * acceleration);
}

void ElasticSolid::describe(Archive &archive) {
  archive.version(1);
  archive("last_step", last_step_, "s");
  archive("last_move", last_move_, "m");
  archive("load_work", load_work_, "J");
  archive("grip_work", grip_work_, "J");
  archive("dissipated", dissipated_, "J");
  archive("displacement", displacement_, "m");
  archive("velocity", velocity_, "m/s");
  archive("angular_velocity", angular_velocity_, "rad/s");
  archive("angular_momentum", spin_, "kg m2/s");
  archive("rotation", rotation_);
  if (is_static()) {
    archive("elapsed", elapsed_, "s");
    archive("duration", duration_, "s");
    archive("on_the_way", on_the_way_);
    archive.same_rows("start", start_, "m");
    archive.same_rows("target", target_, "m");
  } else {
    archive.same_rows("node_displacement", moved_, "m");
    archive.same_rows("node_velocity", rate_, "m/s");
  }
  describe_loads(archive);
  if (archive.reads()) follow_state();
}

// What is derived from it.
void ElasticSolid::follow_state() {
  turned_ = !is_identity(rotation_);
  if (is_static())
    measure_path();
  else
    find_internal_forces();
  place_surface();
}

} // namespace platen::fem
