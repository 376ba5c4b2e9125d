// The rubber sleeve around a specimen: its faces, how it is stretched, and what the spheres do to it.
// Pictures need an X server (display.h) and throw OutputError where the file cannot be written.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

// Corners that elements share are one. The axis is x = y = 0.
struct SleeveFaces {
  vtkIdType points_in_frame = 0;
  std::vector<vtkIdType> points;                // of the frame, one for each corner
  std::vector<Position> initial;                // m, of each corner
  std::vector<std::array<int, 4>> outer, inner; // corners of each face: low, low, high, high along z, around
};

// From the first frame. Throws InputError where it is no tube of hexahedra.
SleeveFaces faces_of_sleeve(const Frame &frame);

// Places (m) of the corners in any frame of the same sleeve. Throws InputError where it is another.
std::vector<Position> sleeve_places(const SleeveFaces &faces, const Frame &frame);

// Of each inner face.
struct SleeveState {
  std::vector<double> around, along; // stretch less 1, of the means of opposite edges
  std::vector<double> pressure;      // Pa, of the spheres on it
  std::vector<double> slip;          // m, that spheres have slid along it
};
SleeveState sleeve_state(const SleeveFaces &faces, const Frame &frame);

// The half specimen in its sleeve where strains begin to count, at the peak and at the end. The run must have
// a sleeve and spheres.
void draw_sleeve(const Run &run, const Extent &extent, const std::filesystem::path &png);
// Its inner face unrolled, at the peak and at the end: stretch around, pressure, slip.
void draw_sleeve_unrolled(const Run &run, const std::filesystem::path &png);

} // namespace platen::apps::report
