#include "apps/report/bars.h"
#include "apps/scene/regular_file.h"

#include <fmt/format.h>
#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

#include <algorithm>
#include <fstream>

#include "apps/report/canvas.h"

namespace platen::apps::report {
namespace {

// A filled rectangle; fractions of the canvas.
void add_rectangle(vtkRenderer *renderer, const Canvas &canvas, const std::array<double, 4> &x0_y0_x1_y1,
                   Colour colour) {
  const double w = oversampling * canvas.width(), h = oversampling * canvas.height();
  const auto &[x0, y0, x1, y1] = x0_y0_x1_y1;
  if (!(x1 > x0 && y1 > y0)) return; // VTK complains of a plane without area
  vtkNew<vtkPlaneSource> rectangle;
  rectangle->SetOrigin(x0 * w, y0 * h, 0);
  rectangle->SetPoint1(x1 * w, y0 * h, 0);
  rectangle->SetPoint2(x0 * w, y1 * h, 0);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputConnection(rectangle->GetOutputPort());
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
  renderer->AddActor2D(actor);
}

// The line of the run's log that names the machine; empty where there is none.
std::string machine_of(const Run &run) {
  const std::string start = "machine ";
  std::ifstream log = open_file(run.folder / "run.log");
  for (std::string line; std::getline(log, line);)
    if (line.rfind(start, 0) == 0) return line.substr(start.size());
  return "";
}

} // namespace

void save_bars(const std::string &title, const std::string &subtitle, const std::vector<Bar> &bars,
               double mark, const std::filesystem::path &png) {
  constexpr int width = 1640, row = 74, foot = 50;
  constexpr double names = 0.14, left = 0.28, right = 0.78, words = 0.88; // fractions of the width
  const int rows = row * static_cast<int>(bars.size()), height = Canvas::head_height + rows + foot;
  double most = mark;
  for (const Bar &bar : bars)
    most = std::max(most, bar.value);
  if (!(most > 0)) most = 1;
  Canvas canvas(width, height);
  vtkRenderer *renderer = canvas.add_renderer({0, 0, 1, 1});
  for (std::size_t k = 0; k < bars.size(); ++k) {
    const double middle =
        1 - (Canvas::head_height + row * (static_cast<double>(k) + 0.5)) / static_cast<double>(height);
    const double half = 0.35 * row / height, reach = left + (right - left) * bars[k].value / most;
    add_rectangle(renderer, canvas, {left, middle - half, reach, middle + half}, bars[k].colour);
    canvas.add_text(bars[k].name, names, middle, small_size, 2 * names - 0.02);
    canvas.add_text(bars[k].words, words, middle, small_size, 2 * (1 - words));
  }
  if (mark > 0) {
    const double x = left + (right - left) * mark / most, half = 0.0012;
    add_rectangle(renderer, canvas, {x - half, double(foot) / height, x + half, double(foot + rows) / height},
                  colours::black);
  }
  canvas.add_head(title, subtitle);
  canvas.save(png);
}

std::vector<Cost> costs_of(const Run &run) {
  std::vector<Cost> costs;
  const auto stages = run.summary.find("stage_seconds");
  if (stages == run.summary.end() || !stages->is_object()) return costs;
  double known = 0;
  const auto add = [&](const std::string &name, double seconds, bool is_stage) {
    if (!(seconds > 0)) return;
    costs.push_back({name, seconds, is_stage});
    known += seconds;
  };
  for (const auto &[name, seconds] : stages->items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    if (seconds.is_number()) add(words, seconds.get<double>(), true);
  }
  add("setting up", number_in(run.summary, "setup_seconds"), false);
  std::stable_sort(costs.begin(), costs.end(),
                   [](const Cost &a, const Cost &b) { return a.seconds > b.seconds; });
  add("the rest", number_in(run.summary, "wall_seconds") - known, false);
  return costs;
}

std::string machine_words(const Run &run) {
  std::vector<std::string> words;
  const auto number = [&run](const char *key) { return number_in(run.summary, key); };
  if (const double rate = number("particle_steps_per_second"); rate > 0)
    words.push_back(fmt::format("{:.2f} million sphere steps a second", 1e-6 * rate));
  if (const double threads = number("threads"); threads > 0)
    words.push_back(fmt::format("{:.0f} thread{}", threads, threads == 1 ? "" : "s"));
  if (const std::string machine = machine_of(run); !machine.empty()) words.push_back(machine);
  if (const double bytes = number("peak_memory_bytes"); bytes > 0)
    words.push_back(fmt::format("{:.0f} MB at most", 1e-6 * bytes));
  return fmt::format("{}", fmt::join(words, "; "));
}

void draw_costs(const Run &run, const std::filesystem::path &png) {
  const std::vector<Cost> costs = costs_of(run);
  double whole = 0;
  for (const Cost &cost : costs)
    whole += cost.seconds;
  std::vector<Bar> bars;
  for (const Cost &cost : costs)
    bars.push_back({cost.name, fmt::format("{:.2f} s   {:.1f} %", cost.seconds, 100 * cost.seconds / whole),
                    cost.seconds, cost.is_stage ? colours::blue : colours::grey});
  save_bars(run.title, fmt::format("Where {:.1f} seconds went; blue: stages of the steps", whole), bars, 0,
            png);
}

bool tells_rose(const Run &run) {
  const auto rose = run.summary.find("crack_rose");
  return rose != run.summary.end() && rose->is_array() && !rose->empty() && rose->front().is_number();
}

void draw_crack_rose(const Run &run, const std::filesystem::path &png) {
  const std::vector<double> rose = run.summary["crack_rose"];
  const double step = 90.0 / static_cast<double>(rose.size());
  std::vector<Bar> bars;
  for (std::size_t k = 0; k < rose.size(); ++k) {
    const double from = step * static_cast<double>(k);
    const char *which = k == 0 ? "   across" : k + 1 == rose.size() ? "   along" : "";
    bars.push_back({fmt::format("{:.0f} to {:.0f}\xC2\xB0", from, step * static_cast<double>(k + 1)),
                    fmt::format("{:.2f}{}", rose[k], which), rose[k], colours::vermilion});
  }
  save_bars(run.title, "Area of cracks by angle of normal to axis; line: all ways alike", bars, 1, png);
}

} // namespace platen::apps::report
