#include "apps/run/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/shortest_text.h"
#include "base/table.h"

namespace platen::apps {

// What is measured at a sample, some of it once for several columns.
struct Seen {
  const Sampler &sampler;
  const coupling::PlatenTest &problem;
  dem::GaugeStrain gauge;
  dem::EnergyLedger energy;
  coupling::Sleeve::WallState wall; // of a tube
  Seen(const Sampler &by, const coupling::PlatenTest &of)
      : sampler(by), problem(of), gauge(by.gauge_.strain(of.model.particles)), energy(of.energy()) {
    if (of.tube() != nullptr) wall = of.tube()->wall_state();
  }
  const dem::Particles &particles() const { return problem.model.particles; }
  double lateral_extremal() const { return -sampler.pairs_.lateral(particles()); }
  double axial_extremal() const { return -sampler.pairs_.axial(particles()); }
  double opening() const { return (*sampler.opening_)(particles()); }
  double deflection() const { return (*sampler.deflection_)(particles()); }
  double broken(dem::BondState mode) const { return static_cast<double>(problem.model.broken(mode)); }
};

namespace {

using coupling::PlatenTest;
constexpr HistoryColumn::Form number = HistoryColumn::Form::number, count = HistoryColumn::Form::count,
                              state = HistoryColumn::Form::in_checkpoints_alone;
constexpr HistoryColumn::Missing without_ledger = HistoryColumn::Missing::without_ledger,
                                 without_spheres = HistoryColumn::Missing::without_spheres,
                                 without_forces = HistoryColumn::Missing::without_forces,
                                 without_pressure = HistoryColumn::Missing::without_pressure,
                                 torn_through = HistoryColumn::Missing::torn_through;

// In every test: an energy of the ledger; what is measured on spheres of some place.
HistoryColumn energy(const char *name, double Sample::*member, double (*measure)(const Seen &)) {
  return {name, "J", member, measure, number, nullptr, without_ledger};
}
HistoryColumn of_spheres(const char *name, double Sample::*member, double (*measure)(const Seen &)) {
  return {name, "1", member, measure, number, nullptr, without_spheres};
}

bool in_cell(const PlatenTest &p) {
  return p.cell();
}
bool in_sleeve(const PlatenTest &p) {
  return p.sleeve() != nullptr;
}
bool in_tube(const PlatenTest &p) {
  return p.tube() != nullptr;
}
bool in_metal(const PlatenTest &p) {
  return in_tube(p) && p.tube()->yields();
}
bool in_wrap(const PlatenTest &p) {
  return in_tube(p) && p.tube()->wraps();
}
bool in_bonded_tube(const PlatenTest &p) {
  return in_tube(p) && p.tube()->is_bonded();
}
bool platens_yield(const PlatenTest &p) {
  return p.platens_yield();
}
bool of_disc(const PlatenTest &p) {
  return p.shape().kind == dem::ShapeKind::disc;
}
bool bent(const PlatenTest &p) {
  return p.bent();
}
bool notched(const PlatenTest &p) {
  return p.notched();
}

bool on_spring(const PlatenTest &p) {
  return p.machine() != nullptr;
}

// A platen presses that side.
template <coupling::Side side>
bool presses(const PlatenTest &p) {
  return p.platen(side) != nullptr;
}
template <coupling::Side side>
bool presses_along(const PlatenTest &p) {
  return presses<side>(p) || presses<coupling::opposite(side)>(p);
}
// Platens press other sides than top and bottom.
bool presses_sides(const PlatenTest &p) {
  return presses_along<coupling::Side::left>(p) || presses_along<coupling::Side::front>(p);
}

template <coupling::Side side>
double stress_on(const Seen &s) {
  return s.problem.stress(side);
}
template <coupling::Side side>
double friction_work_at(const Seen &s) {
  return s.problem.platen(side)->layer().friction_work;
}

bool staged(const PlatenTest &p) {
  return !p.settings().loading.stages.empty();
}
// A stage is led or ended by how the specimen widens.
bool widens(const PlatenTest &p) {
  const auto &stages = p.settings().loading.stages;
  return std::any_of(stages.begin(), stages.end(), [](const auto &stage) {
    return coupling::needs(stage, coupling::Widening::circumference);
  });
}

} // namespace

bool is_there(const HistoryColumn &column, const PlatenTest *problem) {
  if (column.there == nullptr) return true;
  return problem != nullptr && column.there(*problem);
}

bool may_be(double value, const HistoryColumn &column, const PlatenTest &problem) {
  using Missing = HistoryColumn::Missing;
  if (std::isfinite(value) || column.missing == Missing::never) return std::isfinite(value);
  return std::isnan(value) &&
         (column.missing != Missing::without_ledger || !problem.model.settings().energy_ledger);
}

const std::vector<HistoryColumn> &history_columns() {
  using S = Sample;
  using coupling::Side;
  using dem::BondState;
  static const std::vector<HistoryColumn> columns{
      {"time_s", "s", &S::time, [](const Seen &s) { return s.problem.time(); }},
      {"axial_strain_platen", "1", &S::strain_platen,
       [](const Seen &s) { return s.problem.closure_strain(); }},
      of_spheres("axial_strain_gauge", &S::strain_gauge,
                 [](const Seen &s) { return -s.gauge.axial; }),
      of_spheres("lateral_strain", &S::lateral_strain,
                 [](const Seen &s) { return -s.gauge.lateral(); }),
      of_spheres("volumetric_strain", &S::volumetric_strain,
                 [](const Seen &s) { return -(s.gauge.axial + s.gauge.lateral_x + s.gauge.lateral_y); }),
      {"axial_stress_top_pa", "Pa", &S::stress_top, [](const Seen &s) { return s.problem.stress_top(); }},
      {"axial_stress_bottom_pa", "Pa", &S::stress_bottom,
       [](const Seen &s) { return s.problem.stress_bottom(); }},
      {"confining_pressure_pa", "Pa", &S::confining_pressure,
       [](const Seen &s) { return s.problem.confining_pressure(); }},
      {"intact_bonds", "1", &S::intact_bonds,
       [](const Seen &s) { return static_cast<double>(s.problem.model.intact_bonds()); }, count},
      {"broken_tension", "1", &S::broken_tension,
       [](const Seen &s) { return s.broken(BondState::broken_in_tension); }, count},
      {"broken_shear", "1", &S::broken_shear,
       [](const Seen &s) { return s.broken(BondState::broken_in_shear); }, count},
      energy("kinetic_energy_j", &S::kinetic, [](const Seen &s) { return s.energy.kinetic; }),
      energy("bond_energy_j", &S::bond, [](const Seen &s) { return s.energy.bonds; }),
      energy("contact_energy_j", &S::contact, [](const Seen &s) { return s.energy.contacts; }),
      energy("body_energy_j", &S::body, [](const Seen &s) { return s.energy.bodies; }),
      energy("damping_work_j", &S::damping, [](const Seen &s) { return s.energy.damping; }),
      energy("friction_work_j", &S::friction, [](const Seen &s) { return s.energy.friction; }),
      energy("fracture_work_j", &S::fracture, [](const Seen &s) { return s.energy.fracture; }),
      energy("boundary_work_j", &S::boundary, [](const Seen &s) { return s.energy.boundary; }),
      energy("energy_residual_j", &S::residual, [](const Seen &s) { return s.energy.residual(); }),
      {"unbalanced_force_ratio", "1", &S::unbalanced,
       [](const Seen &s) { return s.problem.unbalanced_ratio(); }, number, nullptr, without_forces},
      of_spheres("lateral_strain_extremal", &S::lateral_extremal,
                 [](const Seen &s) { return s.lateral_extremal(); }),
      of_spheres("axial_strain_extremal", &S::axial_extremal,
                 [](const Seen &s) { return s.axial_extremal(); }),
      {"platen_speed_m_s", "m/s", &S::platen_speed, [](const Seen &s) { return s.problem.platen_speed(); }},
      {"time_step_s", "s", &S::time_step, [](const Seen &s) { return s.problem.time_step(); }},
      {"grain_contacts", "1", &S::touching,
       [](const Seen &s) { return static_cast<double>(s.problem.model.touching_count()); }, count},
      energy("plastic_work_j", &S::plastic, [](const Seen &s) { return s.energy.plastic; }),
      {"deviator_pa", "Pa", nullptr,
       [](const Seen &s) {
         return 0.5 * (s.problem.stress_top() + s.problem.stress_bottom()) - s.problem.confining_pressure();
       },
       number, in_cell},
      {"confined_area_share", "1", &S::confined_fraction,
       [](const Seen &s) { return s.problem.confined_fraction(); }, number, in_cell, without_pressure},
      {"volumetric_strain_sleeve", "1", &S::sleeve_volumetric_strain,
       [](const Seen &s) { return s.problem.sleeve_volumetric_strain(); }, number, in_sleeve},
      {"sleeve_deviator_pa", "Pa", &S::sleeve_deviator,
       [](const Seen &s) { return s.problem.sleeve_deviator(); }, number, in_sleeve},
      {"opening_m", "m", &S::opening, [](const Seen &s) { return s.opening(); }, number, of_disc,
       without_spheres},
      {"deflection_m", "m", &S::deflection, [](const Seen &s) { return s.deflection(); }, number, bent},
      {"midspan_moment_n_m", "N m", &S::midspan_moment,
       [](const Seen &s) { return s.problem.midspan_moment(); }, number, bent},
      {"cmod_m", "m", &S::mouth_opening, [](const Seen &s) { return s.problem.mouth_opening(); }, number,
       notched},
      {"stress_left_pa", "Pa", &S::stress_left, stress_on<Side::left>, number, presses<Side::left>},
      {"stress_right_pa", "Pa", &S::stress_right, stress_on<Side::right>, number, presses<Side::right>},
      {"stress_front_pa", "Pa", &S::stress_front, stress_on<Side::front>, number, presses<Side::front>},
      {"stress_back_pa", "Pa", &S::stress_back, stress_on<Side::back>, number, presses<Side::back>},
      {"strain_x", "1", &S::strain_x, [](const Seen &s) { return s.problem.closure_strain(0); }, number,
       presses_along<Side::left>},
      {"strain_y", "1", &S::strain_y, [](const Seen &s) { return s.problem.closure_strain(1); }, number,
       presses_along<Side::front>},
      {"friction_work_top_j", "J", nullptr, friction_work_at<Side::top>, number, presses_sides},
      {"friction_work_bottom_j", "J", nullptr, friction_work_at<Side::bottom>, number, presses_sides},
      {"friction_work_left_j", "J", nullptr, friction_work_at<Side::left>, number, presses<Side::left>},
      {"friction_work_right_j", "J", nullptr, friction_work_at<Side::right>, number, presses<Side::right>},
      {"friction_work_front_j", "J", nullptr, friction_work_at<Side::front>, number, presses<Side::front>},
      {"friction_work_back_j", "J", nullptr, friction_work_at<Side::back>, number, presses<Side::back>},
      {"machine_closure_m", "m", nullptr, [](const Seen &s) { return s.problem.machine_closure(); }, number,
       on_spring},
      {"machine_energy_j", "J", &S::machine_energy,
       [](const Seen &s) {
         return s.problem.machine()->elastic_energy() + s.problem.machine()->kinetic_energy();
       },
       number, on_spring},
      {"platen_unbalanced_work_j", "J", &S::unbalanced_work,
       [](const Seen &s) { return s.energy.unbalanced; }, number,
       [](const PlatenTest &p) { return p.without_inertia(); }},
      {"platen_plastic_work_j", "J", &S::platen_plastic,
       [](const Seen &s) { return s.problem.platen_plastic_work(); }, number, platens_yield,
       without_ledger},
      {"platen_plastic_strain", "1", nullptr, [](const Seen &s) { return s.problem.platen_plastic_strain(); },
       number, platens_yield},
      {"stage", "1", &S::stage,
       [](const Seen &s) { return 1.0 + static_cast<double>(s.problem.program().stage_number()); }, count,
       staged},
      {"circumferential_strain", "1", nullptr,
       [](const Seen &s) { return s.problem.circumferential_strain(); }, number, widens, without_spheres},
      {"total_load_n", "N", &S::total_load,
       [](const Seen &s) {
         return s.problem.tube_load() +
                0.5 * (s.problem.stress_top() + s.problem.stress_bottom()) * s.problem.nominal_area();
       },
       number, in_tube},
      {"tube_load_n", "N", &S::tube_load, [](const Seen &s) { return s.problem.tube_load(); }, number,
       in_tube},
      {"tube_axial_stress_pa", "Pa", &S::tube_axial, [](const Seen &s) { return s.wall.axial; }, number,
       in_tube},
      {"tube_hoop_stress_pa", "Pa", &S::tube_hoop, [](const Seen &s) { return s.wall.hoop; }, number,
       in_tube},
      {"tube_pressure_pa", "Pa", &S::tube_pressure,
       [](const Seen &s) { return s.problem.tube()->specimen_pressure(); }, number, in_tube},
      {"tube_plastic_strain", "1", nullptr, [](const Seen &s) { return s.wall.plastic_strain; }, number,
       in_metal},
      {"tube_yielded_share", "1", nullptr, [](const Seen &s) { return s.wall.yielded; }, number, in_metal},
      {"tube_bulge_m", "m", nullptr, [](const Seen &s) { return s.wall.bulge; }, number, in_tube},
      {"tube_slip_m", "m", nullptr, [](const Seen &s) { return s.problem.tube()->slip(); }, number, in_tube},
      {"tube_bonded_share", "1", nullptr,
       [](const Seen &s) { return s.problem.tube()->layer().bonded_share(); }, number, in_bonded_tube},
      {"wrap_hoop_strain", "1", &S::wrap_hoop, [](const Seen &s) { return s.wall.hoop_strain; }, number,
       in_wrap, torn_through},
      {"wrap_largest_hoop_strain", "1", &S::wrap_most_hoop, [](const Seen &s) { return s.wall.most_hoop; },
       number, in_wrap, torn_through},
      {"wrap_torn_share", "1", &S::wrap_torn, [](const Seen &s) { return s.wall.torn; }, number, in_wrap},
      {"cell_pressure_pa", "Pa", &S::cell_pressure,
       [](const Seen &s) { return s.problem.confining_pressure(); }, state, in_cell},
      {"cycling", "1", &S::cycling, [](const Seen &s) { return s.problem.cycling() ? 1.0 : 0.0; }, state},
      // Of a hydrostatic test there is none, though its program says so in the step that finishes it.
      {"axial_stage", "1", &S::axial_stage,
       [](const Seen &s) {
         const std::optional<coupling::CellSettings> &cell = s.problem.settings().loading.cell;
         return s.problem.axial_stage() && !(cell && cell->alone) ? 1.0 : 0.0;
       },
       state},
      {"loads", "1", &S::loads,
       [](const Seen &s) { return static_cast<double>(s.problem.program().loads()); }, state, nullptr,
       HistoryColumn::Missing::never, S{}.loads},
      {"setting", "1", &S::setting,
       [](const Seen &s) { return static_cast<double>(s.problem.program().stage().setting()); }, state,
       nullptr, HistoryColumn::Missing::never, S{}.setting}};
  return columns;
}

double &value_of(Sample &sample, std::size_t k) {
  const std::vector<HistoryColumn> &all = history_columns();
  if (all[k].member != nullptr) return sample.*all[k].member;
  std::size_t place = 0;
  for (std::size_t before = 0; before < k; ++before)
    place += all[before].member == nullptr;
  if (sample.more.size() <= place) sample.more.resize(place + 1, std::numeric_limits<double>::quiet_NaN());
  return sample.more[place];
}

std::vector<std::string> history_names(const PlatenTest *problem) {
  std::vector<std::string> names;
  for (const HistoryColumn &column : history_columns())
    if (column.form != state && is_there(column, problem)) names.emplace_back(column.name);
  return names;
}

std::vector<CsvCell> history_row(const Sample &sample, const PlatenTest *problem) {
  Sample s = sample;
  std::vector<CsvCell> row;
  for (std::size_t k = 0; k < history_columns().size(); ++k) {
    const HistoryColumn &column = history_columns()[k];
    if (column.form == state || !is_there(column, problem)) continue;
    const double value = value_of(s, k);
    if (column.form == count && std::isfinite(value)) // which an older checkpoint lacks
      row.emplace_back(static_cast<long long>(value));
    else
      row.emplace_back(value);
  }
  return row;
}

void describe(Archive &archive, const std::string &name, std::vector<Sample> &samples) {
  constexpr double most_counted = 9007199254740992; // 2^53: beyond it not every whole number is a double
  Table table;
  std::vector<Column<double> *> columns;
  for (const HistoryColumn &column : history_columns())
    columns.push_back(&table.add<double>(
        column.name, column.unit, column.form == number ? any_value() : or_nan(between(0, most_counted)),
        column.before));
  table.resize(samples.size());
  for (std::size_t row = 0; row < samples.size(); ++row)
    for (std::size_t k = 0; k < columns.size(); ++k)
      (*columns[k])[row] = value_of(samples[row], k);
  archive.table(name, table);
  if (!archive.reads()) return;
  samples.assign(table.size(), Sample{});
  for (std::size_t row = 0; row < samples.size(); ++row)
    for (std::size_t k = 0; k < columns.size(); ++k)
      value_of(samples[row], k) = (*columns[k])[row];
}

Sampler::Sampler(const PlatenTest &problem)
    : gauge_(problem.model.particles, problem.shape(), problem.model.bonds.get()),
      pairs_(problem.model.particles, problem.shape(), problem.model.bonds.get()) {
  if (problem.shape().kind == dem::ShapeKind::disc)
    opening_.emplace(problem.model.particles, problem.shape());
  if (!problem.bent()) return;
  try {
    deflection_.emplace(problem.model.particles, problem.shape(), problem.three_points().span);
  } catch (const std::invalid_argument &e) {
    throw coupling::BadSetup("specimen.radius",
                             std::string("is too large for a deflection: ") + e.what() + ".");
  }
}

Sample Sampler::operator()(const PlatenTest &problem) const {
  const Seen seen(*this, problem);
  Sample sample;
  for (std::size_t k = 0; k < history_columns().size(); ++k) {
    const HistoryColumn &column = history_columns()[k];
    if (!is_there(column, &problem)) continue;
    const double value = value_of(sample, k) = column.measure(seen);
    if (!may_be(value, column, problem))
      throw coupling::NumericsStopped(
          fmt::format("not finite: {} of history.csv is {} at step {}, time {} s; try a smaller "
                      "`time_step.safety` or `loading.rate`",
                      column.name, value, problem.steps(), shortest_text(problem.time())));
  }
  return sample;
}

} // namespace platen::apps
