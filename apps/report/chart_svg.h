// Charts as SVG: lines, dots and letters that can be drawn at any size and edited. The same layout as the
// PNG's.
#pragma once

#include <string>

#include "apps/report/chart.h"

namespace platen::apps::report {

class ChartSvg {
public:
  ChartSvg(int width, int height) : width_(width), height_(height) {} // of the whole picture, pixels
  // `area`: where its axes stand, origin lower left.
  void add(const ChartLayout &layout, const PlotArea &area);
  // The whole file.
  std::string text(const std::string &title, const std::string &subtitle) const;

private:
  int width_, height_;
  std::string charts_;
  int count_ = 0;
};

} // namespace platen::apps::report
