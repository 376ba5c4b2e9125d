#include "apps/output/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "base/clock.h"

namespace platen::apps {
namespace {

constexpr double redraw_interval = 0.2; // s
constexpr double plain_interval = 10;   // s
constexpr double rate_interval = 5;     // s; shorter spans make the rate flicker
constexpr int bar_width = 20;

} // namespace

std::string with_prefix(double value, const char *unit) {
  static constexpr const char *prefixes[] = {"n", "u", "m", "", "k", "M", "G"};
  constexpr int unity = 3, last = 6;
  int k = unity;
  double scaled = std::abs(value);
  // 999.5 is where three digits would round up to the next prefix.
  for (; scaled >= 999.5 && k < last; ++k)
    scaled /= 1000;
  for (; scaled > 0 && scaled < 0.9995 && k > 0; --k)
    scaled *= 1000;
  return fmt::format("{:.3g} {}{}", std::copysign(scaled, value), prefixes[k], unit);
}

std::string duration_text(double seconds) {
  const auto total = static_cast<long long>(std::llround(std::min(std::max(seconds, 0.0), 3.6e9)));
  if (total < 60) return fmt::format("{} s", total);
  if (total < 3600) return fmt::format("{} min {:02} s", total / 60, total % 60);
  return fmt::format("{} h {:02} min", total / 3600, total / 60 % 60);
}

ProgressScreen standard_screen() {
  ProgressScreen screen;
  screen.stream = &std::cerr;
  screen.clock = [] { return seconds_since(Clock::time_point{}); };
  const char *terminal = std::getenv("TERM"), *no_colour = std::getenv("NO_COLOR");
  screen.redraws = ::isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string(terminal) != "dumb";
  screen.colour = screen.redraws && (no_colour == nullptr || *no_colour == '\0');
  struct winsize size {};
  if (screen.redraws && ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    screen.columns = size.ws_col;
  return screen;
}

Progress::Progress(RunLog &log, ProgressScreen screen) : log_(log), screen_(std::move(screen)) {
  log_.before_printing([this] { clear(); });
}

Progress::~Progress() {
  log_.before_printing({});
  clear();
}

bool Progress::due() const {
  if (!started_) return true;
  const double now = screen_.clock();
  return redraw_due(now) || now - last_plain_ >= plain_interval;
}

bool Progress::redraw_due(double now) const {
  return screen_.redraws && log_.loudness() != Loudness::quiet && now - last_drawn_ >= redraw_interval;
}

void Progress::update(const ProgressSample &sample) {
  const double now = screen_.clock();
  if (!started_) {
    started_ = true;
    start_clock_ = last_plain_ = now;
    last_drawn_ = now - redraw_interval;
    start_fraction_ = sample.fraction;
    older_ = newer_ = {now, sample.step};
  }
  if (now - newer_.clock >= rate_interval) {
    older_ = newer_;
    newer_ = {now, sample.step};
  }
  if (redraw_due(now)) {
    draw(sample, now);
    last_drawn_ = now;
  }
  if (now - last_plain_ >= plain_interval) {
    show(sample, now);
    last_plain_ = now;
  }
}

void Progress::finish(const ProgressSample &sample) {
  clear();
  if (started_) show(sample, screen_.clock());
}

// The plain line: into the log, and onto a screen that does not redraw (on one that does, finish() leaves it
// there).
void Progress::show(const ProgressSample &sample, double now) {
  const std::string line = plain_line(sample, now);
  log_.record(line);
  if (log_.loudness() == Loudness::quiet || drawn_) return;
  *screen_.stream << line << std::endl;
}

std::string Progress::plain_line(const ProgressSample &sample, double now) const {
  std::string line = fmt::format("{:5.1f} %", 100 * sample.fraction);
  if (!std::isnan(sample.time)) line += "  time " + with_prefix(sample.time, "s");
  if (!std::isnan(sample.strain)) line += fmt::format("  strain {:.4f} %", 100 * sample.strain);
  if (!std::isnan(sample.stress)) line += "  stress " + with_prefix(sample.stress, "Pa");
  if (sample.broken_bonds >= 0) line += fmt::format("  broken {}", sample.broken_bonds);
  if (now > older_.clock && sample.step > older_.step)
    line += fmt::format("  {:.3g} steps/s",
                        static_cast<double>(sample.step - older_.step) / (now - older_.clock));
  const double gained = sample.fraction - start_fraction_;
  if (gained > 0 && sample.fraction < 1)
    line += "  left " + duration_text((now - start_clock_) * (1 - sample.fraction) / gained);
  return line;
}

void Progress::draw(const ProgressSample &sample, double now) {
  const double done = std::min(std::max(sample.fraction, 0.0), 1.0);
  const int filled = static_cast<int>(done * bar_width);
  std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                    std::string(static_cast<std::size_t>(bar_width - filled), '-');
  std::string text = plain_line(sample, now);
  // One column stays free: terminals break the line when the last one is written.
  const std::size_t room = static_cast<std::size_t>(std::max(screen_.columns - 1, 1));
  if (room < bar.size() + 10)
    bar.clear();
  else
    text = " " + text;
  text.resize(std::min(text.size(), room - bar.size()));
  if (screen_.colour && !bar.empty()) bar = "\033[36m" + bar + "\033[0m"; // cyan
  *screen_.stream << '\r' << bar << text << "\033[K" << std::flush;
  drawn_ = true;
}

void Progress::clear() {
  if (drawn_) *screen_.stream << "\r\033[K" << std::flush;
  drawn_ = false;
}

} // namespace platen::apps
