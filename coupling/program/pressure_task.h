// The pressure of a cell on the lateral surface: constant, raised, along a stress path or a fraction of a
// stress.
#pragma once

#include <optional>
#include <string>

#include "coupling/program/task.h"

namespace platen::coupling {

// From the pressure at the start of the stage to the prescribed one, smoothly within the ramp.
class PressureTask : public Task {
public:
  struct Parameters {
    std::size_t place = 0;             // index of the boundary that presses
    std::string quantity = "pressure"; // in words; "share of axial", "stress path"
    double value = 0;                  // Pa; or fraction of the stress of `followed`
    double ramp = 0;                   // s
    // 1, increase per deviator, at once, without a ramp; -1/3: constant mean stress. A pressure that differs
    // at the start of the stage is taken as already on the path.
    double path = 0;
    std::optional<PlatensOfAxis> followed; // whose stress times a fraction it is; none: a pressure
    // s, smoothing time of a deviator or a stress, > 0 where the pressure follows one. A linear increase is
    // followed without a lag: smoothed twice, f and g, the estimate is 2 f - g.
    double lag = 0;
  };
  // Throws std::invalid_argument where the parameters are not valid.
  explicit PressureTask(const Parameters &parameters);

  void begin(const Measures &m, double begun, const Transfer &from) override;
  void command(const Measures &m, Commands &commands) override;
  void update(const Measures &m) override;
  bool has_settled(const Measures &m) const override { return m.time() - begun_ >= parameters_.ramp; }
  // The pressure on the lateral surface. Zero pressure is reached within a hundredth of that at the start.
  std::optional<Controlled> controlled(const Measures &m) const override;
  void describe(Archive &archive) override;

private:
  Parameters parameters_;
  double begun_ = 0, found_ = 0;                   // s, Pa
  double deviator_ = 0, followed_ = 0;             // Pa, smoothed
  double deviator_again_ = 0, followed_again_ = 0; // Pa, smoothed again
};

// Keeps the pressure at the start of the stage.
class HoldPressureTask : public Task {
public:
  explicit HoldPressureTask(std::size_t place) : place_(place) {}
  void begin(const Measures &, double, const Transfer &from) override {
    found_ = from.commands.empty() ? 0.0 : from.commands.at(place_).pressure;
  }
  void command(const Measures &, Commands &commands) override { commands[place_].pressure = found_; }
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
