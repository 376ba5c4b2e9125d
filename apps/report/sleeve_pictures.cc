// The sleeve beside the half specimen, and unrolled.
#include <fmt/format.h>
#include <vtkChartXY.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

#include "apps/report/chart.h"
#include "apps/report/sleeve.h"
#include "apps/report/specimen_view.h"

namespace platen::apps::report {
namespace {

struct Moment {
  double time; // s
  std::string words;
};

double zero_time(const Run &run) {
  return run.history.column("time_s")[run.zero];
}

// Angle, m along the inner face and m along z of a corner as it was before the test.
struct Unrolled {
  double turn, z;
};

Unrolled unrolled(const Position &place) {
  return {std::atan2(place[1], place[0]), place[2]};
}

// The inner face unrolled, a pixel a degree around and a hundredth of the height along, in mm.
vtkSmartPointer<vtkImageData> unrolled_image(const SleeveFaces &faces, const std::vector<double> &values,
                                             double low, double high) {
  constexpr int columns = 360, rows = 100;
  double bottom = INFINITY, top = -INFINITY, radius = INFINITY;
  for (const Position &place : faces.initial) {
    bottom = std::min(bottom, place[2]), top = std::max(top, place[2]);
    radius = std::min(radius, std::hypot(place[0], place[1]));
  }
  vtkNew<vtkDoubleArray> pixels;
  pixels->SetName("value");
  pixels->SetNumberOfTuples(columns * rows);
  pixels->FillValue(std::nan(""));
  for (std::size_t k = 0; k < faces.inner.size(); ++k) {
    const auto &face = faces.inner[k];
    const Unrolled first = unrolled(faces.initial[static_cast<std::size_t>(face[0])]),
                   last = unrolled(faces.initial[static_cast<std::size_t>(face[2])]);
    const double width = std::remainder(last.turn - first.turn, 2 * pi); // around, the shorter way
    const auto row = [&](double z) {
      return static_cast<int>(std::ceil((z - bottom) / (top - bottom) * rows - 0.5));
    };
    const auto column = [](double turn) {
      return static_cast<int>(std::ceil((turn + pi) / (2 * pi) * columns - 0.5));
    };
    for (int r = row(first.z); r < std::min(rows, row(last.z)); ++r)
      for (int c = column(first.turn); c < column(first.turn + width); ++c)
        pixels->SetValue(r * columns + (c + columns) % columns, std::clamp(values[k], low, high));
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, 1);
  image->SetOrigin(-pi * radius * mm_per_m, bottom * mm_per_m, 0);
  image->SetSpacing(2 * pi * radius / columns * mm_per_m, (top - bottom) / rows * mm_per_m, 1);
  image->GetPointData()->SetScalars(pixels);
  return image;
}

struct Map {
  std::string bar;
  double factor;
  std::vector<double> SleeveState::*values;
};

const std::array<Map, 3> maps{{{"Stretch\naround\n(%)", 100, &SleeveState::around},
                               {"Pressure\nof the\nspheres\n(MPa)", 1 / pa_per_mpa, &SleeveState::pressure},
                               {"Slip of\nthe spheres\n(mm)", mm_per_m, &SleeveState::slip}}};

// Round ends that hold all values of all states but the outer 2 %, and zero.
std::vector<double> ticks_of(const std::vector<SleeveState> &states, const Map &map) {
  std::vector<double> all;
  for (const SleeveState &state : states)
    all.insert(all.end(), (state.*map.values).begin(), (state.*map.values).end());
  std::sort(all.begin(), all.end());
  const auto at = [&all](double share) {
    return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
  };
  const double low = std::min(0.0, map.factor * at(0.02)), high = std::max(0.0, map.factor * at(0.98));
  return round_ticks(low, high > low ? high : low + 1, 4);
}

} // namespace

void draw_sleeve(const Run &run, const Extent &extent, const std::filesystem::path &png) {
  std::vector<CutView> views;
  for (const auto &[time, words] :
       {Moment{zero_time(run), run.zero > 0 ? "after consolidation" : "before the test"},
        Moment{run.moments.peak_time, "near the peak"}, Moment{run.moments.end_time, "at the end"}}) {
    CutView view;
    view.caption = words;
    view.spheres = read_spheres(nearest(run.specimen, time));
    for (std::size_t k = 0; k < view.spheres.size(); ++k)
      view.values.push_back(view.spheres.outward_displacement(k) * mm_per_m);
    if (!run.platens.empty()) view.platens = read_frame(nearest(run.platens, time));
    view.sleeve = read_frame(nearest(run.sleeve, time));
    views.push_back(std::move(view));
  }
  save_cut_views(run.title, "Half of the specimen in its sleeve (brown)", views, extent,
                 {Ramp::displacement, ticks_for(views), "Outward\ndisplacement\n(mm)"}, png);
}

void draw_sleeve_unrolled(const Run &run, const std::filesystem::path &png) {
  const SleeveFaces faces = faces_of_sleeve(run.sleeve.front());
  const std::array<Moment, 2> moments{
      {{run.moments.peak_time, "near the peak"}, {run.moments.end_time, "at the end"}}};
  std::vector<SleeveState> states;
  for (const Moment &moment : moments)
    states.push_back(sleeve_state(faces, nearest(run.sleeve, moment.time)));

  constexpr int plot_width = 760, left = 170, gap = 60, bar = 260, caption = 70, foot = 150;
  const auto image = unrolled_image(faces, states[0].around, 0, 1);
  const double width = image->GetSpacing()[0] * image->GetDimensions()[0],
               height = image->GetSpacing()[1] * image->GetDimensions()[1], x = image->GetOrigin()[0],
               z = image->GetOrigin()[1];
  const int plot_height = std::clamp(static_cast<int>(plot_width * height / width), 200, 760),
            row_height = caption + plot_height + foot;
  Canvas canvas(2 * (left + plot_width + gap) + bar,
                Canvas::head_height + static_cast<int>(maps.size()) * row_height);
  std::vector<vtkSmartPointer<vtkChartXY>> charts;
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const std::vector<double> ticks = ticks_of(states, maps[m]);
    for (std::size_t k = 0; k < states.size(); ++k) {
      const PlotArea area{static_cast<double>(left + static_cast<int>(k) * (left + plot_width + gap)),
                          static_cast<double>(static_cast<int>(maps.size() - 1 - m) * row_height + foot),
                          plot_width, static_cast<double>(plot_height)};
      const std::vector<double> values = scaled(states[k].*maps[m].values, maps[m].factor);
      charts.push_back(image_chart(area, unrolled_image(faces, values, ticks.front(), ticks.back()),
                                   colour_ramp(Ramp::displacement, ticks.front(), ticks.back()),
                                   {x, x + width}, {z, z + height}));
      add_axis_titles(canvas, area, "around (mm)", "z (mm)");
      canvas.add_text(moments[k].words, (area.left + 0.5 * area.width) / canvas.width(),
                      (area.bottom + area.height + 0.5 * caption) / canvas.height(), text_size);
    }
  }
  add_chart_scene(canvas, charts); // a layer over the whole canvas: bars come after it
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const double bottom =
        static_cast<double>(static_cast<int>(maps.size() - 1 - m) * row_height) / canvas.height();
    add_colour_bar(canvas, {Ramp::displacement, ticks_of(states, maps[m]), maps[m].bar},
                   1 - double(bar) / canvas.width(), 1, bottom + 0.4 * foot / canvas.height(),
                   bottom + static_cast<double>(row_height) / canvas.height());
  }
  canvas.add_head(run.title, "The inner face of the sleeve, unrolled");
  canvas.save(png);
}

} // namespace platen::apps::report
