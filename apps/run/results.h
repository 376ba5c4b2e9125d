// The record of a test: its samples, what is followed while it runs, and what follows from them.
#pragma once

#include <vector>

#include "apps/run/history.h"
#include "apps/run/peak.h"
#include "apps/run/state_at_peak.h"
#include "coupling/platen_test.h"
#include "dem/measure/acoustic_emission.h"
#include "dem/measure/cracks.h"
#include "dem/measure/failure_pattern.h"
#include "dem/measure/openings.h"

namespace platen::apps {

// Damage, opening, cones and cracks when the stress has fallen to 0.8 of the peak (or at the end of a run).
struct Pattern {
  double time = not_measured, strain = not_measured; // s, platen strain along the loaded axis
  dem::FailureMeasures failure;
  double broken_tension = not_measured, broken_shear = not_measured;
  void describe(Archive &archive);
};

// Of the specimen where moduli are taken, at 40 % of the largest stress.
struct ModulusState {
  bool found = false;
  double stress = not_measured;  // Pa, the deviator there
  double time = not_measured;    // s
  double unequal = not_measured; // difference of the stresses on both platens over their mean
  std::size_t readings = 0;      // of the axial stage until then
  double broken = 0;             // bonds, since the axial stage began
  double plastic_share = 0;      // plastic work over the energy of bonds; 0 without a ledger
  bool loaded_on = false;        // the platens drove on there, with sides as where the strains begin
};

// A largest stress of history.csv and when it was; NaN where none was measured.
struct LargestReading {
  double value = not_measured, time = not_measured; // Pa, s
};

// Which samples show what a specimen bears: those in which its stage loads the axis on. After another stage,
// or a turn of the platens, the strain first has to come back to where it was.
class LoadedOn {
public:
  // The next sample; its strain positive in the sense of the test.
  bool operator()(const Sample &sample, double strain);

private:
  double turn_ = -std::numeric_limits<double>::infinity(); // strain that was reached before
  double last_ = turn_;                                    // of the last sample that counts
};

// What was counted while bonds broke.
struct Emission {
  dem::CrackRose rose;
  std::vector<dem::CrackPulse> pulses;
  std::vector<dem::AcousticEvent> events; // of a finished run
  dem::BValue before, after;              // of events that began before and after the peak
  double largest_magnitude() const;       // NaN without events
  int largest_cracks() const;             // of one event
};

class Results {
public:
  // Stresses and strains are taken with this sign: +1 compression, -1 tension. Peak, moduli and strains are
  // of the deviator (stress minus confining pressure) along the axis that the test loads (0 x, 1 y, 2 z),
  // from the end of the hydrostatic stage on, as laboratories count them. Damage of the ends and cones are of
  // a specimen that is loaded along z; along another axis they are not measured. What moves with the platens
  // after the peak is followed where the test has a failure pattern.
  // A peak is the largest deviator of the samples in which the specimen is loaded on, and all that is
  // reported of it is of that sample; a fall shows there too, while the other sides are asked the same.
  explicit Results(bool tension = false, const dem::IntactRules &intact_rules = {}, int axis = 2,
                   bool measures_pattern = true)
      : sign_(tension ? -1.0 : 1.0),
        intact_rules_(intact_rules),
        axis_(axis),
        follows_motion_(measures_pattern && axis == 2) {}

  // Whether add() will measure the pattern with this sample, which needs all of the specimen; else places and
  // broken bonds are enough.
  bool falls_with(const Sample &sample) const;
  // Takes a sample in; true where it is the first below 0.8 of the peak, so that the pattern has been
  // measured.
  bool add(const Sample &sample, const coupling::PlatenTest &problem);
  void listen(const dem::Crack &crack);
  // The state at the end, and events of the cracks so far.
  void finish(const coupling::PlatenTest &problem, const dem::EventWindow &window);

  int axis() const { return axis_; }
  const std::vector<Sample> &samples() const { return samples_; }
  const Pattern &pattern() const { return at_eighty_; } // NaN where the stress did not fall that far
  const Pattern &last_pattern() const { return last_; }
  double barrel_at_peak() const { return barrel_; }
  const Emission &emission() const { return emission_; }
  // Of each sphere the platen that it has moved with since the peak: 1 bottom, 2 top, 0 neither; all 0 until
  // the stress has fallen to 0.8 of the peak. Empty where the test has no failure pattern.
  std::vector<int> moves_with(const coupling::PlatenTest &problem) const;
  // Of each broken bond, in the samples so far; followed where the test has a crack log.
  const dem::LargestOpenings &largest_openings() const { return largest_openings_; }

  // Did the deviator reach its peak while the specimen was loaded on, or only its largest value?
  PeakOfCurve peak() const;
  // The stress has fallen to this share of the peak, after it; where there are bonds, one has broken since
  // the platens began.
  bool fallen_to(double share) const;
  bool has_axial_stage() const;    // in any sample
  bool is_ever_loaded_on() const;  // in any sample
  bool goes_on_by_command() const; // samples after the peak in which it is not, or by other sides: what falls
                                   // there falls by command
  double consolidation_end() const; // s; NaN of a test that begins with its axial stage

  // Figures of the curve; NaN where the run did not get there. Stresses (Pa) positive in the sense of the
  // test.
  LargestReading largest_stress() const { return largest_of(false, 0); }  // of every sample
  LargestReading largest_deviator() const { return largest_of(true, 1); } // since the axial stage began
  const Sample *at_largest(double Sample::*value) const; // the first sample of it; null where one is NaN
  // The last sample before the wrap begins to tear; null where it does not, or none but the start is before.
  const Sample *before_tear() const;
  double stress_at_end() const;
  double strength() const;           // the stress at the peak
  double deviator_strength() const;  // there
  double confining_pressure() const; // there; without a peak at the end
  double bulk_modulus() const;       // pressure over volumetric strain at the end of the hydrostatic stage
  double at_peak(double Sample::*value) const {
    return peak_ > 0 ? samples_[peak_row_].*value : not_measured;
  }
  // Gained since the axial stage began, positive in the sense of the test.
  double strain_at_peak(double Sample::*strain) const;
  double time_at_peak() const { return at_peak(&Sample::time); } // s
  double axial_time_to_peak() const;                             // s, from the end of the hydrostatic stage
  std::size_t readings_to_peak() const; // of the axial stage, with that at the peak; 0 without one
  double unequal_at_peak() const;       // as in ModulusState

  // At 40 % of the strength: stress over what is gained; minus what is gained across over what is gained
  // along; pressure on a wall over axial stress.
  ModulusState modulus_state() const;
  double secant(double Sample::*strain) const;
  double bulging(double Sample::*across, double Sample::*along) const;
  double lateral_over_axial() const;

  // From a tenth of the peak stress on: largest residual over the boundary work at the peak; the same of the
  // work on platens without inertia that is not in them, 0 where there are none.
  double energy_residual_relative() const { return largest_over_work(&Sample::residual); }
  double platen_unbalanced_work_relative() const { return largest_over_work(&Sample::unbalanced_work); }
  // Pa, J for each m^3 of area and length: integral of the stress over the strain of the platens, over all
  // samples by the trapezoidal rule; where the strain goes back, work is given back.
  double work_over_strain() const;
  // J, lost in bonds since the start: by damage and yield, and when they break.
  double lost_in_bonds() const;
  // Samples from a tenth of the peak stress to the peak; none where there is no peak.
  std::vector<Sample> rise() const;

  void describe(Archive &archive);

private:
  // Samples on the ascending branch on both sides of a share of the strength, and the weight of the second.
  struct Crossing {
    bool found = false;
    std::size_t after = 0;
    double weight = 0;
  };
  Crossing ascending(double share) const;
  double at(const Crossing &crossing, double Sample::*value) const;
  double gained(const Crossing &crossing, double Sample::*value) const; // since zero()
  double unequal(const Sample &a, const Sample &b, double weight) const;
  double largest_over_work(double Sample::*value) const;
  LargestReading largest_of(bool axial_alone, double cell) const; // less so much of the cell's pressure
  double stress(const Sample &s) const { return sign_ * s.deviator(axis_); }
  const Sample &zero() const; // where the strains of the axial stage begin
  std::size_t readings_until(std::size_t row) const;
  std::size_t whole_balance_from() const; // first sample where the balance says more than noise
  bool counts(const Sample &sample, LoadedOn &loaded_on) const;
  bool falls_in(const Sample &sample) const; // a fall in it is of the stress at the peak
  void count_anew();
  bool has_fallen() const { return peak_ > 0 && measured_for_ == peak_; }
  Pattern measure_pattern(const coupling::PlatenTest &problem) const;

  double sign_;
  dem::IntactRules intact_rules_;
  int axis_;
  bool follows_motion_;
  StateAtPeak state_at_peak_;
  dem::LargestOpenings largest_openings_;
  std::vector<Sample> samples_;
  LoadedOn loaded_on_;
  std::vector<char> counts_; // of each sample
  std::size_t peak_row_ = 0;
  Pattern at_eighty_, last_;
  Emission emission_;
  double barrel_ = not_measured, peak_ = 0; // 1, Pa
  double measured_for_ = -1;                // the peak that at_eighty_ belongs to, Pa
};

} // namespace platen::apps
