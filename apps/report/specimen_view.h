// The specimen cut in half along its axis, seen from the side that was taken away.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/canvas.h"
#include "apps/report/frames.h"
#include "apps/report/style.h"

namespace platen::apps::report {

// Rows of the spheres that stay when the half y > 0 is taken away, as the specimen lay before the test: a
// sphere does not come and go as it moves.
std::vector<std::size_t> kept_half(const Spheres &spheres);

using Outline = std::vector<std::array<double, 3>>; // m, a line over the cut, in front of all spheres

struct Note {                  // letters centred on a place
  std::array<double, 3> place; // m
  std::string text;
};

struct CutView {
  std::string caption; // under the picture
  Spheres spheres;
  std::vector<double> values;                   // coloured by, one per sphere
  bool is_whole = false;                        // not cut
  vtkSmartPointer<vtkUnstructuredGrid> platens; // may be null
  std::vector<Outline> outlines;
  std::vector<Note> notes;
};

struct Colouring {
  Ramp ramp = Ramp::damage;
  std::vector<double> ticks; // numbers at the colour bar, evenly spaced; the first and the last are its ends
  std::string title;         // with unit, above the colour bar
};

// Ticks of a colour bar from 0 that holds all but the largest 2 % of the values of all views: a few splinters
// that fly off must not take the colours from the rest.
std::vector<double> ticks_for(const std::vector<CutView> &views);

// The views side by side at one scale, a shared colour bar at the right, the head above. `extent` is the
// specimen's before the test. Throws OutputError.
void save_cut_views(const std::string &title, const std::string &subtitle, const std::vector<CutView> &views,
                    const Extent &extent, const Colouring &colouring, const std::filesystem::path &png);

// Pieces that other pictures use too.

// A parallel view from +y, a little from above, that holds the extent and what lies up to `margin` (m) around
// it.
void look_at_cut(const Canvas &canvas, vtkRenderer *renderer, const Extent &extent, double margin);
// A bar of the colours (none for pieces) in the part of the canvas from `left` to `right` (fractions).
void add_colour_bar(Canvas &canvas, const Colouring &colouring, double left, double right = 1);
// Light from the upper left before the cut, and a weaker one from the right.
void light_cut(vtkRenderer *renderer);
// The platens in grey, all of them or the half y < 0.
void add_platens(vtkRenderer *renderer, vtkUnstructuredGrid *platens, bool whole = false);

} // namespace platen::apps::report
