#include "apps/run/record.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/output/crack_discs.h"
#include "base/pi.h"
#include "base/shortest_text.h"
#include "dem/measure/stress.h"
#include "dem/particles.h"

namespace platen::apps {
namespace {

// Rows on the way to the target strain, where the scene leaves it open.
constexpr double automatic_rows = 600;

std::vector<CsvCell> crack_row(const dem::Crack &c) {
  return {c.time,      c.strain,
          c.point.x,   c.point.y,
          c.point.z,   c.normal.x,
          c.normal.y,  c.normal.z,
          c.area,      c.mode == dem::BondState::broken_in_tension ? "tension" : "shear",
          c.energy,    c.particle_a,
          c.particle_b};
}

void require_finite(const dem::Crack &c) {
  const auto sum = [](const Vector3 &v) { return v.x + v.y + v.z; };
  if (!std::isfinite(c.time + c.strain + sum(c.point) + sum(c.normal) + c.area + c.energy))
    throw coupling::NumericsStopped(fmt::format(
        "not finite: place, area or energy of the crack between particles {} and {} at time {} s; "
        "try a smaller `time_step.safety` or `loading.rate`",
        c.particle_a, c.particle_b, shortest_text(c.time)));
}

} // namespace

Record::Record(const Scene &scene, coupling::PlatenTest &test, Results &results, const OutputPaths &paths,
               Sampler sampler, double expected_steps)
    : scene_(scene),
      test_(test),
      results_(results),
      paths_(paths),
      sampler_(std::move(sampler)),
      rows_(scene.output.every, automatic_rows, expected_steps, test) {}

void Record::begin(const std::optional<Sample> &as_packed) {
  history_.emplace(paths_.history(), history_names(&test_));
  if (scene_.model.crack_log) cracks_.emplace(paths_.cracks(), crack_columns);
  if (as_packed) keep(*as_packed);
  keep(sampler_(test_));
}

void Record::resume(const FileMarks &marks) {
  history_.emplace(paths_.history(), history_names(&test_), marks.history_bytes);
  if (scene_.model.crack_log) cracks_.emplace(paths_.cracks(), crack_columns, marks.cracks_bytes);
}

void Record::require_tables(const FileMarks &marks, const std::string &checkpoint) const {
  require_resumable(paths_.history(), history_names(&test_), marks.history_bytes, checkpoint);
  if (scene_.model.crack_log)
    require_resumable(paths_.cracks(), crack_columns, marks.cracks_bytes, checkpoint);
}

void Record::observe(const Moment & /*now*/) {
  if (!test_.model.cracks.empty()) write_cracks();
  if (!rows_.is_due()) return;
  dem::StageClock::Lap lap(test_.model.clock, dem::Stage::measures);
  keep(sampler_(test_));
}

void Record::keep(const Sample &sample) {
  history_->row(history_row(sample, &test_));
  if (results_.falls_with(sample)) test_.gather(); // all ranks have the same sample
  results_.add(sample, test_);
  if (listener_) listener_(sample);
}

void Record::write_cracks() {
  for (const dem::Crack &c : test_.model.take_cracks()) {
    require_finite(c);
    cracks_->row(crack_row(c));
    results_.listen(c);
  }
}

void Record::mark(FileMarks &marks) {
  history_->sync();
  marks.history_bytes = history_->bytes();
  if (!cracks_) return;
  cracks_->sync();
  marks.cracks_bytes = cracks_->bytes();
}

void Record::finish() {
  if (test_.model.bonds) write_bond_stress();
  if (scene_.model.crack_log) write_events();
  if (scene_.model.crack_log && test_.model.bonds) write_crack_state();
  if (!cracks_ || !scene_.output.fields) return;
  cracks_->sync();
  write_crack_discs(paths_.cracks(), test_.time(), paths_.cracks_vtu());
}

// What bonds bear against their direction, and over the axial stress, as the run has left it (Onate et al.
// 2015, figure 11).
void Record::write_bond_stress() const {
  constexpr int classes = 9;
  const double axial = 0.5 * (test_.stress_top() + test_.stress_bottom());
  WholeTable table(paths_.bond_stress(), {"angle_low_deg", "angle_high_deg", "bonds", "pressed_bonds",
                                          "mean_stress_pa", "mean_pressed_stress_pa", "pressed_over_axial"});
  for (const dem::DirectionClass &c :
       dem::bond_stress_by_direction(test_.model.particles, *test_.model.bonds, classes))
    table.row({c.low / degree, c.high / degree, c.bonds, c.pressed, c.mean, c.mean_pressed,
               axial != 0 ? c.mean_pressed / axial : not_measured});
  table.finish();
}

// How wide each crack is as the run has left it, in the order of the bonds.
void Record::write_crack_state() const {
  const dem::Particles &p = test_.model.particles;
  const dem::Bonds &b = *test_.model.bonds;
  WholeTable table(paths_.crack_state(),
                   {"particle_a", "particle_b", "mode", "time_s", "x_m", "y_m", "z_m", "nx", "ny", "nz",
                    "jump_x_m", "jump_y_m", "jump_z_m", "area_m2", "opening_m", "slip_m", "largest_opening_m",
                    "largest_slip_m", "moved"});
  for (const dem::Opening &o : dem::openings(p, b)) {
    const auto i = static_cast<std::size_t>(b.record_first[o.record]),
               j = static_cast<std::size_t>(b.record_second[o.record]);
    const double radius = test_.model.settings().bond_layout.bond_radius(p.radius[i], p.radius[j]);
    const bool tension = b.state[o.record] == static_cast<int>(dem::BondState::broken_in_tension);
    table.row({p.id[i], p.id[j], tension ? "tension" : "shear", b.break_time[o.record], o.place.x, o.place.y,
               o.place.z, o.normal.x, o.normal.y, o.normal.z, o.jump.x, o.jump.y, o.jump.z,
               pi * radius * radius, o.opening, o.slip, results_.largest_openings().opening(o),
               results_.largest_openings().slip(o), p.id[o.second_moves ? j : i]});
  }
  table.finish();
}

void Record::write_events() const {
  WholeTable table(paths_.events(), {"time_s", "duration_s", "x_m", "y_m", "z_m", "size_m", "cracks",
                                     "energy_j", "magnitude"});
  for (const dem::AcousticEvent &e : results_.emission().events)
    table.row(
        {e.time, e.duration, e.centre.x, e.centre.y, e.centre.z, e.size, e.cracks, e.energy, e.magnitude});
  table.finish();
}

} // namespace platen::apps
