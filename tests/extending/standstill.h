// A loading stage for the test of docs/extending.md: the platens stand for a time.
#pragma once

#include <string>

#include "coupling/program/program.h"

namespace platen::coupling {

class Standstill : public Stage {
public:
  explicit Standstill(double seconds) : seconds_(seconds) {}
  std::string name() const override { return "standstill"; }
  void command(const Measures &, Commands &commands) override {
    commands[0].velocity = commands[1].velocity = {0, 0, 0};
  }
  bool has_ended(const Measures &m) const override { return m.time() - begun() >= seconds_; }
  double expected_seconds() const override { return seconds_; }
  double progress(const Measures &m) const override { return (m.time() - begun()) / seconds_; }

private:
  double seconds_; // > 0
};

} // namespace platen::coupling
