#include "apps/report/friction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/report/chart.h"

namespace platen::apps::report {
namespace {

constexpr double ms_per_s = 1e3;

std::string capital(std::string name) {
  name.front() = static_cast<char>(std::toupper(name.front()));
  return name;
}

// A curve of each platen over the times of the frames.
struct FrictionCurves {
  std::vector<double> sliding_share, mobilised, slip;
};

FrictionCurves curves_of(const Run &run, Side side) {
  FrictionCurves curves;
  for (const Frame &frame : run.contacts) {
    const FrictionState state = friction_state(contacts_with(side, frame));
    curves.sliding_share.push_back(state.sliding_share);
    curves.mobilised.push_back(state.mobilised);
    curves.slip.push_back(state.slip * mm_per_m);
  }
  return curves;
}

std::vector<Span> spans_of(const Run &run) {
  const std::vector<double> &time = run.history.column("time_s");
  std::vector<Span> spans;
  if (run.zero > 0) spans.push_back({time.front() * ms_per_s, time[run.zero] * ms_per_s, "consolidation"});
  spans.push_back({time[run.zero] * ms_per_s, run.moments.peak_time * ms_per_s, "to the peak"});
  if (run.moments.end_time > run.moments.peak_time)
    spans.push_back({run.moments.peak_time * ms_per_s, run.moments.end_time * ms_per_s, "after it"});
  return spans;
}

// Dashed lines: what the friction of a platen cannot exceed. Platens of the same coefficient share one.
void add_limits(Chart &chart, const Run &run, const std::vector<Side> &sides, double end) {
  std::vector<double> drawn;
  const auto add = [&](double limit, const std::string &words) {
    if (std::isnan(limit) || std::find(drawn.begin(), drawn.end(), limit) != drawn.end()) return;
    drawn.push_back(limit);
    chart.curves.push_back(
        {fmt::format("{} {:.3g}", words, limit), {0, end}, {limit, limit}, colours::grey, Stroke::dashed, 3});
  };
  for (const Side side : sides) {
    const FrictionLimits limits = friction_limits(run, side);
    add(limits.at_rest, "limit, static");
    add(limits.sliding, "limit, sliding");
  }
}

void add_work(Chart &chart, const Run &run, const std::vector<Side> &sides) {
  const std::vector<double> time = scaled(run.history.column("time_s"), ms_per_s);
  for (const Side side : sides)
    if (const std::string name = std::string("friction_work_") + coupling::name_of(side) + "_j";
        run.history.has(name))
      chart.curves.push_back(
          {coupling::name_of(side), time, run.history.column(name), side_colour(side), side_stroke(side), 4});
  if (run.history.has("friction_work_j"))
    chart.curves.push_back({"platens and grains", time, run.history.column("friction_work_j"), colours::black,
                            Stroke::solid, 3});
}

} // namespace

FrictionState friction_state(const PlatenContacts &contacts) {
  double pressing = 0, friction = 0, slip = 0, sliding = 0;
  for (const PlatenContact &one : contacts) {
    pressing += one.normal_force;
    friction += one.shear_force;
    slip += one.slip * one.normal_force;
    sliding += one.sliding ? 1 : 0;
  }
  if (!(pressing > 0)) return {std::nan(""), std::nan(""), std::nan("")};
  return {sliding / static_cast<double>(contacts.size()), friction / pressing, slip / pressing};
}

FrictionLimits friction_limits(const Run &run, Side side) {
  const auto entry = [&](const std::string &key) {
    const double own =
        number_of_scene(run.folder, "Platens/" + capital(coupling::name_of(side)) + "/" + key, "1");
    return std::isnan(own) ? number_of_scene(run.folder, "Platens/" + key, "1") : own;
  };
  const double at_rest = entry("Friction static"), sliding = entry("Friction dynamic");
  return {at_rest, std::isnan(sliding) ? at_rest : sliding};
}

bool is_glued(const Run &run) {
  const std::filesystem::path scene = run.folder / "scene.prm";
  return std::filesystem::exists(scene) && scene_entry(scene, "Platens/Attachment") == "glued";
}

bool tells_friction(const Run &run) {
  if (is_glued(run)) return false;
  return std::any_of(run.contacts.begin(), run.contacts.end(), [&](const Frame &frame) {
    return !std::isnan(friction_state(contacts_with(Side::bottom, frame)).mobilised) ||
           !std::isnan(friction_state(contacts_with(Side::top, frame)).mobilised);
  });
}

void draw_friction(const Run &run, const std::filesystem::path &png) {
  const std::vector<Side> sides = sides_of(run);
  Chart share, mobilised, slip, work;
  std::vector<double> times;
  for (const Frame &frame : run.contacts)
    times.push_back(frame.time * ms_per_s);
  for (const Side side : sides) {
    const FrictionCurves curves = curves_of(run, side);
    const auto add = [&](Chart &chart, const std::vector<double> &values) {
      chart.curves.push_back(
          {coupling::name_of(side), times, values, side_colour(side), side_stroke(side), 4});
    };
    add(share, curves.sliding_share);
    add(mobilised, curves.mobilised);
    add(slip, curves.slip);
  }
  add_limits(mobilised, run, sides, times.back());
  add_work(work, run, sides);
  share.y_title = "Share that slides";
  share.y_range = {0, 1};
  mobilised.y_title = "Friction over pressure";
  slip.y_title = "Slip (mm)";
  work.y_title = "Work of friction (J)";
  std::vector<Chart> charts{share, mobilised, slip, work};
  for (Chart &chart : charts) {
    chart.x_title = "Time (ms)";
    chart.x_range = {0, run.moments.end_time * ms_per_s};
    chart.spans = spans_of(run);
  }
  for (Span &span : charts.front().spans)
    span.words.clear(); // the head of the picture is there
  save_charts(run.title, "Friction between the specimen and its platens", charts, {400, 520, 400, 400}, png);
}

} // namespace platen::apps::report
