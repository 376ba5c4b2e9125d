// A loading stage: what is prescribed on each side, and when the stage ends.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "coupling/program/stage_end.h"
#include "coupling/program/task.h"

namespace platen::coupling {

class LoadingStage : public Stage {
public:
  struct Parameters {
    std::string name;
    bool consolidates = false; // all sides alike, before the axial loading: strains count from its end
    double expected_seconds = 0;
    double sense = 1;                      // of the test: 1 compression, -1 tension
    std::vector<std::size_t> loading = {}; // tasks that prescribe something along the loaded axis
    bool parts = false;                    // platens open at a rate, on any side
    bool changes_sides = false;            // other sides change to another stress or pressure within the ramp
    int setting = 0;                       // number of changes on other sides, this one included
  };
  LoadingStage(Parameters parameters, std::vector<std::unique_ptr<Task>> tasks, StageEnd end);

  std::string name() const override { return parameters_.name; }
  void command(const Measures &m, Commands &commands) override;
  void update(const Measures &m) override;
  bool has_ended(const Measures &m) const override { return reached(m) != 0; }
  void end(const Measures &m) override;
  void go_on() override;
  std::string ended_by() const override;
  // Where the stage ended by a stress of a side, that stress is the prescribed one.
  std::vector<Controlled> controls(const Measures &m) const override;
  double expected_seconds() const override { return parameters_.expected_seconds; }
  double progress(const Measures &m) const override;
  double fastest() const override;
  bool is_consolidation() const override { return parameters_.consolidates; }
  Loads loads(const Measures &m) const override;
  int setting() const override { return parameters_.setting; }
  void describe(Archive &archive) override;

protected:
  void on_begin(const Measures &m, const Transfer &from) override;

private:
  struct AtEnd { // of a task, as in Controlled
    bool reported = false;
    double target = 0, reached = 0, reference = 0;
    void describe(Archive &archive);
  };
  int reached(const Measures &m) const; // as StageEnd::reached
  void forget_end();

  Parameters parameters_;
  std::vector<std::unique_ptr<Task>> tasks_;
  StageEnd end_;
  std::vector<AtEnd> at_end_;
  int ended_by_ = 0; // as StageEnd::reached; 0: it continues, or an old checkpoint without this value
};

} // namespace platen::coupling
