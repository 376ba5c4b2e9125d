// What all pictures look like and stand on: colours that the colour-blind can tell apart, letters that can
// still be read when a picture is printed at half its size, round ticks, and an off-screen window that
// becomes a PNG.
#pragma once

#include <vtkColorTransferFunction.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

class vtkTextActor;
class vtkTextProperty;

namespace platen::apps::report {

using Colour = std::array<unsigned char, 3>;

// Okabe and Ito (2008), without the yellow, which is lost on white.
namespace colours {
constexpr Colour black{0, 0, 0}, orange{230, 159, 0}, sky_blue{86, 180, 233}, green{0, 158, 115},
    blue{0, 114, 178}, vermilion{213, 94, 0}, purple{204, 121, 167}, grey{120, 120, 120};
}

// The colour of the k-th run in a chart of several.
Colour run_colour(std::size_t k);

// Pictures are drawn this many times larger than they are written, and averaged: smooth edges without the
// help of a graphics card. Sizes in pixels everywhere are those of the written picture.
constexpr int oversampling = 2;

constexpr int title_size = 38, text_size = 32, small_size = 28; // pixels

// Black sans-serif letters of the given size, of a font that has those of `text`.
void set_letters(vtkTextProperty *property, int size, bool bold = false, const std::string &text = "");

enum class Ramp {
  displacement, // dark blue over green to yellow (viridis), even steps of lightness
  damage,       // pale grey over orange to dark red
  pieces        // steps, one for each whole number from 0 (grey) on: set low = 0
};

void add_colour(vtkColorTransferFunction *ramp, double x, const Colour &colour);

// Colours from `low` to `high`, ends held beyond.
vtkSmartPointer<vtkColorTransferFunction> colour_ramp(Ramp ramp, double low, double high);

// About `wanted` intervals with round borders (1, 2 or 5 times a power of ten) that hold [low, high]; the
// borders.
std::vector<double> round_ticks(double low, double high, int wanted);

// A white window. Needs an X server (display.h).
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
  // Text centred at fractions (x, y) of the whole window, in smaller letters and then in lines where it would
  // be wider than `widest` (fraction), and moved where it would reach beyond the window. Lines that are
  // higher than `highest` (pixels) together become smaller still, and at last the text ends in "...".
  void add_text(const std::string &text, double x, double y, int size, double widest = 0.97,
                bool bold = false, double highest = 0);
  // The same, read from below to above, in smaller letters where it would be longer than `longest` (pixels).
  void add_upright_text(const std::string &text, double x, double y, int size, double longest = 1e9);
  // The head of a picture, `head_height` pixels at its top: the title in bold, under it what is shown. Long
  // titles are in smaller letters, then in lines.
  void add_head(const std::string &title, const std::string &subtitle);
  static constexpr int head_height = 120;
  // Draws and writes. Throws OutputError.
  void save(const std::filesystem::path &png) const;

private:
  vtkTextActor *add_centred(const std::string &text, double x, double y);

  int width_, height_;
  vtkSmartPointer<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderer> overlay_; // a layer over everything, for text
};

} // namespace platen::apps::report
