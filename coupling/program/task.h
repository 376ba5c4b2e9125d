// What is prescribed on one side of a specimen, or on two opposite sides, during a loading stage.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "base/archive.h"
#include "coupling/program/program.h"

namespace platen::coupling {

// One platen, or two opposite ones that move alike, by their indices in the experiment's list.
struct PlatensOfAxis {
  std::vector<std::size_t> places;
  double area = 0;   // m^2, of the specimen's face at each
  double length = 0; // m, of the specimen between two opposite faces
  int axis = 2;      // 0 x, 1 y, 2 z

  double stress(const Measures &m) const;                                // Pa, mean, compression positive
  double closure(const Measures &m) const;                               // m, sum over all of them
  double speed(const Measures &m, const Commands &commands) const;       // m/s, mean, inward positive; else 0
  void move(const Measures &m, double inward, Commands &commands) const; // m/s, each
};

inline double start_of_ramp(double passed, double ramp) {
  return ramp > 0 ? smooth_start(passed / ramp) : 1.0;
}

// First-order lag (s) of a number behind another, by a step dt (s).
inline void follow(double &smoothed, double now, double dt, double lag) {
  smoothed += std::min(1.0, dt / lag) * (now - smoothed);
}

class Task {
public:
  virtual ~Task() = default;
  // Called once, when its stage begins, `begun` in s.
  virtual void begin(const Measures &m, double begun, const Transfer &from) = 0;
  // Called after the drift of the particles, before forces. All commands are zero on entry.
  virtual void command(const Measures &m, Commands &commands) = 0;
  // After forces.
  virtual void update(const Measures &) {}
  // Whether the specimen carries what is prescribed.
  virtual bool has_settled(const Measures &) const { return true; }
  // The final prescribed value of its side and the present one; none where the side only keeps its position.
  virtual std::optional<Controlled> controlled(const Measures &) const { return std::nullopt; }
  virtual double fastest() const { return 0; } // m/s, largest closure speed that it may command
  // Whether it increases the load on its axis; sense: 1 in compression, -1 in tension.
  virtual Loads loads(double /*sense*/) const { return Loads::none; }
  virtual void describe(Archive &archive) = 0;
};

// Brings platens to rest within `ramp` (s), from their speed at the start of the stage.
class HoldTask : public Task {
public:
  HoldTask(PlatensOfAxis platens, double ramp) : platens_(std::move(platens)), ramp_(ramp) {}
  void begin(const Measures &m, double begun, const Transfer &from) override;
  void command(const Measures &m, Commands &commands) override;
  void describe(Archive &archive) override;

private:
  PlatensOfAxis platens_;
  double ramp_;
  double begun_ = 0, speed_found_ = 0; // s, m/s
};

} // namespace platen::coupling
