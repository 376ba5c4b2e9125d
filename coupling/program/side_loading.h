// A loading stage by sides: platens close at a rate, hold a stress by their servo, follow a share of what
// another side bears, or stand still.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "coupling/program/platen_speed.h"
#include "coupling/program/program.h"

namespace platen::coupling {

// One platen, or two opposite ones that move alike, by their places in the experiment's list.
struct PlatensOfAxis {
  std::vector<std::size_t> places;
  double area = 0;   // m^2, of the specimen's face at each
  double length = 0; // m, of the specimen between two opposite faces

  double stress(const Measures &m) const;  // Pa, mean, compression positive
  double closure(const Measures &m) const; // over the length, since the start of the test
};

struct SideTask {
  enum class Ask { hold, rate, stress, share };
  PlatensOfAxis platens;
  Ask ask = Ask::hold;
  double value = 0; // m/s, closure of all of them; Pa; 1, of the stress of `followed`
  PlatensOfAxis followed;
  Servo::Parameters servo; // of a stress
};

// Over when any of what is given is reached.
struct StageEnd {
  PlatensOfAxis of;                                        // that strain and stress are measured at
  double strain = std::numeric_limits<double>::infinity(); // closure since the stage began, of either sign
  std::optional<double> rises_to, falls_to;                // Pa
  double seconds = std::numeric_limits<double>::infinity();
  bool settled = false; // each platen bears what is asked of it within 1 %, after the ramp
};

class SideLoading : public Stage {
public:
  struct Parameters {
    std::string name;
    std::vector<SideTask> tasks; // a platen stands in at most one
    double ramp = 0;             // s, from what a task finds to what it asks, > 0
    // s: a servo is told what will be asked in so long, so that the stress keeps up; and how slowly a share
    // follows, > 0.
    double lead = 0, lag = 0;
    StageEnd end;
  };
  // Throws std::invalid_argument where the parameters are no stage.
  explicit SideLoading(Parameters parameters);

  std::string name() const override { return parameters_.name; }
  void command(const Measures &m, Commands &asked) override;
  void update(const Measures &m) override;
  bool has_ended(const Measures &m) const override;
  double expected_seconds() const override;
  double progress(const Measures &m) const override;
  double fastest() const override;
  void describe(Archive &archive) override;

private:
  struct Doing { // what a task keeps from step to step
    std::optional<Servo> servo;
    double stress_found = 0; // Pa, when the stage began
    double followed = 0;     // Pa, smoothed
    void describe(Archive &archive);
  };
  double wanted_stress(const SideTask &task, const Doing &now, const Measures &m) const;
  double speed(const SideTask &task, Doing &now, const Measures &m);
  void find_start(const Measures &m);

  Parameters parameters_;
  std::vector<Doing> doing_;
  bool started_ = false;
  double closure_found_ = 0; // 1, of the end's platens when the stage began
};

} // namespace platen::coupling
