#include "apps/output/vtu.h"

#include <vtkAOSDataArrayTemplate.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "apps/output/errors.h"
#include "apps/output/file.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

// Of 9. VTK's own choice, 5, makes files 2 % smaller and takes a quarter of the time of all output.
constexpr int quick_compression = 1;

// A VTK array on the caller's numbers without a copy: they must live as long as the grid.
template <class Number>
vtkSmartPointer<vtkDataArray> view(const std::vector<Number> &numbers, int components) {
  auto array = vtkSmartPointer<vtkAOSDataArrayTemplate<Number>>::New();
  array->SetNumberOfComponents(components);
  array->SetArray(const_cast<Number *>(numbers.data()), static_cast<vtkIdType>(numbers.size()), 1);
  return array;
}

vtkSmartPointer<vtkDataArray> view(const std::vector<Vector3> &vectors, int) {
  static_assert(sizeof(Vector3) == 3 * sizeof(double), "vectors are passed on as plain numbers");
  auto array = vtkSmartPointer<vtkAOSDataArrayTemplate<double>>::New();
  array->SetNumberOfComponents(3);
  array->SetArray(const_cast<double *>(reinterpret_cast<const double *>(vectors.data())),
                  static_cast<vtkIdType>(3 * vectors.size()), 1);
  return array;
}

void add_fields(vtkDataSetAttributes *to, const std::vector<Field> &fields, std::size_t rows) {
  for (const Field &field : fields)
    std::visit(
        [&](const auto &values) {
          if (field.components < 1 || values.size() != rows * static_cast<std::size_t>(field.components))
            throw std::logic_error("field \"" + field.name + "\" has " + std::to_string(values.size()) +
                                   " values for " + std::to_string(rows) + " rows of " +
                                   std::to_string(field.components));
          const auto array = view(values, field.components);
          array->SetName(field.name.c_str());
          to->AddArray(array);
          if (array->GetNumberOfComponents() == 1 && to->GetScalars() == nullptr)
            to->SetActiveScalars(field.name.c_str());
        },
        field.values);
}

void set_points(vtkUnstructuredGrid &grid, const std::vector<Vector3> &points) {
  vtkNew<vtkPoints> vtk_points;
  vtk_points->SetDataTypeToDouble();
  if (!points.empty()) vtk_points->SetData(view(points, 3));
  grid.SetPoints(vtk_points);
}

// Codes below VTK's own are those of the system.
std::string reason(unsigned long code) {
  if (code == vtkErrorCode::OutOfDiskSpaceError) return std::strerror(ENOSPC);
  if (code > 0 && code < vtkErrorCode::FirstVTKErrorCode) return std::strerror(static_cast<int>(code));
  return "the VTK writer failed with code " + std::to_string(code);
}

// Write() of the writer reports success on a full disk; the error code and the end of the file show the
// failure.
void write_part(const std::filesystem::path &part, vtkXMLWriter &writer) {
  vtkNew<vtkCallbackCommand> silent; // the error is reported by what is thrown
  silent->SetCallback([](vtkObject *, unsigned long, void *, void *) {});
  writer.AddObserver(vtkCommand::ErrorEvent, silent);
  writer.GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silent);
  writer.SetFileName(part.c_str());
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToZLib();
  writer.SetCompressionLevel(quick_compression);
  const int written = writer.Write();
  const unsigned long error = writer.GetErrorCode();
  if (written == 0 || error != vtkErrorCode::NoError)
    throw OutputError(part.string() + ": cannot be written: " + reason(error));

  const std::string end = "</VTKFile>\n";
  std::string found(end.size(), '\0');
  std::ifstream stream(part, std::ios::binary);
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  if (!stream.read(found.data(), static_cast<std::streamsize>(found.size())) || found != end)
    throw OutputError(part.string() + ": cannot be written: the file is cut off");
}

// Cells of one type of VTK.
void write_cells(const std::filesystem::path &path, double time, const std::vector<Vector3> &points, int type,
                 vtkCellArray *cells, const std::vector<Field> &point_fields,
                 const std::vector<Field> &cell_fields, const FrameValues &of_frame = {}) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(*grid, points);
  grid->SetCells(type, cells);
  add_fields(grid->GetPointData(), point_fields, points.size());
  add_fields(grid->GetCellData(), cell_fields, static_cast<std::size_t>(cells->GetNumberOfCells()));
  FrameValues values{{"TimeValue", time}}; // as readers of single frames expect it
  values.insert(values.end(), of_frame.begin(), of_frame.end());
  for (const auto &[name, value] : values) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->InsertNextValue(value);
    grid->GetFieldData()->AddArray(array);
  }
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_vtk_aside(path, *writer);
}

} // namespace

void write_vtk_aside(const std::filesystem::path &path, vtkXMLWriter &writer) {
  write_aside(path, [&](const std::filesystem::path &part) { write_part(part, writer); });
}

void write_points(const std::filesystem::path &path, double time, const std::vector<Vector3> &points,
                  const std::vector<Field> &point_fields, const FrameValues &of_frame) {
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType k = 0; k < static_cast<vtkIdType>(points.size()); ++k)
    vertices->InsertNextCell(1, &k);
  write_cells(path, time, points, VTK_VERTEX, vertices, point_fields, {}, of_frame);
}

void write_lines(const std::filesystem::path &path, double time, const std::vector<Vector3> &points,
                 const std::vector<std::array<int, 2>> &lines, const std::vector<Field> &point_fields,
                 const std::vector<Field> &line_fields, const FrameValues &of_frame) {
  const auto outside = [&](int p) { return p < 0 || static_cast<std::size_t>(p) >= points.size(); };
  vtkNew<vtkCellArray> cells;
  for (const auto &line : lines) {
    if (outside(line[0]) || outside(line[1])) throw std::logic_error("a line ends at no point");
    cells->InsertNextCell({line[0], line[1]});
  }
  write_cells(path, time, points, VTK_LINE, cells, point_fields, line_fields, of_frame);
}

void write_discs(const std::filesystem::path &path, double time, const std::vector<Disc> &discs,
                 const std::vector<Field> &disc_fields) {
  constexpr int corners = 12;
  // The polygon's area is 1/2 n sin(2 pi / n) of its outer radius squared.
  const double outer = std::sqrt(pi / (0.5 * corners * std::sin(2 * pi / corners)));
  std::vector<Vector3> points;
  points.reserve(corners * discs.size());
  vtkNew<vtkCellArray> polygons;
  for (const Disc &disc : discs) {
    const Vector3 n = disc.normal;
    const Vector3 aside = std::abs(n.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0}; // not along the normal
    const Vector3 across = cross(n, aside), u = (1 / norm(across)) * across, v = cross(n, u);
    polygons->InsertNextCell(corners);
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * pi * k / corners, r = outer * disc.radius;
      polygons->InsertCellPoint(static_cast<vtkIdType>(points.size()));
      points.push_back(disc.centre + r * std::cos(angle) * u + r * std::sin(angle) * v);
    }
  }
  write_cells(path, time, points, VTK_POLYGON, polygons, {}, disc_fields);
}

void write_body(const std::filesystem::path &path, double time, const fem::Picture &picture) {
  const auto fields = [](const std::vector<fem::PictureField> &of) {
    std::vector<Field> made;
    for (fem::PictureField field : of) {
      // VTK writes the smallest value on several threads: of -0 and 0 it takes either.
      for (double &value : field.values)
        value += 0.0;
      made.push_back({field.name, std::move(field.values), field.components});
    }
    return made;
  };
  vtkNew<vtkCellArray> cells;
  const auto nodes = static_cast<std::size_t>(picture.nodes_per_cell);
  std::vector<vtkIdType> cell(nodes);
  for (std::size_t first = 0; first < picture.cells.size(); first += nodes) {
    std::copy_n(picture.cells.begin() + static_cast<std::ptrdiff_t>(first), nodes, cell.begin());
    cells->InsertNextCell(static_cast<vtkIdType>(nodes), cell.data());
  }
  write_cells(path, time, picture.points, nodes == 8 ? VTK_HEXAHEDRON : VTK_TRIQUADRATIC_HEXAHEDRON, cells,
              fields(picture.of_points), fields(picture.of_cells));
}

} // namespace platen::apps
