// Axial platens that are controlled by how the specimen widens, as a brittle specimen is controlled through
// its failure in a stiff, fast machine: by its circumference in compression, by the opening of the mouth of
// its notch in bending. Where the failure would be unstable the platens open (class II, Wawersik and
// Fairhurst 1970; snap-back of a beam).
#pragma once

#include "coupling/program/task.h"

namespace platen::coupling {

// The prescribed widening rises from its value at the start of the stage at `rate`, smoothly within the ramp.
// The platens close at  v = c (rate + e / tau),  with e the prescribed less the measured widening, tau some
// wave transits, and c their closure for each unit of it; between -fastest and fastest.
class WideningTask : public Task {
public:
  struct Parameters {
    PlatensOfAxis platens;
    double rate = 0;    // 1/s, of a mouth m/s, > 0
    double ramp = 0;    // s
    double transit = 0; // s, in which the specimen follows the platens, > 0
    double fastest = 0; // m/s, closure speed, > 0
    Widening of = Widening::circumference;
    double closure = 0; // m/m, c of a mouth, > 0; of a circumference it follows from Poisson's ratio
  };
  // Throws std::invalid_argument where the parameters are not valid.
  explicit WideningTask(const Parameters &parameters);

  void begin(const Measures &m, double begun, const Transfer &from) override;
  void command(const Measures &m, Commands &commands) override;
  double fastest() const override { return parameters_.fastest; }
  Loads loads(double) const override { return Loads::by_widening; }
  std::optional<Controlled> controlled(const Measures &m) const override; // the mean rates of the stage
  void describe(Archive &archive) override;

private:
  double target_at(double passed) const;
  double now(const Measures &m) const { return m.widening(parameters_.of); }

  Parameters parameters_;
  double begun_ = 0, found_ = 0, speed_ = 0; // s; 1 or m; m/s
};

} // namespace platen::coupling
