// An off-screen window that becomes a PNG. Needs an X server (see display.h).
#pragma once

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <filesystem>
#include <string>

#include "apps/scene/errors.h"

class vtkTextActor;

namespace platen::apps::report {

class Canvas {
public:
  Canvas(int width, int height); // pixels, white
  int width() const { return width_; }
  int height() const { return height_; }
  // A renderer on the part [x0, x1] x [y0, y1] of the window (fractions, origin lower left).
  vtkRenderer *add_renderer(const std::array<double, 4> &x0_y0_x1_y1);
  // Width over height of its part, as it will be drawn. (A window that is not drawn yet may say otherwise.)
  double aspect(vtkRenderer *renderer) const;
  // Where a place of its scene is drawn, in fractions of the whole window. The camera has to stand.
  std::array<double, 2> on_window(vtkRenderer *renderer, const std::array<double, 3> &place) const;
  // Text centred at fractions (x, y) of the whole window, in smaller letters where it would be wider than
  // `widest` (fraction), and moved where it would reach beyond the window.
  void add_text(const std::string &text, double x, double y, int size, double widest = 0.97,
                bool bold = false);
  // The same, read from below to above.
  void add_upright_text(const std::string &text, double x, double y, int size);
  // The head of a picture, `head_height` pixels at its top: the title in bold, under it what is shown.
  void add_head(const std::string &title, const std::string &subtitle);
  static constexpr int head_height = 120;
  // Draws and writes. Throws OutputError.
  void save(const std::filesystem::path &png) const;

private:
  vtkTextActor *add_centred(const std::string &text, double x, double y);
  vtkRenderer *overlay(); // a layer over everything, for text

  int width_, height_;
  vtkSmartPointer<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderer> overlay_;
};

} // namespace platen::apps::report
