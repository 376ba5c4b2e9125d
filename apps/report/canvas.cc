#include "apps/report/canvas.h"

#include <vtkCamera.h>
#include <vtkImageShrink3D.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>

#include "apps/output/file.h"
#include "apps/report/letters.h"

namespace platen::apps::report {

Colour run_colour(std::size_t k) {
  static const std::vector<Colour> order = {colours::blue,   colours::vermilion, colours::green,
                                            colours::purple, colours::orange,    colours::sky_blue,
                                            colours::black};
  return order[k % order.size()];
}

void set_letters(vtkTextProperty *property, int size, bool bold, const std::string &text) {
  if (const std::string file = font_file_for(text, bold); !file.empty()) {
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(file.c_str());
  } else {
    property->SetFontFamilyToArial();
  }
  property->SetFontSize(oversampling * size);
  property->SetColor(0, 0, 0);
  property->SetBold(bold);
  property->SetItalic(false);
  property->SetShadow(false);
}

void add_colour(vtkColorTransferFunction *ramp, double x, const Colour &colour) {
  ramp->AddRGBPoint(x, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
}

vtkSmartPointer<vtkColorTransferFunction> colour_ramp(Ramp ramp, double low, double high) {
  static const std::vector<Colour> viridis = {{68, 1, 84},    {72, 40, 120},  {62, 73, 137},  {49, 104, 142},
                                              {38, 130, 142}, {31, 158, 137}, {53, 183, 121}, {109, 205, 89},
                                              {180, 222, 44}, {253, 231, 37}},
                                   damage = {{226, 230, 233}, {253, 212, 158}, {253, 170, 110},
                                             {239, 101, 72},  {200, 30, 25},   {120, 0, 0}},
                                   pieces = {{225, 225, 225},    colours::blue,   colours::orange,
                                             colours::green,     colours::purple, colours::sky_blue,
                                             colours::vermilion, colours::black};
  auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  constexpr double edge = 0.4999; // of a step
  for (int k = 0; ramp == Ramp::pieces && k <= static_cast<int>(high); ++k)
    for (const double x : {k - edge, k + edge})
      add_colour(function, x, pieces[static_cast<std::size_t>(k) % pieces.size()]);
  if (ramp == Ramp::pieces) return function;
  const std::vector<Colour> &stops = ramp == Ramp::displacement ? viridis : damage;
  for (std::size_t k = 0; k < stops.size(); ++k)
    add_colour(function, low + (high - low) * static_cast<double>(k) / static_cast<double>(stops.size() - 1),
               stops[k]);
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

Canvas::Canvas(int width, int height)
    : width_(width),
      height_(height),
      window_(vtkSmartPointer<vtkRenderWindow>::New()),
      overlay_(vtkSmartPointer<vtkRenderer>::New()) {
  window_->SetOffScreenRendering(1);
  window_->SetSize(oversampling * width, oversampling * height);
  window_->SetMultiSamples(0);
  window_->SetNumberOfLayers(2);
  add_renderer({0, 0, 1, 1}); // white, also where no other renderer draws
  overlay_->SetLayer(1);
  overlay_->InteractiveOff();
  window_->AddRenderer(overlay_);
}

vtkRenderer *Canvas::add_renderer(const std::array<double, 4> &part) {
  vtkNew<vtkRenderer> renderer;
  renderer->SetViewport(part[0], part[1], part[2], part[3]);
  renderer->SetBackground(1, 1, 1);
  window_->AddRenderer(renderer);
  return renderer;
}

double Canvas::aspect(vtkRenderer *renderer) const {
  const double *part = renderer->GetViewport();
  return (part[2] - part[0]) * width_ / ((part[3] - part[1]) * height_);
}

std::array<double, 2> Canvas::on_window(vtkRenderer *renderer, const std::array<double, 3> &place) const {
  const double *part = renderer->GetViewport();
  const double world[] = {place[0], place[1], place[2], 1};
  double point[4];
  renderer->GetActiveCamera()
      ->GetCompositeProjectionTransformMatrix(aspect(renderer), -1, 1)
      ->MultiplyPoint(world, point); // -1 ... 1 over its part
  return {part[0] + 0.5 * (1 + point[0] / point[3]) * (part[2] - part[0]),
          part[1] + 0.5 * (1 + point[1] / point[3]) * (part[3] - part[1])};
}

vtkTextActor *Canvas::add_centred(const std::string &text, double x, double y) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->SetJustificationToCentered();
  actor->GetTextProperty()->SetVerticalJustificationToCentered();
  actor->SetPosition(x * oversampling * width_, y * oversampling * height_);
  overlay_->AddActor(actor);
  return actor;
}

namespace {

// Width and height of the text of an actor in pixels of the written picture.
std::array<double, 2> size_of(vtkTextActor *actor, vtkRenderer *renderer, const std::string &text,
                              int letters, bool bold) {
  actor->SetInput(text.c_str());
  set_letters(actor->GetTextProperty(), letters, bold, text);
  double extent[2]{};
  actor->GetSize(renderer, extent);
  return {extent[0] / oversampling, extent[1] / oversampling};
}

} // namespace

void Canvas::add_text(const std::string &text, double x, double y, int size, double widest, bool bold,
                      double highest) {
  vtkTextActor *actor = add_centred(text, x, y);
  constexpr int readable = 24, smallest = 12; // pixels
  constexpr int step = 2;
  constexpr double least_shortening = 0.9;
  const double room = widest * width_;
  std::array<double, 2> extent = size_of(actor, overlay_, text, size, bold);
  int letters = size;
  const int one_line = highest > 0 ? std::min(size, readable) : smallest;
  while (extent[0] > room && letters > one_line)
    extent = size_of(actor, overlay_, text, --letters, bold);
  if (extent[0] > room) { // in lines
    std::string shown = text;
    for (bool fits = false; !fits;) {
      double count = static_cast<double>(code_points(shown).size());
      double columns = std::max(1.0, count * room / size_of(actor, overlay_, shown, letters, bold)[0]);
      do {
        extent = size_of(actor, overlay_, wrapped(shown, static_cast<std::size_t>(columns)), letters, bold);
        columns -= 1;
      } while (extent[0] > room && columns > 1);
      fits = highest <= 0 || extent[1] <= highest;
      if (fits) break;
      if (letters - step >= smallest)
        letters -= step;
      else if (count < 8)
        break;
      else
        shown = shortened(shown, static_cast<std::size_t>(least_shortening * count));
    }
  }
  const double half = 0.5 * extent[0] / width_, edge = 0.01;
  if (half + edge < 0.5)
    actor->SetPosition(std::clamp(x, half + edge, 1 - half - edge) * oversampling * width_,
                       y * oversampling * height_);
}

void Canvas::add_upright_text(const std::string &text, double x, double y, int size, double longest) {
  vtkTextActor *actor = add_centred(text, x, y);
  constexpr int smallest = 12; // pixels
  while (size_of(actor, overlay_, text, size, false)[0] > longest && size > smallest)
    --size;
  actor->SetOrientation(90);
}

void Canvas::add_head(const std::string &title, const std::string &subtitle) {
  constexpr double title_lines = 66, subtitle_lines = 48; // pixels
  add_text(title, 0.5, 1 - 0.33 * head_height / height_, title_size, 0.97, true, title_lines);
  add_text(subtitle, 0.5, 1 - 0.74 * head_height / height_, text_size, 0.97, false, subtitle_lines);
}

void Canvas::save(const std::filesystem::path &png) const {
  window_->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window_);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  image->ShouldRerenderOff();
  vtkNew<vtkImageShrink3D> averaged;
  averaged->SetInputConnection(image->GetOutputPort());
  averaged->SetShrinkFactors(oversampling, oversampling, 1);
  averaged->MeanOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(averaged->GetOutputPort());
  writer->WriteToMemoryOn(); // on a full disk VTK and libpng would each print words of their own
  writer->Write();
  vtkUnsignedCharArray *bytes = writer->GetResult();
  write_text_aside(png, {reinterpret_cast<const char *>(bytes->GetPointer(0)),
                         static_cast<std::size_t>(bytes->GetNumberOfValues())});
}

} // namespace platen::apps::report
