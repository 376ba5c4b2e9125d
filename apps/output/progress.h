// How far a run is: one line that redraws on a terminal, a plain line every ten seconds elsewhere.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <limits>
#include <string>

#include "apps/output/run_log.h"

namespace platen::apps {

// Where the run stands. NaN, and a negative count: not known, left out of the line.
struct ProgressSample {
  double fraction = 0; // done, 0 ... 1
  std::uint64_t step = 0;
  double time = std::numeric_limits<double>::quiet_NaN();   // s, simulated
  double strain = std::numeric_limits<double>::quiet_NaN(); // axial, positive in compression
  double stress = std::numeric_limits<double>::quiet_NaN(); // Pa, positive in compression
  long long broken_bonds = -1;
};

// Where progress is shown. standard_screen() asks standard error, TERM and NO_COLOR.
struct ProgressScreen {
  std::ostream *stream = nullptr;
  bool redraws = false; // a terminal
  bool colour = false;
  int columns = 80;              // of the terminal; longer lines are cut
  std::function<double()> clock; // s, monotonic
};
ProgressScreen standard_screen();

// Nothing is shown where the log is quiet; run.log gets a plain line every ten seconds all the same. The log
// must outlive the progress.
class Progress {
public:
  explicit Progress(RunLog &log, ProgressScreen screen = standard_screen());
  ~Progress(); // takes the line off the screen
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  // Whether update() would show anything: so that a run need not measure what no one sees.
  bool due() const;
  // Shows the sample where it is time to; the first call only starts the clock of what is left.
  void update(const ProgressSample &sample);
  // Shows the last state for good.
  void finish(const ProgressSample &sample);

private:
  struct Mark {
    double clock = 0;
    std::uint64_t step = 0;
  };
  bool redraw_due(double now) const;
  void show(const ProgressSample &sample, double now);
  std::string plain_line(const ProgressSample &sample, double now) const;
  void draw(const ProgressSample &sample, double now);
  void clear();
  RunLog &log_;
  ProgressScreen screen_;
  bool started_ = false, drawn_ = false;
  Mark older_, newer_; // the rate of steps is that since the older one, five to ten seconds ago
  double start_clock_ = 0, start_fraction_ = 0, last_drawn_ = 0, last_plain_ = 0;
};

// "1.25 ms", "45.2 MPa": three significant digits with a prefix of the SI, "us" for micro.
std::string with_prefix(double value, const char *unit);
// "45 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds);

} // namespace platen::apps
