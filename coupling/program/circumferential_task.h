// Axial platens that are controlled by the circumferential strain rate, as a brittle specimen is controlled
// through its failure in a stiff, fast machine: where the failure would be unstable the platens open (class
// II, Wawersik and Fairhurst 1970).
#pragma once

#include "coupling/program/task.h"

namespace platen::coupling {

// The prescribed circumferential strain rises from its value at the start of the stage at `rate`, smoothly
// within the ramp. The platens close at  v = L (rate + e / tau) / g,  with e the prescribed less the measured
// strain, tau some wave transits, and g the circumferential over the axial strain of an elastic specimen;
// between -fastest and fastest.
class CircumferentialTask : public Task {
public:
  struct Parameters {
    PlatensOfAxis platens;
    double rate = 0;    // 1/s, > 0
    double ramp = 0;    // s
    double transit = 0; // s, of a wave over the specimen, > 0
    double fastest = 0; // m/s, closure speed, > 0
  };
  // Throws std::invalid_argument where the parameters are not valid.
  explicit CircumferentialTask(const Parameters &parameters);

  void begin(const Measures &m, double begun, const Transfer &from) override;
  void command(const Measures &m, Commands &asked) override;
  double fastest() const override { return parameters_.fastest; }
  Loads loads(double) const override { return Loads::by_widening; }
  std::optional<Controlled> controlled(const Measures &m) const override; // the mean rates of the stage
  void describe(Archive &archive) override;

private:
  double strain_asked(double passed) const;

  Parameters parameters_;
  double begun_ = 0, strain_found_ = 0, speed_ = 0; // s, 1, m/s
};

} // namespace platen::coupling
