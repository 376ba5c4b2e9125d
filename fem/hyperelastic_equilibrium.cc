// Equilibrium of a HyperelasticSolid: Newton's method along a path from the present loads to the new ones.
//
// Loads and leads are a share t of the way from old to new; of what was out of balance at the start, 1 - t is
// left. The tangent is exact, with the stiffness of the follower pressure (not symmetric), and is factorised
// anew in every iteration (UMFPACK). A new place is asked for inverted cells before it is used: first the
// correction is shortened, then the step along the path.
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include "fem/hyperelastic_solid.h"
#include "fem/loop.h"

namespace platen::fem {
namespace {

// A correction is shortened at most so often for one that would turn a cell inside out ...
constexpr int inversion_cuts = 6;
// ... and so often, in a line search, where the residual along it has not fallen (Crisfield, Non-linear
// Finite Element Analysis, vol. 1, 1991, section 9.2.2: a loose search is enough for Newton's method). Full
// corrections are tried first: rubber that hardly changes its volume answers them with a large residual that
// the next one takes away, and a search would creep.
constexpr int line_cuts = 4;
constexpr double slack = 0.8;
// Volume ratios are known to this, so that stresses are to it times the bulk modulus: no smaller residual can
// be asked for.
constexpr double round_off = 2e-15;

double squared(const std::vector<Point> &values) {
  double sum = 0;
  for (const Point &v : values)
    sum += dot(v, v);
  return sum;
}

} // namespace

class EquilibriumPath {
public:
  EquilibriumPath(HyperelasticSolid &solid, const EquilibriumTarget &target,
                  const EquilibriumControl &control)
      : solid_(solid),
        control_(control),
        start_(solid.displacement_),
        old_pressure_(solid.face_pressure_),
        new_pressure_(old_pressure_),
        old_works_{solid.pressure_work_, solid.lead_work_},
        goal_(start_),
        fading_(start_.size()),
        trial_(start_.size()),
        dofs_(3 * start_.size()) {
    for (const PressureTarget &p : target.pressures) {
      solid.pressure(p.tag); // throws where no face has it
      if (!std::isfinite(p.pressure)) throw std::invalid_argument("solid: pressure must be finite");
      for (std::size_t f = 0; f < new_pressure_.size(); ++f)
        if (solid.mesh_.faces[f].tag == p.tag) new_pressure_[f] = p.pressure;
    }
    for (const LeadTarget &l : target.leads)
      set_goal(l);
    solid.update_forces();
    for (std::size_t n = 0; n < start_.size(); ++n)
      fading_[n] = solid.out_of_balance(n);
    double areas = 0;
    for (const ReferenceCell &cell : solid.mesh_.cells)
      areas += std::pow(cell.volume, 4.0 / 3.0);
    noise_ = round_off * solid.material_.law.bulk_modulus * std::sqrt(areas);
    build_matrix();
  }

  EquilibriumReport run() {
    double share = 0, step = 1;
    int cuts = 0; // in a row
    std::vector<Point> reached = start_;
    while (share < 1) {
      const double next = share + step >= 1 - 1e-12 ? 1 : share + step;
      const std::vector<Point> forces = lead_forces();
      const std::vector<double> pressures = solid_.face_pressure_;
      bool found = converge(next, false);
      if (!found) {
        place(reached);
        found = converge(next, true);
      }
      if (found) {
        book(reached, pressures, forces);
        share = next;
        reached = solid_.displacement_;
        ++report_.steps;
        // After an easy step a longer one.
        if (2 * (static_cast<int>(report_.residuals.size()) - 1) <= control_.iterations) step *= 2;
        cuts = 0;
        continue;
      }
      solid_.face_pressure_ = pressures;
      place(reached);
      step /= 2;
      ++report_.cuts;
      if (++cuts > control_.cuts) fail(share, next);
    }
    std::fill(solid_.velocity_.begin(), solid_.velocity_.end(), Point{});
    solid_.place_surface();
    return report_;
  }

private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }

  void set_goal(const LeadTarget &target) {
    const HyperelasticSolid::Lead &own = solid_.lead_of(target.lead);
    const std::size_t given = target.displacement.size();
    if (given != 1 && given != own.nodes.size())
      throw std::invalid_argument("solid: a lead's target needs one displacement, or one per node");
    for (std::size_t m = 0; m < own.nodes.size(); ++m)
      for (std::size_t k = 0; k < 3; ++k)
        if (own.components[k]) goal_[index(own.nodes[m])][k] = target.displacement[given == 1 ? 0 : m][k];
  }

  void build_matrix() {
    using Column = dealii::types::global_dof_index;
    const SolidMesh &mesh = solid_.mesh_;
    dealii::DynamicSparsityPattern pattern(static_cast<Column>(dofs_));
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      std::set<int> around;
      for (std::size_t k = mesh.first_corner[n]; k < mesh.first_corner[n + 1]; ++k)
        around.insert(mesh.cell_nodes[mesh.corner[k] / 8].begin(), mesh.cell_nodes[mesh.corner[k] / 8].end());
      std::vector<Column> columns;
      for (const int other : around)
        for (Column k = 0; k < 3; ++k)
          columns.push_back(3 * static_cast<Column>(other) + k);
      for (std::size_t k = 0; k < 3; ++k)
        pattern.add_entries(static_cast<Column>(3 * n + k), columns.begin(), columns.end(), true);
    }
    pattern_.copy_from(pattern);
    matrix_.reinit(pattern_);
  }

  // Places nodes and updates forces; the place has been found sound.
  void place(const std::vector<Point> &displacement) {
    solid_.displacement_ = displacement;
    solid_.place_surface();
    solid_.update_forces();
  }

  // What is out of balance at a share of the path, led components zero; returns its size over the forces.
  double residual(double share, std::vector<Point> &balance) const {
    double forces = 0;
    for (std::size_t n = 0; n < balance.size(); ++n) {
      balance[n] = solid_.out_of_balance(n) - (1 - share) * fading_[n];
      for (std::size_t k = 0; k < 3; ++k)
        if (solid_.is_led(n, k)) balance[n][k] = 0;
    }
    for (const CellForce &cell : solid_.cell_force_)
      for (const Point &f : cell.force)
        forces += dot(f, f);
    forces += squared(solid_.pressed_) + squared(solid_.load_);
    return std::sqrt(squared(balance)) / std::max(std::sqrt(forces), noise_ / control_.tolerance);
  }

  // Newton's correction for what is out of balance and for the leads' way to their place.
  std::vector<Point> correction(const std::vector<Point> &balance, const std::vector<Point> &wanted) {
    const std::size_t cells = solid_.mesh_.cells.size();
    matrix_ = 0;
    std::vector<CellStiffness> own(std::min<std::size_t>(cells, 256));
    for (std::size_t from = 0; from < cells; from += own.size()) {
      const std::size_t count = std::min(own.size(), cells - from);
      for_each_part(count, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c)
          own[c] = solid_.total_stiffness(from + c);
      });
      for (std::size_t c = 0; c < count; ++c)
        add(from + c, own[c]);
    }
    dealii::Vector<double> right(dofs_);
    const double scale = matrix_.linfty_norm();
    for (std::size_t n = 0; n < balance.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto row = static_cast<dealii::types::global_dof_index>(3 * n + k);
        right(row) = balance[n][k];
        if (!solid_.is_led(n, k)) continue;
        matrix_.set(row, row, scale);
        right(row) = scale * (wanted[n][k] - solid_.displacement_[n][k]);
      }
    dealii::SparseDirectUMFPACK solver;
    solver.initialize(matrix_);
    solver.solve(right);
    std::vector<Point> move(balance.size());
    for (std::size_t n = 0; n < move.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k)
        move[n][k] = right(static_cast<dealii::types::global_dof_index>(3 * n + k));
    return move;
  }

  void add(std::size_t cell, const CellStiffness &k) {
    const auto &nodes = solid_.mesh_.cell_nodes[cell];
    for (std::size_t m = 0; m < 24; ++m) {
      const std::size_t node = index(nodes[m / 3]);
      if (solid_.is_led(node, m % 3)) continue;
      std::array<dealii::types::global_dof_index, 24> columns;
      for (std::size_t n = 0; n < 24; ++n)
        columns[n] = static_cast<dealii::types::global_dof_index>(3 * index(nodes[n / 3]) + n % 3);
      matrix_.add(static_cast<dealii::types::global_dof_index>(3 * node + m % 3), 24, columns.data(),
                  &k[24 * m], true, false);
    }
  }

  bool converge(double share, bool search) {
    for (std::size_t f = 0; f < new_pressure_.size(); ++f)
      solid_.face_pressure_[f] = old_pressure_[f] + share * (new_pressure_[f] - old_pressure_[f]);
    std::vector<Point> wanted(start_.size()), balance(start_.size());
    for (std::size_t n = 0; n < wanted.size(); ++n)
      wanted[n] = share == 1 ? goal_[n] : start_[n] + share * (goal_[n] - start_[n]);
    solid_.update_forces();
    worst_ = {};
    report_.residuals = {residual(share, balance)};
    for (int k = 0;; ++k) {
      const double off = lead_distance(wanted), left = report_.residuals.back();
      if (!std::isfinite(left)) return false;
      if (left <= control_.tolerance && off == 0) return true;
      if (k == control_.iterations) return false;
      std::vector<Point> move;
      try {
        move = correction(balance, wanted);
      } catch (const dealii::ExceptionBase &) { // singular: the step went past a limit
        return false;
      }
      ++report_.iterations;
      if (!std::isfinite(squared(move))) return false;
      if (!advance(share, move, balance, wanted, search && off == 0)) return false;
      report_.residuals.push_back(residual(share, balance));
    }
  }

  double lead_distance(const std::vector<Point> &wanted) const {
    double off = 0;
    for (std::size_t n = 0; n < wanted.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k)
        if (solid_.is_led(n, k)) off = std::max(off, std::abs(wanted[n][k] - solid_.displacement_[n][k]));
    return off;
  }

  // Goes along the correction as far as no cell is turned inside out and, with `search`, as the residual
  // along it has fallen. False where no length will do.
  bool advance(double share, const std::vector<Point> &move, std::vector<Point> &balance,
               const std::vector<Point> &wanted, bool search) {
    const std::vector<Point> from = solid_.displacement_;
    const double before = along(move, balance);
    double length = 1;
    int line = 0;
    for (int inverted = 0; inverted < inversion_cuts;) {
      for (std::size_t n = 0; n < from.size(); ++n) {
        trial_[n] = from[n] + length * move[n];
        for (std::size_t k = 0; k < 3; ++k)
          if (length == 1 && solid_.is_led(n, k)) trial_[n][k] = wanted[n][k]; // to the last bit
      }
      worst_ = solid_.first_inverted(trial_);
      if (worst_.cell >= 0) {
        worst_place_ = solid_.cell_middle(worst_.cell, trial_);
        length /= 2, ++inverted;
        continue;
      }
      place(trial_);
      residual(share, balance);
      const double after = along(move, balance);
      if (!search || line == line_cuts || std::abs(after) <= slack * std::abs(before)) return true;
      length *= std::clamp(before / (before - after), 0.1, 0.5), ++line;
    }
    return false;
  }

  double along(const std::vector<Point> &move, const std::vector<Point> &balance) const {
    double sum = 0;
    for (std::size_t n = 0; n < move.size(); ++n)
      sum += dot(move[n], balance[n]);
    return sum;
  }

  std::vector<Point> lead_forces() const {
    std::vector<Point> forces(start_.size());
    for (std::size_t n = 0; n < forces.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k)
        if (solid_.is_led(n, k)) forces[n][k] = -solid_.out_of_balance(n)[k];
    return forces;
  }

  // Works of one step along the straight line, with the mean of the loads at both ends.
  void book(const std::vector<Point> &from, const std::vector<double> &pressures,
            const std::vector<Point> &forces) {
    std::vector<double> mean = pressures;
    for (std::size_t f = 0; f < mean.size(); ++f)
      mean[f] = 0.5 * (mean[f] + solid_.face_pressure_[f]);
    const std::vector<Point> now = lead_forces();
    for (std::size_t n = 0; n < now.size(); ++n)
      solid_.lead_work_ += 0.5 * dot(forces[n] + now[n], solid_.displacement_[n] - from[n]);
    solid_.pressure_work_ -= solid_.pressure_work_to(from, mean);
  }

  [[noreturn]] void fail(double share, double tried) {
    std::ostringstream text;
    text << "solid: no equilibrium beyond " << share << " of the way to the new loads, in steps down to "
         << tried - share << ", at ";
    for (std::size_t f = 0; f < new_pressure_.size(); ++f)
      solid_.face_pressure_[f] = old_pressure_[f] + tried * (new_pressure_[f] - old_pressure_[f]);
    text << solid_.words_of_loads() << "; ";
    int cell = worst_.cell;
    Point at = worst_place_;
    if (cell >= 0) {
      text << "cell " << cell << " at (" << at[0] << ", " << at[1] << ", " << at[2]
           << ") m would turn inside out: volume ratio " << worst_.volume_ratio;
    } else {
      cell = worst_balanced(tried);
      at = solid_.cell_middle(cell, solid_.displacement_);
      text << "cell " << cell << " at (" << at[0] << ", " << at[1] << ", " << at[2]
           << ") m is least in balance";
    }
    text << "; residuals of the last try:";
    for (const double r : report_.residuals)
      text << ' ' << r;
    solid_.face_pressure_ = old_pressure_;
    solid_.pressure_work_ = old_works_[0], solid_.lead_work_ = old_works_[1];
    place(start_);
    throw EquilibriumFailure(text.str(), cell, at, share);
  }

  // A cell at the node that is farthest from balance.
  int worst_balanced(double share) {
    solid_.update_forces();
    std::vector<Point> balance(start_.size());
    residual(share, balance);
    const auto less = [](const Point &a, const Point &b) { return dot(a, a) < dot(b, b); };
    const auto node =
        static_cast<std::size_t>(std::max_element(balance.begin(), balance.end(), less) - balance.begin());
    return static_cast<int>(solid_.mesh_.corner[solid_.mesh_.first_corner[node]] / 8);
  }

  HyperelasticSolid &solid_;
  EquilibriumControl control_;
  std::vector<Point> start_;
  std::vector<double> old_pressure_, new_pressure_; // of each face
  std::array<double, 2> old_works_;                 // J, of pressure and leads
  std::vector<Point> goal_, fading_, trial_;
  std::size_t dofs_;
  double noise_ = 0; // N
  dealii::SparsityPattern pattern_;
  dealii::SparseMatrix<double> matrix_;
  EquilibriumReport report_;
  HyperelasticSolid::Worst worst_;
  Point worst_place_{};
};

EquilibriumReport HyperelasticSolid::solve(const EquilibriumTarget &target,
                                           const EquilibriumControl &control) {
  return EquilibriumPath(*this, target, control).run();
}

} // namespace platen::fem
