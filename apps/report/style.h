// Colours and letter sizes shared by all pictures: white ground, colours that the colour-blind can tell
// apart, letters that can still be read when a picture is printed at half its size.
#pragma once

#include <vtkColorTransferFunction.h>
#include <vtkSmartPointer.h>

#include <array>
#include <vector>

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

// Black sans-serif letters of the given size.
void set_letters(vtkTextProperty *property, int size, bool bold = false);

enum class Ramp {
  displacement, // dark blue over green to yellow (viridis), even steps of lightness
  damage,       // pale grey over orange to dark red
  pieces        // steps, one for each whole number from 0 (grey) on: set low = 0
};

// Colours from `low` to `high`, ends held beyond.
vtkSmartPointer<vtkColorTransferFunction> colour_ramp(Ramp ramp, double low, double high);

// About `wanted` intervals with round borders (1, 2 or 5 times a power of ten) that hold [low, high]; the
// borders.
std::vector<double> round_ticks(double low, double high, int wanted);

} // namespace platen::apps::report
