// Particles, lines, discs and finite elements as VTU files for ParaView: binary (raw appended), compressed
// (zlib), with named fields. Written aside and renamed, so that a file under its name is always whole.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/vector3.h"
#include "fem/picture.h"

class vtkXMLWriter;

namespace platen::apps {

// One field: `components` values for each point (or cell), one after the other. 1: scalar; 3: vector; 6:
// symmetric tensor in VTK's order xx yy zz xy yz xz; 9: tensor by rows. Units are those of SI; tension is
// positive.
struct Field {
  std::string name;
  std::variant<std::vector<double>, std::vector<int>, std::vector<Vector3>> values;
  int components = 1; // of numbers
};

// Numbers of a whole frame, stored as field data: what ParaView shows with "Annotate Attribute Data" or in a
// spreadsheet.
using FrameValues = std::vector<std::pair<std::string, double>>;

// Points, each with a vertex cell, and their fields. `time` (s) is stored with the frame. Active scalars are
// the first field of one component. Throws OutputError where the file cannot be written (a former one stays),
// std::logic_error where a field has another length than the points.
void write_points(const std::filesystem::path &path, double time, const std::vector<Vector3> &points,
                  const std::vector<Field> &point_fields, const FrameValues &of_frame = {});

// Lines between two of the points, with fields of the points and of the lines; errors as above, and
// std::logic_error where a line ends at no point.
void write_lines(const std::filesystem::path &path, double time, const std::vector<Vector3> &points,
                 const std::vector<std::array<int, 2>> &lines, const std::vector<Field> &point_fields,
                 const std::vector<Field> &line_fields, const FrameValues &of_frame = {});

struct Disc {
  Vector3 centre, normal; // m, unit
  double radius = 0;      // m
};
// Discs as regular polygons of twelve corners and the disc's area, one cell each, with their fields; errors
// as above.
void write_discs(const std::filesystem::path &path, double time, const std::vector<Disc> &discs,
                 const std::vector<Field> &disc_fields);

// The elements of a body, with its fields; errors as above. Active scalars: contact_pressure.
void write_body(const std::filesystem::path &path, double time, const fem::Picture &picture);

// What a writer of VTK's has for its input. Throws OutputError; a former file stays.
void write_vtk_aside(const std::filesystem::path &path, vtkXMLWriter &writer);

} // namespace platen::apps
