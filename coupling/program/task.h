// What one side of a specimen, or two opposite ones, are asked during a loading stage.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "base/archive.h"
#include "coupling/program/program.h"

namespace platen::coupling {

// One platen, or two opposite ones that move alike, by their places in the experiment's list.
struct PlatensOfAxis {
  std::vector<std::size_t> places;
  double area = 0;   // m^2, of the specimen's face at each
  double length = 0; // m, of the specimen between two opposite faces
  int axis = 2;      // 0 x, 1 y, 2 z

  double stress(const Measures &m) const;                       // Pa, mean, compression positive
  double closure(const Measures &m) const;                      // m, of all of them together
  double speed(const Measures &m, const Commands &asked) const; // m/s, mean, inward positive; 0 where none is
  void move(const Measures &m, double inward, Commands &asked) const; // m/s, each
};

inline double start_of_ramp(double passed, double ramp) {
  return ramp > 0 ? smooth_start(passed / ramp) : 1.0;
}

// A number that follows another with a lag (s), by a step dt (s).
inline void follow(double &smoothed, double now, double dt, double lag) {
  smoothed += std::min(1.0, dt / lag) * (now - smoothed);
}

class Task {
public:
  virtual ~Task() = default;
  // Once, when its stage begins, `begun` in s.
  virtual void begin(const Measures &m, double begun, const Transfer &from) = 0;
  // Of a step whose particles have drifted, before forces. Finds commands that ask for nothing.
  virtual void command(const Measures &m, Commands &asked) = 0;
  // After forces.
  virtual void update(const Measures &) {}
  // The specimen bears what is asked.
  virtual bool has_settled(const Measures &) const { return true; }
  // What it asks of its side in the end and what is reached now; none of what is only held in its place.
  virtual std::optional<Controlled> controlled(const Measures &) const { return std::nullopt; }
  virtual double fastest() const { return 0; } // m/s, closure speed that it may ask for
  // Whether it loads its axis on; sense: 1 in compression, -1 in tension.
  virtual Loads loads(double /*sense*/) const { return Loads::none; }
  virtual void describe(Archive &archive) = 0;
};

// Brings platens to rest within `ramp` (s), from the speed that they are found at.
class HoldTask : public Task {
public:
  HoldTask(PlatensOfAxis platens, double ramp) : platens_(std::move(platens)), ramp_(ramp) {}
  void begin(const Measures &m, double begun, const Transfer &from) override;
  void command(const Measures &m, Commands &asked) override;
  void describe(Archive &archive) override;

private:
  PlatensOfAxis platens_;
  double ramp_;
  double begun_ = 0, speed_found_ = 0; // s, m/s
};

} // namespace platen::coupling
