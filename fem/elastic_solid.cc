#include "fem/elastic_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/require.h"
#include "fem/rotor.h"

namespace platen::fem {
namespace {

void check(const Clamp &clamp, const ElasticOptions &options) {
  const bool is_static = options.motion == ElasticMotion::quasi_static;
  require(!(clamp.turns && clamp.tag == no_clamp), "elastic solid: there is no clamp to turn");
  require(clamp.slides == Vector3{} || clamp.tag != no_clamp, "elastic solid: there is no clamp to slide");
  require(!(is_static && clamp.tag == no_clamp), "elastic solid: a quasi-static body needs a clamp");
  require(options.mass_damping >= 0 && options.stiffness_damping >= 0 && options.fastest_damping >= 0,
          "elastic solid: damping must not be negative");
  require(!is_static ||
              (options.mass_damping == 0 && options.stiffness_damping == 0 && options.fastest_damping == 0),
          "elastic solid: a quasi-static body has no inertia to damp");
}

} // namespace

ElasticSolid::ElasticSolid(const Grid &grid, std::vector<Material> materials, const Clamp &clamp,
                           const ElasticOptions &options)
    : model_(make_elastic_model(grid, options.degree, std::move(materials))),
      clamp_(clamp),
      options_(options) {
  check(clamp, options);
  NodeSurface extracted = node_surface(model_);
  set_surface(std::move(extracted.surface));
  node_of_ = std::move(extracted.node);

  const std::size_t n = model_.nodes.size();
  for (std::size_t i = 0; i < n; ++i) {
    mass_ += model_.mass[i];
    pivot_ = pivot_ + model_.mass[i] * model_.nodes[i];
  }
  pivot_ = clamp.turns ? clamp.seat : (1 / mass_) * pivot_;
  fixed_.assign(n, {0, 0, 0});
  if (clamp.tag != no_clamp) hold(clamp);
  moved_.assign(n, Vector3{}), rate_.assign(n, Vector3{});
  if (is_static())
    start_.assign(n, Vector3{}), target_.assign(n, Vector3{});
  else
    strained_.assign(n, Vector3{}), force_.assign(n, Vector3{});
  for (const Material &material : model_.materials) {
    if (!material.hardening || yielding_) continue;
    require(!is_static(), "elastic solid: a quasi-static body does not yield");
    yielding_.emplace(model_);
  }
  if (clamp.turns) weigh_rotor();
  if (slides()) weigh_clamp();
  stable_step_ = std::numeric_limits<double>::infinity();
  if (is_static()) return;
  // A clamp that moves as a rigid body has no higher frequencies than its free nodes.
  const Fixed none(n, {0, 0, 0});
  const double square =
      largest_eigenvalue(model_.stiffness, model_.mass, moves_by_itself() ? none : fixed_, model_.cell_bound);
  stable_step_ = 2 / std::sqrt(square);
  options_.stiffness_damping += 2 * options.fastest_damping / std::sqrt(square);
  if (options_.stiffness_damping > 0)
    stable_step_ = std::min(stable_step_, 2 / (options_.stiffness_damping * square));
}

void ElasticSolid::hold(const Clamp &clamp) {
  clamped_nodes_ = nodes_on(model_, clamp.tag);
  require(!clamped_nodes_.empty(), "elastic solid: no face has the clamp's tag " + std::to_string(clamp.tag));
  for (const int i : clamped_nodes_)
    fixed_[static_cast<std::size_t>(i)] = {1, 1, 1};
}

void ElasticSolid::weigh_clamp() {
  if (is_static()) sliding_mass_ = mass_;
  for (const int i : is_static() ? std::vector<int>{} : clamped_nodes_)
    sliding_mass_ += model_.mass[static_cast<std::size_t>(i)];
}

void ElasticSolid::weigh_rotor() {
  const auto add = [&](std::size_t i) {
    const Vector3 r = model_.nodes[i] - pivot_;
    rotor_arm_ = rotor_arm_ + model_.mass[i] * r;
    add_about_origin(rotor_, model_.mass[i], r);
  };
  if (is_static()) {
    for (std::size_t i = 0; i < model_.nodes.size(); ++i)
      add(i);
  } else {
    for (const int i : clamped_nodes_)
      add(static_cast<std::size_t>(i));
  }
  rotor_inverse_ = inverse(rotor_);
}

void ElasticSolid::describe(Archive &archive) {
  archive.version(1);
  archive("last_step", last_step_, "s", at_least(0));
  archive("last_move", last_move_, "m", at_least(0));
  archive("load_work", load_work_, "J");
  archive("clamp_work", clamp_work_, "J");
  archive("dissipated", dissipated_, "J");
  archive("displacement", displacement_, "m");
  archive("velocity", velocity_, "m/s");
  archive("angular_velocity", angular_velocity_, "rad/s");
  archive("angular_momentum", spin_, "kg m2/s");
  archive("rotation", rotation_, "1", unit_length());
  if (is_static()) {
    archive("elapsed", elapsed_, "s", at_least(0));
    archive("duration", duration_, "s", at_least(0));
    archive("on_the_way", on_the_path_);
    archive.same_rows("start", start_, "m");
    archive.same_rows("target", target_, "m");
  } else {
    archive.same_rows("node_displacement", moved_, "m");
    archive.same_rows("node_velocity", rate_, "m/s");
    if (yielding_) yielding_->describe(archive);
  }
  describe_loads(archive);
  if (archive.reads()) follow_state();
}

void ElasticSolid::follow_state() {
  turned_ = !is_identity(rotation_);
  if (is_static())
    measure_path();
  else
    find_internal_forces(false);
  place_surface();
}

} // namespace platen::fem
