// The stages of a test, one after the other.
#pragma once

#include "coupling/program/stage.h"

namespace platen::coupling {

class Program {
public:
  // Begins the first of at least one stage. `measures` outlives the program.
  Program(const Measures &measures, std::vector<std::unique_ptr<Stage>> stages);

  // For a step whose particles have drifted: what is asked of each boundary.
  void command(Commands &asked);
  // After forces: goes on to the next stage where one is over. The last one goes on asking when it is over.
  void update();

  bool finished() const { return finished_; }
  const Stage &stage() const { return *stages_[now_]; }
  double fastest() const; // m/s, closure speed of any stage
  double expected_seconds() const;
  double progress() const; // 0 ... 1, of all stages by their expected times
  // Closure strain since the end of a consolidation; all of it without one, none while it lasts.
  double axial_closure() const;
  bool in_axial_stage() const { return finished_ || !stage().is_consolidation(); }
  bool is_cycling() const { return stage().is_cycling(measures_); }
  void describe(Archive &archive);

private:
  const Measures &measures_;
  std::vector<std::unique_ptr<Stage>> stages_;
  std::size_t now_ = 0;
  bool finished_ = false;
};

} // namespace platen::coupling
