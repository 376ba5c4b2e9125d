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

#include "apps/io/file.h"
#include "apps/report/style.h"

namespace platen::apps::report {

Canvas::Canvas(int width, int height)
    : width_(width), height_(height), window_(vtkSmartPointer<vtkRenderWindow>::New()) {
  window_->SetOffScreenRendering(1);
  window_->SetSize(oversampling * width, oversampling * height);
  window_->SetMultiSamples(0);
  window_->SetNumberOfLayers(2);
  add_renderer({0, 0, 1, 1}); // white, also where no other renderer draws
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

vtkRenderer *Canvas::overlay() {
  if (!overlay_) {
    overlay_ = vtkSmartPointer<vtkRenderer>::New();
    overlay_->SetLayer(1);
    overlay_->InteractiveOff();
    window_->AddRenderer(overlay_);
  }
  return overlay_;
}

vtkTextActor *Canvas::add_centred(const std::string &text, double x, double y) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->SetJustificationToCentered();
  actor->GetTextProperty()->SetVerticalJustificationToCentered();
  actor->SetPosition(x * oversampling * width_, y * oversampling * height_);
  overlay()->AddActor(actor);
  return actor;
}

void Canvas::add_text(const std::string &text, double x, double y, int size, double widest, bool bold) {
  vtkTextActor *actor = add_centred(text, x, y);
  constexpr int smallest = 12; // pixels
  double extent[2]{};
  for (int letters = size; letters >= smallest; --letters) {
    set_letters(actor->GetTextProperty(), letters, bold);
    actor->GetSize(overlay(), extent);
    if (extent[0] <= widest * oversampling * width_) break;
  }
  const double half = 0.5 * extent[0] / (oversampling * width_), edge = 0.01;
  if (half + edge < 0.5)
    actor->SetPosition(std::clamp(x, half + edge, 1 - half - edge) * oversampling * width_,
                       y * oversampling * height_);
}

void Canvas::add_upright_text(const std::string &text, double x, double y, int size) {
  vtkTextActor *actor = add_centred(text, x, y);
  set_letters(actor->GetTextProperty(), size);
  actor->SetOrientation(90);
}

void Canvas::add_head(const std::string &title, const std::string &subtitle) {
  add_text(title, 0.5, 1 - 0.33 * head_height / height_, title_size, 0.97, true);
  add_text(subtitle, 0.5, 1 - 0.74 * head_height / height_, text_size);
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
  vtkNew<vtkPNGWriter>
      writer; // into memory: on a full disk VTK and libpng would each print words of their own
  writer->SetInputConnection(averaged->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray *bytes = writer->GetResult();
  write_text_aside(png, {reinterpret_cast<const char *>(bytes->GetPointer(0)),
                         static_cast<std::size_t>(bytes->GetNumberOfValues())});
}

} // namespace platen::apps::report
