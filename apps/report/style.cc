#include "apps/report/style.h"

#include <vtkTextProperty.h>

#include <cmath>

namespace platen::apps::report {

Colour run_colour(std::size_t k) {
  static const std::vector<Colour> order = {colours::blue,   colours::vermilion, colours::green,
                                            colours::purple, colours::orange,    colours::sky_blue,
                                            colours::black};
  return order[k % order.size()];
}

void set_letters(vtkTextProperty *property, int size, bool bold) {
  property->SetFontFamilyToArial();
  property->SetFontSize(oversampling * size);
  property->SetColor(0, 0, 0);
  property->SetBold(bold);
  property->SetItalic(false);
  property->SetShadow(false);
}

namespace {

vtkSmartPointer<vtkColorTransferFunction> steps(double high) {
  static const std::vector<Colour> pieces = {{225, 225, 225},    colours::blue,   colours::orange,
                                             colours::green,     colours::purple, colours::sky_blue,
                                             colours::vermilion, colours::black};
  auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  constexpr double edge = 0.4999;
  for (int k = 0; k <= static_cast<int>(high); ++k) {
    const Colour &c = pieces[static_cast<std::size_t>(k) % pieces.size()];
    for (const double x : {k - edge, k + edge})
      function->AddRGBPoint(x, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  return function;
}

} // namespace

vtkSmartPointer<vtkColorTransferFunction> colour_ramp(Ramp ramp, double low, double high) {
  if (ramp == Ramp::pieces) return steps(high);
  static const std::vector<Colour> viridis = {{68, 1, 84},    {72, 40, 120},  {62, 73, 137},  {49, 104, 142},
                                              {38, 130, 142}, {31, 158, 137}, {53, 183, 121}, {109, 205, 89},
                                              {180, 222, 44}, {253, 231, 37}};
  static const std::vector<Colour> damage = {{226, 230, 233}, {253, 212, 158}, {253, 170, 110},
                                             {239, 101, 72},  {200, 30, 25},   {120, 0, 0}};
  const std::vector<Colour> &stops = ramp == Ramp::displacement ? viridis : damage;
  auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (std::size_t k = 0; k < stops.size(); ++k)
    function->AddRGBPoint(low + (high - low) * static_cast<double>(k) / static_cast<double>(stops.size() - 1),
                          stops[k][0] / 255.0, stops[k][1] / 255.0, stops[k][2] / 255.0);
  return function;
}

std::vector<double> round_ticks(double low, double high, int wanted) {
  if (!(high > low)) high = low + (low == 0 ? 1 : std::abs(low));
  const double raw = (high - low) / wanted, power = std::pow(10.0, std::floor(std::log10(raw)));
  const double step = power * (raw <= 1.4 * power ? 1 : raw <= 3 * power ? 2 : raw <= 7 * power ? 5 : 10);
  constexpr double slack = 1e-9; // of a step: a border that is met but for rounding needs no further interval
  const long first = std::lround(std::floor(low / step + slack)),
             last = std::lround(std::ceil(high / step - slack));
  std::vector<double> ticks;
  for (long k = first; k <= last; ++k)
    ticks.push_back(static_cast<double>(k) * step);
  return ticks;
}

} // namespace platen::apps::report
