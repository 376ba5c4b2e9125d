#include "apps/report/chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/report/letters.h"
#include "apps/report/report.h"

namespace platen::apps::report {
namespace {

constexpr double letter = 0.56; // width of a letter over its size, about
constexpr double bold_letter = 0.63;
constexpr std::size_t most_letters = 80; // of a line of the legend

std::string colour_of(const Colour &c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string line(double x0, double y0, double x1, double y1, const std::string &colour, double width) {
  return fmt::format(
      "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" stroke-width=\"{:g}\"/>\n",
      x0, y0, x1, y1, colour, width);
}

std::string words(const std::string &text, double x, double y, int size, const char *anchor,
                  const std::string &more = "") {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x,
                     y, size, anchor, more, escaped(valid_utf8(text)));
}

const char *dashes(Stroke stroke) {
  return stroke == Stroke::dashed ? " stroke-dasharray=\"10,7\"" : "";
}

std::string dot(const Mark &mark, double x, double y) {
  constexpr double r = 8;
  if (mark.shape == MarkShape::circle)
    return fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:g}\" fill=\"{}\"/>\n", x, y, r,
                       colour_of(mark.colour));
  return fmt::format("<path d=\"M{:.2f} {:.2f}l{r:g} {r:g}l-{r:g} {r:g}l-{r:g} -{r:g}z\" fill=\"{}\"/>\n", x,
                     y - r, colour_of(mark.colour), fmt::arg("r", r));
}

// In lines that the width holds, of letters as large as `highest` (pixels) allows; centred at `middle`.
std::string centred_lines(const std::string &text, double width, double middle, int size, double highest,
                          bool bold) {
  constexpr double line_height = 1.15;
  constexpr int smallest = 12;
  std::string lines;
  const auto count = [&]() {
    return 1.0 + static_cast<double>(std::count(lines.begin(), lines.end(), '\n'));
  };
  std::string shown = text;
  for (;; --size) {
    lines = wrapped(shown, static_cast<std::size_t>(0.97 * width / ((bold ? bold_letter : letter) * size)));
    if (count() * line_height * size <= highest) break;
    if (size > smallest) continue;
    const std::size_t letters = code_points(shown).size();
    if (letters < 8) break;
    shown = shortened(shown, letters * 9 / 10), ++size;
  }
  std::string svg;
  double y = middle + 0.35 * size - 0.5 * (count() - 1) * line_height * size;
  for (std::size_t at = 0; at <= lines.size();) {
    const std::size_t end = std::min(lines.find('\n', at), lines.size());
    svg += words(lines.substr(at, end - at), 0.5 * width, y, size, "middle",
                 bold ? " font-weight=\"bold\"" : "");
    y += line_height * size, at = end + 1;
  }
  return svg;
}

// Points as the polyline wants them; what lies within a quarter of a pixel of the last is left out.
class Path {
public:
  void add(double x, double y) {
    if (!points_.empty() && std::abs(x - x_) < least && std::abs(y - y_) < least) return;
    points_ += fmt::format("{}{:.2f},{:.2f}", points_.empty() ? "" : " ", x, y);
    x_ = x, y_ = y;
  }
  const std::string &points() const { return points_; }

private:
  static constexpr double least = 0.25; // pixels
  std::string points_;
  double x_ = 0, y_ = 0;
};

struct Entry { // of the legend
  std::string label, sign;
};

} // namespace

void ChartSvg::add(const ChartLayout &layout, const PlotArea &area) {
  const Chart &chart = layout.chart;
  const double left = area.left, right = area.left + area.width, foot_y = height_ - area.bottom,
               top = foot_y - area.height;
  const auto px = [&](double x) {
    return left + (x - layout.x[0]) / (layout.x[1] - layout.x[0]) * area.width;
  };
  const auto py = [&](double y) {
    return foot_y - (y - layout.y[0]) / (layout.y[1] - layout.y[0]) * area.height;
  };
  std::string &svg = charts_;
  std::vector<Entry> legend;
  const auto legend_line = [&](const Curve &curve) {
    return fmt::format("<line x1=\"0\" y1=\"0\" x2=\"60\" y2=\"0\" stroke=\"{}\" stroke-width=\"{:g}\"{}/>",
                       colour_of(curve.colour), curve.width, dashes(curve.stroke));
  };

  svg += fmt::format(
      "<clipPath id=\"plot{}\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
      "height=\"{:.2f}\"/></clipPath>\n",
      ++count_, left, top, area.width, area.height);
  svg += fmt::format("<g clip-path=\"url(#plot{})\">\n", count_);
  if (chart.band_top > layout.y[0]) {
    svg +=
        fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"#e4e4e4\"/>\n",
                    left, py(chart.band_top), area.width, foot_y - py(chart.band_top));
    if (!chart.band_label.empty())
      legend.push_back(
          {chart.band_label, "<rect x=\"0\" y=\"-10\" width=\"60\" height=\"20\" fill=\"#e4e4e4\"/>"});
  }
  for (const Tick &tick : layout.x_ticks)
    svg += line(px(tick.place), top, px(tick.place), foot_y, "#e1e1e1", 1);
  for (const Tick &tick : layout.y_ticks)
    svg += line(left, py(tick.place), right, py(tick.place), "#e1e1e1", 1);
  for (const Span &span : chart.spans)
    for (const double end : {span.from, span.to})
      svg += line(px(end), top, px(end), foot_y, "#bebebe", 2);
  for (const Curve &curve : chart.curves)
    for (const Curve &piece : pieces_of(curve)) {
      Path path;
      for (std::size_t k = 0; k < piece.x.size(); ++k)
        path.add(px(piece.x[k]), py(piece.y[k]));
      svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{} points=\"{}\"/>\n",
                         colour_of(curve.colour), curve.width, dashes(curve.stroke), path.points());
      if (!piece.label.empty()) legend.push_back({piece.label, legend_line(curve)});
    }
  svg += "</g>\n";
  for (const Mark &mark : chart.marks) {
    if (!mark.label.empty()) legend.push_back({mark.label, dot(mark, 30, 0)});
    if (std::isfinite(mark.x) && std::isfinite(mark.y) && mark.x >= layout.x[0] && mark.x <= layout.x[1])
      svg += dot(mark, px(mark.x), py(mark.y));
  }

  svg += line(left, foot_y, right, foot_y, "#000", 2) + line(left, top, left, foot_y, "#000", 2);
  for (const Tick &tick : layout.x_ticks)
    svg += line(px(tick.place), foot_y, px(tick.place), foot_y + 8, "#000", 2) +
           words(tick.words, px(tick.place), foot_y + 36, small_size, "middle");
  for (const Tick &tick : layout.y_ticks)
    svg += line(left - 8, py(tick.place), left, py(tick.place), "#000", 2) +
           words(tick.words, left - 14, py(tick.place) + 0.35 * small_size, small_size, "end");
  for (const Span &span : chart.spans)
    svg += words(span.words, 0.5 * (px(span.from) + px(span.to)), top - 12, small_size, "middle");
  svg += words(chart.x_title, 0.5 * (left + right), foot_y + 92, text_size, "middle");
  const double x = left - 124, y = 0.5 * (top + foot_y);
  svg += words(chart.y_title, x, y, text_size, "middle",
               fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", x, y));

  constexpr double row = 1.3 * small_size;
  double at = top + 28;
  std::size_t longest = 0;
  for (const Entry &entry : legend)
    longest = std::max(longest, code_points(shortened(entry.label, most_letters)).size());
  const double start =
      layout.legend_left ? left + 12 : right - 84 - letter * small_size * static_cast<double>(longest);
  for (const Entry &entry : legend) {
    const std::string label = shortened(entry.label, most_letters);
    svg += fmt::format("<g transform=\"translate({:.2f} {:.2f})\">{}</g>\n", start, at, entry.sign) +
           words(label, start + 72, at + 0.35 * small_size, small_size, "start");
    at += row;
  }
}

std::string ChartSvg::text(const std::string &title, const std::string &subtitle) const {
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
             "width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"Arial, Helvetica, DejaVu "
             "Sans, sans-serif\">\n<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
             width_, height_, escaped(valid_utf8(title))) +
         centred_lines(title, width_, 0.33 * Canvas::head_height, title_size, 66, true) +
         centred_lines(subtitle, width_, 0.74 * Canvas::head_height, text_size, 48, false) + charts_ +
         "</svg>\n";
}

} // namespace platen::apps::report
