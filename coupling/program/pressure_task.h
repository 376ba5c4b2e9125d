// The pressure of a cell on the lateral surface: held, raised, led along a stress path or as a share of a
// stress.
#pragma once

#include <optional>
#include <string>

#include "coupling/program/task.h"

namespace platen::coupling {

// From the pressure that the stage finds to the asked one, smoothly within the ramp.
class PressureTask : public Task {
public:
  struct Parameters {
    std::size_t place = 0;             // of the boundary that presses
    std::string quantity = "pressure"; // in words; "share of axial", "stress path"
    double value = 0;                  // Pa; 1 of `followed`
    double ramp = 0;                   // s
    // 1, what it gains at once, without a ramp, per deviator; -1/3: constant mean stress. A pressure that is
    // found at another value was on its way along the path.
    double path = 0;
    std::optional<PlatensOfAxis> followed; // whose stress it is a share of; none: a pressure
    // s, over which a deviator or a stress is smoothed, > 0 where it follows one. What grows steadily is
    // followed without a lag: smoothed twice, f and g, the estimate is 2 f - g.
    double lag = 0;
  };
  // Throws std::invalid_argument where the parameters are none.
  explicit PressureTask(const Parameters &parameters);

  void begin(const Measures &m, double begun, const Transfer &from) override;
  void command(const Measures &m, Commands &asked) override;
  void update(const Measures &m) override;
  bool has_settled(const Measures &m) const override { return m.time() - begun_ >= parameters_.ramp; }
  // What acts on the lateral surface. None of a pressure is a hundredth of what the stage found.
  std::optional<Controlled> controlled(const Measures &m) const override;
  void describe(Archive &archive) override;

private:
  Parameters parameters_;
  double begun_ = 0, found_ = 0;                   // s, Pa
  double deviator_ = 0, followed_ = 0;             // Pa, smoothed
  double deviator_again_ = 0, followed_again_ = 0; // Pa, smoothed again
};

// Holds what the stage finds.
class HoldPressureTask : public Task {
public:
  explicit HoldPressureTask(std::size_t place) : place_(place) {}
  void begin(const Measures &, double, const Transfer &from) override {
    found_ = from.asked.empty() ? 0.0 : from.asked.at(place_).pressure;
  }
  void command(const Measures &, Commands &asked) override { asked[place_].pressure = found_; }
  std::optional<Controlled> controlled(const Measures &m) const override;
  void describe(Archive &archive) override {
    archive.version(1);
    archive("found", found_, "Pa");
  }

private:
  std::size_t place_;
  double found_ = 0; // Pa
};

} // namespace platen::coupling
