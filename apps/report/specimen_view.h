// The specimen, whole or cut in half along its axis, seen from the side that was taken away.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/canvas.h"
#include "apps/report/run_folder.h"

class vtkPolyDataMapper;

namespace platen::apps::report {

// Rows of the spheres that are seen: all, or those that stay when the half y > 0 is taken away, as the
// specimen lay before the test: a sphere does not come and go as it moves.
std::vector<std::size_t> rows_shown(const Spheres &spheres, bool whole);

using Outline = std::vector<Position>; // a line over the cut, in front of all spheres

struct Note { // letters centred on a place
  Position place;
  std::string text;
};

struct CutView {
  std::string caption; // under the picture
  Spheres spheres;
  std::vector<double> values;                   // coloured by, one per sphere
  bool is_whole = false;                        // not cut
  bool shows_front = true;                      // whole: platens before the specimen too, which would hide it
  vtkSmartPointer<vtkUnstructuredGrid> platens; // may be null
  vtkSmartPointer<vtkUnstructuredGrid> sleeve;  // may be null; cut in half as the specimen is
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

// What the spheres of a picture are coloured by. Pieces: those of 30 and more spheres that bonds hold
// together, the frames must tell fragments. Dead zones: what has moved with each
// platen since the peak, with the cones by displacement, in the plane of their axes; tells_dead_zones().
enum class Quantity { outward_displacement, displacement, damage, pieces, dead_zones };

// The specimen before the test, at the peak and at the end, coloured by how far each sphere has gone: from
// outside, or cut in half.
void draw_three_moments(const Run &run, const Extent &extent, bool whole, const std::filesystem::path &png);
// The half specimen when the stress has fallen to 0.8 of the peak (where it did) and at the end. `extent` is
// the specimen's before the test.
void draw_pattern_and_end(const Run &run, const Extent &extent, Quantity quantity,
                          const std::filesystem::path &png);
// Several runs in one scale, damage at their Run::pattern_time(), all else at their ends: that is when each
// shows the most. Runs without frames, or that do not tell the quantity, are left out; one must be there.
void draw_side_by_side(const std::vector<Run> &runs, Quantity quantity, const std::filesystem::path &png);

// Whether the frames of the run say which piece each sphere is of.
bool tells_fragments(const Run &run);
// Whether they say what moves with the platens, and the stress has fallen to 0.8 of the peak.
bool tells_dead_zones(const Run &run);
// What to see in the picture of the dead zones, with the cones in words.
std::string dead_zones_caption(const Run &run);

// Pieces that other pictures use too.

// The k-th panel from the left, `panel_width` pixels wide, below the head; its caption under it.
vtkRenderer *add_panel(Canvas &canvas, int k, int panel_width, const std::string &caption);
// A parallel view from +y, a little from above, that holds the extent and what lies up to `margin` (m) around
// it.
void look_at_cut(const Canvas &canvas, vtkRenderer *renderer, const Extent &extent, double margin);
// A bar of the colours (none for pieces) in the part of the canvas from `left` to `right` and from `bottom`
// to `top` (fractions).
void add_colour_bar(Canvas &canvas, const Colouring &colouring, double left, double right = 1,
                    double bottom = 0, double top = 1);
// Lines without light, `width` pixels wide; grey: 0 black, 1 white. The mapper may be set further.
vtkPolyDataMapper *add_lines(vtkRenderer *renderer, const std::vector<Outline> &lines, double grey,
                             float width);
// Light from the upper left before the cut, and a weaker one from the right.
void light_cut(vtkRenderer *renderer);
// The platens in grey: what of them lies below y = `before` (m), infinite: all. A sleeve in another colour.
void add_platens(vtkRenderer *renderer, vtkUnstructuredGrid *platens, double before = 0,
                 const Colour &colour = {158, 168, 179});

} // namespace platen::apps::report
