// N + M steps against N steps, a checkpoint in its file, and M steps of a test made from that file: the same
// bytes of all that a checkpoint holds.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "apps/output/checkpoint_folder.h"
#include "apps/run/run_state.h"
#include "base/parallel.h"
#include "dem/packing/advancing_front.h"
#include "tests/apps/scratch_folder.h"
#include "tests/measured.h"

namespace platen::apps {

// Filled with some hundred spheres.
inline dem::Specimen coarse_specimen(const dem::Shape &shape) {
  return dem::advancing_front(shape, {dem::RadiusDistribution::Kind::uniform, 0.7e-3, 1e-3}, 5);
}
inline const dem::Specimen &coarse_cylinder() {
  static const dem::Specimen s = coarse_specimen(dem::cylinder(4e-3, 9e-3));
  return s;
}

inline void advance_to(coupling::PlatenTest &test, long steps) {
  while (test.steps() < steps) {
    test.advance(steps - test.steps());
    test.model.take_cracks();
  }
}

struct Stop {
  long at = 0, after = 300; // steps, N and M
  std::string what;         // of a failure's message
  std::function<void(const coupling::PlatenTest &)> expect = [](const coupling::PlatenTest &) {};
};

class RestartFolder : public testing::ScratchFolder {
protected:
  // All that a checkpoint holds, as its file has it.
  std::string bytes_of(const coupling::PlatenTest &test) {
    return testing::content_of(
        write_checkpoint(folder_, static_cast<std::uint64_t>(test.steps()),
                         [&](StateSink &to) { save_state(to, test, Results(false), FileMarks{}); }));
  }
  // On `first` threads until the stop, then, from the file, on each of `then`. Returns how many differ.
  int different(const dem::Specimen &specimen, const coupling::PlatenTestSettings &settings, const Stop &stop,
                int first, const std::vector<int> &then) {
    std::string expected, stopped;
    {
      const ThreadLimit threads(first);
      coupling::PlatenTest whole(specimen, settings);
      advance_to(whole, stop.at);
      stop.expect(whole);
      stopped = bytes_of(whole);
      advance_to(whole, stop.at + stop.after);
      expected = bytes_of(whole);
      EXPECT_NE(expected, stopped);
    }
    int count = 0;
    for (const int next : then) {
      const ThreadLimit threads(next);
      const std::filesystem::path file = folder_ / "stopped.platen";
      testing::put(file, stopped);
      coupling::PlatenTest resumed(specimen, settings);
      Results results(false);
      load_state(CheckpointReader(file), resumed, results);
      advance_to(resumed, stop.at + stop.after);
      const bool same = bytes_of(resumed) == expected;
      EXPECT_TRUE(same) << stop.what << ", stopped at step " << stop.at << ", threads " << first << " then "
                        << next;
      count += !same;
    }
    return count;
  }
};

inline void note_states(int states, int different) {
  measured::note_figure(1, "states_compared", states, "any");
  measured::note_figure(1, "states_that_differ", different, "none");
}

} // namespace platen::apps
