// All that a frame shows, as it is at one moment: to be written beside the computation.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/io/vtu.h"
#include "coupling/platen_test.h"

namespace platen::apps {

struct Frame {
  double time = 0; // s
  int number = 0;
  FrameValues values;
  std::vector<Vector3> points; // centres of the spheres, m
  std::vector<Field> of_spheres;
  bool has_bonds = false;
  std::vector<std::array<int, 2>> bonds; // first and second sphere
  std::vector<Field> of_bonds;
  // A platen or a sleeve, as many a series as the test has.
  struct Part {
    std::string series, file, vtu;
  };
  std::vector<Part> boundaries;
  std::vector<Vector3> contact_points; // m
  std::vector<Field> of_contacts;
};

// `moves_with` (Results::moves_with) is left out where it is empty.
Frame frame_of(const coupling::PlatenTest &problem, const std::vector<int> &moves_with, int number);

} // namespace platen::apps
