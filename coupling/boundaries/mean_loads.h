// Means over loads and places of a body's surface.
#pragma once

#include <functional>
#include <vector>

#include "base/archive.h"
#include "fem/body.h"

namespace platen::coupling {

// Loads of a body's vertices on the mean over time, for who follows them without inertia.
class MeanLoads {
public:
  MeanLoads() = default;
  explicit MeanLoads(std::size_t vertices) : impulse_(vertices, Vector3{}) {}
  void add(const fem::Body &body, double dt); // the loads as they are, for dt (s)
  int steps() const { return steps_; }        // added since the last reset()
  std::vector<Vector3> mean() const;          // N, one per vertex
  void reset();

  void describe(Archive &archive);

private:
  std::vector<Vector3> impulse_; // N s
  double time_ = 0;              // s
  int steps_ = 0;
};

// The mean height of a part of the surface, as shares of its vertices.
class MeanPlace {
public:
  MeanPlace() = default;
  // Of the faces of a tag, over their area where `covers` holds at (x, y); over all of it where it never
  // does.
  MeanPlace(const fem::SurfaceMesh &surface, int tag, const std::function<bool(double, double)> &covers);
  double height(const fem::SurfaceMesh &surface) const;                                   // m, z now
  double rise(const fem::SurfaceMesh &surface) const { return height(surface) - start_; } // m

private:
  std::vector<int> vertices_;
  std::vector<double> shares_; // sum 1
  double start_ = 0;           // m
};

} // namespace platen::coupling
