// Axial platens that are led by how fast the specimen widens, as a brittle specimen is followed through its
// fall in a stiff, quick machine: where it would run away the platens part (class II, Wawersik and Fairhurst
// 1970).
#pragma once

#include "coupling/program/task.h"

namespace platen::coupling {

// The circumferential strain asked rises from what the stage finds at `rate`, smoothly within the ramp. The
// platens close at  v = L (rate + e / tau) / g,  e what is asked less what is measured, tau some wave
// transits, and g the circumferential over the axial strain of an elastic specimen; between -fastest and
// fastest.
class CircumferentialTask : public Task {
public:
  struct Parameters {
    PlatensOfAxis platens;
    double rate = 0;    // 1/s, > 0
    double ramp = 0;    // s
    double transit = 0; // s, of a wave over the specimen, > 0
    double fastest = 0; // m/s, closure speed, > 0
  };
  // Throws std::invalid_argument where the parameters are none.
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
