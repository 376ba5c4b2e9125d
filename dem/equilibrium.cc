#include "dem/equilibrium.h"

#include <algorithm>
#include <optional>
#include <string>

#include "dem/measure/fragments.h"
#include "dem/statics/conjugate_gradients.h"
#include "dem/statics/multigrid.h"
#include "dem/statics/network.h"

namespace platen::dem {
void require_fitting(const Particles &p, const StaticCase &load) {
  if ((!load.force.empty() && load.force.size() != p.size()) ||
      (!load.torque.empty() && load.torque.size() != p.size()))
    throw std::invalid_argument("static loads need one row per particle");
  const auto require_row = [&](int row, const char *what) {
    if (row < 0 || static_cast<std::size_t>(row) >= p.size())
      throw std::invalid_argument(std::string(what) + " is given for particle row " + std::to_string(row) +
                                  ". Allowed: 0 to " + std::to_string(p.size()) + ", exclusive");
  };
  for (const Support &s : load.supports)
    require_row(s.spring.particle, "a static support");
  std::vector<char> prescribed(p.size(), 0);
  for (const PrescribedMotion &l : load.prescribed) {
    require_row(l.particle, "a static motion");
    if (prescribed[l.particle]++)
      throw std::invalid_argument("particle " + std::to_string(p.id[l.particle]) +
                                  " is prescribed twice. Allowed: one motion for each particle");
  }
}

namespace {

// Pieces of the network without prescribed motion or support rest only under loads that balance. Checked
// here, because conjugate gradients would iterate until they are stopped.
void refuse_unbalanced(const Particles &p, const Bonds &bonds, const StaticCase &load, double tolerance) {
  if (load.force.empty() && load.torque.empty()) return;
  const Fragments pieces = find_fragments(p, &bonds);
  struct Sum {
    bool fixed = false;
    int particle = 0;               // a row of the piece
    Vector3 force, torque;          // N, N m about that particle
    double forces = 0, torques = 0; // sums of magnitudes
  };
  std::vector<Sum> sums(pieces.particles.size());
  const auto piece = [&](int row) -> Sum & { return sums[pieces.of_particle[row]]; };
  for (const Support &s : load.supports)
    piece(s.spring.particle).fixed = true;
  for (const PrescribedMotion &l : load.prescribed)
    piece(l.particle).fixed = true;
  for (std::size_t i = 0; i < p.size(); ++i)
    piece(static_cast<int>(i)).particle = static_cast<int>(i);
  for (std::size_t i = 0; i < p.size(); ++i) {
    Sum &s = piece(static_cast<int>(i));
    const Vector3 f = load.force.empty() ? Vector3{} : load.force[i],
                  t = load.torque.empty() ? Vector3{} : load.torque[i],
                  arm = p.position[i] - p.position[s.particle];
    s.force += f;
    s.torque += cross(arm, f) + t;
    s.forces += norm(f);
    s.torques += norm(arm) * norm(f) + norm(t);
  }
  for (const Sum &s : sums) {
    const bool turns = p.has_rotation() && norm(s.torque) > tolerance * s.torques;
    if (s.fixed || !(norm(s.force) > tolerance * s.forces || turns)) continue;
    const int i = s.particle;
    throw NoEquilibrium("nothing holds the piece of " +
                        std::to_string(pieces.particles[pieces.of_particle[i]]) + " spheres with particle " +
                        std::to_string(p.id[i]) + ", and its loads do not balance");
  }
}

void put(const Vector3 &a, double *to) {
  to[0] = a.x, to[1] = a.y, to[2] = a.z;
}

} // namespace

struct EquilibriumSolver::Implementation {
  virtual ~Implementation() = default;
  virtual StaticState solve(const StaticCase &load, const StaticSettings &settings,
                            const StaticState *start) = 0;
};

namespace {

template <int n>
class Network final : public EquilibriumSolver::Implementation {
public:
  Network(const Particles &p, const Bonds &b, const std::vector<BondStiffness> &of_rows)
      : p_(p), network_(b), bonds_(statics::assemble<n>(p, b, of_rows)), matrix_(bonds_) {
    diagonal_.resize(p.size());
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t k = bonds_.begin[i]; k < bonds_.begin[i + 1]; ++k)
        if (static_cast<std::size_t>(bonds_.column[k]) == i) diagonal_[i] = k;
  }

  StaticState solve(const StaticCase &load, const StaticSettings &settings,
                    const StaticState *start) override {
    require_fitting(p_, load);
    refuse_unbalanced(p_, network_, load, settings.tolerance);
    hold(load);
    support(load);
    std::vector<double> x(n * p_.size(), 0.0), right(n * p_.size(), 0.0);
    if (start != nullptr) begin_from(*start, x);
    take(load, x, right);
    if (!multigrid_)
      multigrid_.emplace(matrix_, std::vector<Vector3>(p_.position.begin(), p_.position.end()),
                         std::vector<double>(p_.radius.begin(), p_.radius.end()), fixed_);
    const statics::Solution s = statics::conjugate_gradients(matrix_, *multigrid_, fixed_, right, x,
                                                             settings.tolerance, settings.most_iterations);
    if (!(s.residual <= settings.tolerance))
      throw NoEquilibrium("the static solve stopped at a residual of " + std::to_string(s.residual) +
                          " of the loads after " + std::to_string(s.iterations) + " iterations");
    return state_of(x, s);
  }

private:
  // Particles that are prescribed, or have neither bonds nor support, have no equation. Another set of them
  // needs another multigrid.
  void hold(const StaticCase &load) {
    std::vector<char> fixed(p_.size(), 0);
    for (const PrescribedMotion &l : load.prescribed)
      fixed[l.particle] = 1;
    std::vector<char> supported(p_.size(), 0);
    for (const Support &s : load.supports)
      supported[s.spring.particle] = 1;
    for (std::size_t i = 0; i < p_.size(); ++i)
      if (!supported[i] && loose(i)) fixed[i] = 1;
    if (fixed == fixed_) return;
    fixed_ = std::move(fixed);
    multigrid_.reset();
  }
  bool loose(std::size_t i) const {
    const double *d = bonds_.at(diagonal_[i]);
    return std::all_of(d, d + n * n, [](double a) { return a == 0; });
  }

  void support(const StaticCase &load) {
    for (const std::size_t i : supported_)
      std::copy_n(bonds_.at(diagonal_[i]), n * n, matrix_.at(diagonal_[i]));
    supported_.clear();
    for (const Support &s : load.supports) {
      const int i = s.spring.particle;
      statics::add_support<n>(p_, s.spring, matrix_.at(diagonal_[i]));
      supported_.push_back(i);
    }
  }

  void begin_from(const StaticState &start, std::vector<double> &x) const {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      put(start.displacement[i], &x[n * i]);
      if constexpr (n == 6) put(p_.radius[i] * start.turn[i], &x[n * i + 3]);
    }
  }

  void take(const StaticCase &load, std::vector<double> &x, std::vector<double> &right) const {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      if (!load.force.empty()) put(load.force[i], &right[n * i]);
      if constexpr (n == 6)
        if (!load.torque.empty()) put(load.torque[i] / p_.radius[i], &right[n * i + 3]);
      if (fixed_[i]) std::fill_n(&x[n * i], n, 0.0);
    }
    for (const Support &s : load.supports)
      statics::add_support_load<n>(p_, s.spring, s.moved,
                                   &right[n * static_cast<std::size_t>(s.spring.particle)]);
    for (const PrescribedMotion &l : load.prescribed) {
      const std::size_t i = static_cast<std::size_t>(l.particle);
      put(l.displacement, &x[n * i]);
      if constexpr (n == 6) put(p_.radius[i] * l.turn, &x[n * i + 3]);
    }
  }

  StaticState state_of(const std::vector<double> &x, const statics::Solution &s) const {
    StaticState state;
    state.iterations = s.iterations;
    state.residual = s.residual;
    state.displacement.resize(p_.size());
    state.turn.resize(p_.size());
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const double *u = &x[n * i];
      state.displacement[i] = {u[0], u[1], u[2]};
      if constexpr (n == 6) state.turn[i] = Vector3{u[3], u[4], u[5]} / p_.radius[i];
    }
    return state;
  }

  const Particles &p_;
  const Bonds &network_;
  BlockMatrix<n, double> bonds_, matrix_; // without and with supports
  std::vector<std::size_t> diagonal_;     // diagonal block of each row
  std::vector<std::size_t> supported_;    // rows
  std::vector<char> fixed_;
  std::optional<statics::Multigrid<n>> multigrid_;
};

} // namespace

EquilibriumSolver::EquilibriumSolver(const Particles &particles, const Bonds &bonds)
    : EquilibriumSolver(particles, bonds, statics::at_rest(bonds)) {}
EquilibriumSolver::EquilibriumSolver(const Particles &particles, const Bonds &bonds,
                                     const std::vector<BondStiffness> &of_rows) {
  if (of_rows.size() != bonds.size())
    throw std::invalid_argument("a static solve needs one stiffness for each row of bonds");
  if (particles.has_rotation())
    implementation_ = std::make_unique<Network<6>>(particles, bonds, of_rows);
  else
    implementation_ = std::make_unique<Network<3>>(particles, bonds, of_rows);
}
EquilibriumSolver::~EquilibriumSolver() = default;

StaticState EquilibriumSolver::solve(const StaticCase &load, const StaticSettings &settings,
                                     const StaticState *start) {
  return implementation_->solve(load, settings, start);
}

StaticState solve_static(const Particles &particles, const Bonds &bonds, const StaticCase &load,
                         const StaticSettings &settings) {
  return EquilibriumSolver(particles, bonds).solve(load, settings);
}

} // namespace platen::dem
