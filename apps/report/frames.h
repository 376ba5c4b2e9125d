// Time series of VTU files listed by a .pvd, and what a frame of spheres holds.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/pi.h"

namespace platen::apps::report {

struct Frame {
  double time = 0;                          // s
  std::vector<std::filesystem::path> parts; // files that are shown together
};

using FrameSeries = std::vector<Frame>; // by time
// The frame whose time is nearest. The series must not be empty.
const Frame &nearest(const FrameSeries &series, double time);

// Reads the list alone, not the frames. Throws InputError where the file is no .pvd or a frame is not there.
FrameSeries read_pvd(const std::filesystem::path &file);

// Contacts may be none at a time; of all else there is always something.
enum class Points { some, maybe_none };

// The parts of a frame, joined, cells and points. Throws InputError where a part is missing, damaged or empty
// without leave.
vtkSmartPointer<vtkUnstructuredGrid> read_frame(const Frame &frame, Points points = Points::some);

// A field of a frame's points. Throws InputError where there is none of so many components.
vtkDataArray &point_data(vtkUnstructuredGrid &grid, const char *name, int components, const Frame &frame);

using Position = std::array<double, 3>; // m

// A frame of spheres as plain columns.
struct Spheres {
  std::vector<Position> position;                 // now
  std::vector<Position> initial;                  // before the test: position less displacement
  std::vector<double> radius;                     // m
  std::vector<double> intact_bonds, broken_bonds; // each counts for both its ends
  std::vector<long long> id;
  // Empty where the frame does not tell.
  std::vector<int> fragment;   // 0: the largest
  std::vector<int> moves_with; // since the peak, with the platen 1 bottom, 2 top; 0 neither

  std::size_t size() const { return position.size(); }
  double displacement(std::size_t k) const;         // m, size
  double outward_displacement(std::size_t k) const; // m, away from the axis x = y = 0, in the plane across it
  double damage(std::size_t k) const;               // broken share of the bonds; 0 for a sphere that had none
};

// Throws InputError where a field is missing or has another length than there are points.
Spheres read_spheres(const Frame &frame);

// Size of the specimen as it was before the test, skin included.
struct Extent {
  enum class Form { cylinder, box, disc }; // a disc lies with its axis along y and is pressed across it
  Form form = Form::cylinder;
  double half_width = 0;      // m, along x
  double bottom = 0, top = 0; // m
  double half_depth = 0;      // m, along y
  double height() const { return top - bottom; }
  // Neither round nor square seen from above: what happens in it goes by the distance from the middle plane
  // x = 0, not from the axis.
  bool is_plane() const { return form == Form::disc || (form == Form::box && half_width > 1.5 * half_depth); }
};
Extent extent_of(const Spheres &spheres);

} // namespace platen::apps::report
