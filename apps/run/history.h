// One row of history.csv: what is measured at every sample of a run.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/csv_writer.h"
#include "base/archive.h"
#include "coupling/platen_test.h"
#include "dem/energy.h"
#include "dem/measure/damage.h"
#include "dem/measure/gauge.h"

namespace platen::apps {

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

// Laboratory signs: stresses and axial strains positive in compression, lateral strain negative where the
// specimen bulges. NaN: not measured.
struct Sample {
  double time = 0;                            // s
  double strain_platen = 0, strain_gauge = 0; // compression positive
  double lateral_strain = 0, volumetric_strain = 0;
  double lateral_extremal = 0, axial_extremal = 0; // Tannu's pairs of outermost particles
  double stress_top = 0, stress_bottom = 0;        // Pa
  double confining_pressure = 0;                   // Pa, that acts: of a cell or on a wall
  // Of the lateral surface that a cell loads.
  double confined_fraction = not_measured;
  double cell_pressure = 0;            // Pa, of a cell alone
  double sleeve_volumetric_strain = 0; // of the volume within a sleeve
  double sleeve_deviator = 0;          // Pa, axial, over the specimen's area
  // Of a tube: N, of the platens on its ends, and on it and the specimen together; Pa, of its middle half,
  // compression of the axis and tension of the hoop positive, and of the specimen on its inner face there.
  double tube_load = 0, total_load = 0, tube_axial = 0, tube_hoop = 0, tube_pressure = 0;
  double wrap_hoop = 0, wrap_most_hoop = 0, wrap_torn = 0; // of a wrap: strains of its hoops, torn fraction
  double intact_bonds = 0, broken_tension = 0, broken_shear = 0;
  double kinetic = 0, bond = 0, contact = 0, body = 0, damping = 0, friction = 0, fracture = 0, boundary = 0,
         plastic = 0,        // J
      platen_plastic = 0;    // J, of it in platens
  double residual = 0;       // J
  double unbalanced = 0;     // 1
  double platen_speed = 0;   // m/s
  double time_step = 0;      // s
  double touching = 0;       // grain contacts
  double opening = 0;        // m, of a disc across its loaded diameter
  double deflection = 0;     // m, of a bent bar
  double midspan_moment = 0; // N m, of a bent bar
  double mouth_opening = 0;  // m, of its notch
  double stress_left = 0, stress_right = 0, stress_front = 0, stress_back = 0; // Pa, of side platens
  double strain_x = 0, strain_y = 0; // of the platens there, as strain_platen is along z
  double machine_energy = 0;         // J, part of `body`: of the machine's spring and the mass on it
  double unbalanced_work = 0;        // J, part of `residual`: of platens without inertia
  double cycling = 0;                // 1 from a turn of the platens until its strain has been reached again
  double axial_stage = 1;            // 0 while a cell's pressure rises and stands alone
  double loads = 1;                  // a coupling::Loads: whether its stage loads the axis on, and by what
  double setting = 0;                // how often sides have been asked something else
  double stage = 1;                  // of those that the scene writes, from 1
  std::vector<double> more;          // of columns without a member, in their order

  // Pa, mean of both platens of an axis, 0 x, 1 y, 2 z; less the cell's pressure.
  double stress(int axis = 2) const {
    return 0.5 * (axis == 0   ? stress_left + stress_right
                  : axis == 1 ? stress_front + stress_back
                              : stress_top + stress_bottom);
  }
  double deviator(int axis = 2) const { return stress(axis) - cell_pressure; }
  double internal() const { // J, without the machine's
    return bond + contact + (machine_energy > 0 ? body - machine_energy : body);
  }
  double broken() const { return broken_tension + broken_shear; } // bonds
};

constexpr double Sample::*platen_strain(int axis) {
  return axis == 0 ? &Sample::strain_x : axis == 1 ? &Sample::strain_y : &Sample::strain_platen;
}

// Of the platen on that side.
constexpr double Sample::*stress_of(coupling::Side side) {
  using coupling::Side;
  return side == Side::bottom  ? &Sample::stress_bottom
         : side == Side::top   ? &Sample::stress_top
         : side == Side::left  ? &Sample::stress_left
         : side == Side::right ? &Sample::stress_right
         : side == Side::front ? &Sample::stress_front
                               : &Sample::stress_back;
}

// A column of history.csv, or a number that only checkpoints keep: declared once, in history.cc. A checkpoint
// that was written before there was a column gives `before` for it.
struct Seen;
struct HistoryColumn {
  enum class Form { number, count, in_checkpoints_alone };
  // Where a test that has the column does not measure it, so that NaN is no fault.
  enum class Missing {
    never,
    without_ledger,   // of energies
    without_spheres,  // in all rows, where a specimen has none in the place that it is measured in
    without_forces,   // in rows where no bond bears a force
    without_pressure, // in rows where a sleeve has no pressure
    torn_through      // in rows where no element of a wrap's middle half is whole
  };
  const char *name, *unit;
  double Sample::*member; // null: kept in `more`
  double (*measure)(const Seen &);
  Form form = Form::number;
  bool (*there)(const coupling::PlatenTest &) = nullptr; // null: in every test
  Missing missing = Missing::never;
  double before = not_measured;
};
const std::vector<HistoryColumn> &history_columns();
// Of column k.
double &value_of(Sample &sample, std::size_t k);
// Whether a test has the column, null: any test; and whether a number of it is one, or is missing as it may.
bool is_there(const HistoryColumn &column, const coupling::PlatenTest *problem);
bool may_be(double value, const HistoryColumn &column, const coupling::PlatenTest &problem);

// Of one test; a null problem: those of every test.
std::vector<std::string> history_names(const coupling::PlatenTest *problem);
std::vector<CsvCell> history_row(const Sample &sample, const coupling::PlatenTest *problem);
void describe(Archive &archive, const std::string &name, std::vector<Sample> &samples);

// Measures a problem; the gauges remember its reference state.
class Sampler {
public:
  // Throws coupling::BadSetup where a bar has too few spheres for its deflection to be measured.
  explicit Sampler(const coupling::PlatenTest &problem);
  // Throws coupling::NumericsStopped, naming the column and the time, where a number is not finite that the
  // test measures.
  Sample operator()(const coupling::PlatenTest &problem) const;

private:
  friend struct Seen;
  dem::Gauge gauge_;
  dem::ExtremalPairs pairs_;
  std::optional<dem::DiscOpening> opening_;
  std::optional<dem::Deflection> deflection_;
};

} // namespace platen::apps
