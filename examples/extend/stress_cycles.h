// A loading stage of one's own: the platens load at a rate up to a stress, unload to another, and so on,
// until the wanted number of cycles is done.
#pragma once

#include <cmath>
#include <string>

#include <coupling/program/program.h>

class StressCycles : public platen::coupling::Stage {
public:
  struct Parameters {
    double rate = 0;          // m/s, closure speed
    double high = 0, low = 0; // Pa, of the mean axial stress
    int cycles = 1;
    double height = 0, modulus = 0; // m, Pa: what is expected of its length
  };
  explicit StressCycles(const Parameters &parameters) : parameters_(parameters) {}

  std::string name() const override { return "stress cycles"; }

  void command(const platen::coupling::Measures &, platen::coupling::Commands &commands) override {
    const double speed = 0.5 * direction_ * parameters_.rate;
    commands[0].velocity = {0, 0, speed}; // the bottom platen; the top one goes the other way
    commands[1].velocity = {0, 0, -speed};
  }

  void update(const platen::coupling::Measures &m) override {
    if (direction_ > 0 && m.axial_stress() >= parameters_.high) direction_ = -1;
    if (direction_ < 0 && m.axial_stress() <= parameters_.low) {
      direction_ = 1;
      ++done_;
    }
  }

  bool has_ended(const platen::coupling::Measures &) const override { return done_ >= parameters_.cycles; }
  double progress(const platen::coupling::Measures &) const override {
    return static_cast<double>(done_) / parameters_.cycles;
  }
  double expected_seconds() const override {
    const double way = (parameters_.high - parameters_.low) / parameters_.modulus * parameters_.height;
    return 2 * parameters_.cycles * way / parameters_.rate;
  }
  double fastest() const override { return parameters_.rate; }

  void describe(platen::Archive &archive) override {
    Stage::describe(archive);
    archive("direction", direction_);
    archive("cycles_done", done_);
  }

private:
  Parameters parameters_;
  double direction_ = 1;
  int done_ = 0;
};
