// Error against seconds, and the page of a study of accuracy.
#include <cmath>
#include <ostream>

#include "apps/report/accuracy_results.h"
#include "apps/report/chart.h"
#include "apps/report/html_page.h"
#include "apps/report/study_pictures.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

// The last part of "Effects/Rotation = off".
std::string short_words(const std::string &change) {
  return change.substr(change.rfind('/') + 1);
}

// The mean over the references; NaN where none has two seeds.
double scatter_of(const AccuracyResults &study, std::size_t measure) {
  double sum = 0;
  int count = 0;
  for (const AccuracyKnob &knob : study.knobs)
    if (!std::isnan(knob.scatter[measure])) {
      sum += knob.scatter[measure];
      ++count;
    }
  return count > 0 ? sum / count : std::nan("");
}

Chart chart_of(const AccuracyResults &study, std::size_t measure) {
  Chart chart;
  chart.scale = Scale::logarithmic;
  chart.x_title = "Seconds of a run";
  chart.y_title = std::string("Error of ") + accuracy_titles[measure] + " (%)";
  std::size_t colour = 0;
  for (const AccuracyKnob &knob : study.knobs) {
    Curve joined{knob.name, {}, {}, run_colour(colour)};
    for (std::size_t v = 0; v + 1 < knob.values.size(); ++v) {
      const AccuracyValue &value = knob.values[v];
      const double x = value.seconds, y = 100 * value.errors[measure].root_mean_square;
      if (!(x > 0 && y > 0)) continue; // no error at all has no place on such an axis
      const Colour own = run_colour(knob.ordered ? colour : colour + v);
      chart.marks.push_back({x, y, knob.ordered ? "" : short_words(value.text), own,
                             knob.ordered ? MarkShape::circle : MarkShape::diamond});
      joined.x.push_back(x), joined.y.push_back(y);
    }
    colour += knob.ordered ? 1 : knob.values.size();
    if (!knob.ordered || joined.x.empty()) continue;
    if (joined.x.size() == 1) chart.marks.back().label = knob.name;
    chart.curves.push_back(std::move(joined));
  }
  chart.band_top = 100 * scatter_of(study, measure);
  chart.band_label = "within the scatter of the seeds";
  return chart;
}

bool draws(const Chart &chart) {
  return !chart.marks.empty();
}

} // namespace

void write_accuracy_report(const AccuracyResults &study, const fs::path &folder, std::ostream &out) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": cannot be made: " + error.message());
  std::vector<Picture> drawn;
  for (std::size_t first = 0; first < accuracy_measures; first += 2) {
    std::vector<Chart> charts;
    for (const std::size_t measure : {first, first + 1})
      if (Chart chart = chart_of(study, measure); draws(chart)) charts.push_back(std::move(chart));
    if (charts.empty()) continue;
    const fs::path png = folder / (first == 0 ? "accuracy.png" : "accuracy_more.png");
    save_charts(study.title, "Error against what it costs, root mean square over the seeds", charts,
                std::vector<int>(charts.size(), 700), png);
    drawn.push_back({png,
                     "Error against the reference of each knob, on the same seed, and seconds of a run; "
                     "from coarse to fine along each line. Grey: within the scatter of the seeds (mean over "
                     "the references), where more accuracy is lost among specimens."});
  }
  std::vector<std::string> remarks = study.remarks;
  if (drawn.empty()) remarks.emplace_back("no run errs: there is nothing to draw");
  const TableOfFigures table = table_of_accuracy(study);
  write_page(study.title, table, remarks, {{"", drawn}}, folder / "report.html");
  for (const std::string &remark : remarks)
    out << remark << '\n';
  for (const Picture &picture : drawn)
    out << "drawn: " << picture.file.string() << '\n';
  out << "page: " << (folder / "report.html").string() << "\n\n" << as_text(table);
}

} // namespace platen::apps::report
