// Energies of an elastic solid, and its shape without inertia.
#include <stdexcept>

#include "fem/elastic_model.h"
#include "fem/elastic_solid.h"

namespace platen::fem {

std::vector<Vector3> ElasticSolid::deformation() const {
  if (!is_static()) return strained_;
  std::vector<Vector3> u(start_.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = start_[i] + path_fraction() * (target_[i] - start_[i]);
  return u;
}

EnergyBalance ElasticSolid::energy_balance() const {
  EnergyBalance balance;
  balance.load_work = load_work_, balance.clamp_work = clamp_work_;
  (is_static() ? balance.unbalanced : balance.dissipated) = dissipated_;
  balance.kinetic = kinetic_energy();
  if (is_static()) {
    balance.strain = path_strain();
    return balance;
  }
  double shift = 0, along = 0;
  Vector3 moment{};
  for (std::size_t i = 0; i < force_.size(); ++i) {
    balance.strain -= 0.5 * dot(force_[i], to_space(strained_[i]));
    const Vector3 free = free_part(i, force_[i]);
    shift += dot(free, free) / model_.mass[i];
    along -= dot(free, clamp_.slides);
    if (turns()) moment = moment - cross(arm(i), free);
  }
  if (yielding_) {
    balance.strain += yielding_->energy_of_plastic_strain() - 0.5 * dot(strained_, yielding_->forces());
    balance.plastic = yielding_->plastic_work();
  }
  if (slides()) shift += along * along / sliding_mass_;
  if (turns()) {
    const Vector3 m = to_frame(moment);
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        shift += m[a] * rotor_inverse_[3 * a + b] * m[b];
  }
  balance.kinetic -= last_step_ * last_step_ / 8 * shift;
  return balance;
}

double ElasticSolid::kinetic_energy() const {
  const double speed = sliding_velocity();
  if (is_static())
    return (turns() ? 0.5 * dot(angular_velocity_, spin_) : 0.0) + 0.5 * sliding_mass_ * speed * speed;
  double twice = attached_mass_ * speed * speed;
  for (std::size_t i = 0; i < rate_.size(); ++i)
    twice += model_.mass[i] * dot(rate_[i], rate_[i]);
  return 0.5 * twice;
}

double ElasticSolid::path_strain() const {
  return path_[0] + path_fraction() * (path_[1] + path_fraction() * path_[2]);
}

void ElasticSolid::measure_path() {
  std::vector<Vector3> displacement(start_.size()), product;
  for (std::size_t i = 0; i < displacement.size(); ++i)
    displacement[i] = target_[i] - start_[i];
  multiply(model_.stiffness, start_, product);
  path_[0] = 0.5 * dot(start_, product);
  path_[1] = dot(displacement, product);
  multiply(model_.stiffness, displacement, product);
  path_[2] = 0.5 * dot(displacement, product);
}

std::vector<FaceCompliance> ElasticSolid::face_compliance() const {
  return fem::face_compliance(model_, node_surface(model_), fixed_);
}

void ElasticSolid::solve_for(const std::vector<Vector3> &vertex_loads, double duration) {
  if (!is_static()) throw std::logic_error("elastic solid: only a quasi-static body is solved for");
  if (vertex_loads.size() != node_of_.size())
    throw std::invalid_argument("elastic solid: one load per surface vertex, please");
  const bool follows = duration > 0 && !support_.empty();
  std::vector<StaticEquations> &solver = follows ? supported_solver_ : solver_;
  const NodeMatrix &stiffness = follows ? supported_ : model_.stiffness;
  if (solver.empty()) solver.emplace_back(stiffness, model_.nodes, fixed_, options_.solver);
  std::vector<Vector3> load(model_.nodes.size(), Vector3{});
  for (std::size_t v = 0; v < node_of_.size(); ++v)
    load[static_cast<std::size_t>(node_of_[v])] = to_frame(vertex_loads[v]);
  if (follows)
    for (std::size_t i = 0; i < load.size(); ++i)
      load[i] = load[i] + (0.5 * support_[i]) * (start_[i] + target_[i]);
  start_ = deformation();
  solver[0].solve(stiffness, load, target_);
  elapsed_ = 0, duration_ = duration > 0 ? duration : 0;
  on_the_path_ = duration_ > 0;
  measure_path();
  if (!on_the_path_) { // the full loads act along the whole path
    double work = 0;
    for (std::size_t i = 0; i < load.size(); ++i)
      work += dot(load[i], target_[i] - start_[i]);
    load_work_ += work;
    dissipated_ += work - path_[1] - path_[2];
  }
  place_surface();
}

void ElasticSolid::drift_evenly(double dt) {
  move_frame(dt);
  on_the_path_ = elapsed_ < duration_;
  const double before = path_strain();
  // A path of n steps ends after n steps, also with round-off in their sum.
  elapsed_ = elapsed_ + dt * (1 + 1e-9) >= duration_ ? duration_ : elapsed_ + dt;
  dissipated_ -= path_strain() - before;
}

void ElasticSolid::set_support(const std::vector<double> &vertex_stiffness) {
  if (!is_static() || !solver_.empty() || !supported_solver_.empty())
    throw std::logic_error("elastic solid: a quasi-static body is supported before its first solve");
  if (vertex_stiffness.size() != node_of_.size())
    throw std::invalid_argument("elastic solid: one support per surface vertex, please");
  support_.assign(model_.nodes.size(), 0.0);
  supported_ = model_.stiffness;
  for (std::size_t v = 0; v < node_of_.size(); ++v) {
    const int node = node_of_[v];
    support_[static_cast<std::size_t>(node)] = vertex_stiffness[v];
    double *block = supported_.find(static_cast<std::size_t>(node), node);
    for (const std::size_t k : {0, 4, 8})
      block[k] += vertex_stiffness[v];
  }
}

// Springs D on a body K: (K + D) u = F + D (u' + u'') / 2, with its last two positions, leaves a fraction 1 -
// 1 / (2 + 3/2 D/K) of the distance to the next solve, if the number of solves is large. D/K follows from a =
// D / (K + D), the fraction of a shift of all springs that the body follows at once.
double ElasticSolid::solves_behind(const Vector3 &direction) {
  constexpr double without = 2;
  if (support_.empty()) return without;
  if (supported_solver_.empty())
    supported_solver_.emplace_back(supported_, model_.nodes, fixed_, options_.solver);
  std::vector<Vector3> load(support_.size()), gone(support_.size(), Vector3{});
  for (std::size_t i = 0; i < load.size(); ++i)
    load[i] = support_[i] * direction;
  supported_solver_[0].solve(supported_, load, gone);
  double along = 0, springs = 0;
  for (std::size_t i = 0; i < load.size(); ++i)
    along += dot(gone[i], load[i]), springs += support_[i];
  if (!(springs > 0)) return without;
  const double at_once = along / springs; // a
  return without + 1.5 * at_once / (1 - at_once);
}

LinearSolver ElasticSolid::solver_kind() const {
  const std::vector<StaticEquations> &used = supported_solver_.empty() ? solver_ : supported_solver_;
  return used.empty() ? options_.solver : used[0].kind();
}

} // namespace platen::fem
