#include "apps/report/frames.h"

#include <vtkAppendFilter.h>
#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

// VTK tells of a damaged file on the screen and returns what it has; here its words become an exception.
class SilencedVtk {
public:
  SilencedVtk() : shown_(vtkObject::GetGlobalWarningDisplay()) { vtkObject::GlobalWarningDisplayOff(); }
  ~SilencedVtk() { vtkObject::SetGlobalWarningDisplay(shown_); }
  SilencedVtk(const SilencedVtk &) = delete;
  SilencedVtk &operator=(const SilencedVtk &) = delete;

private:
  int shown_;
};

vtkSmartPointer<vtkUnstructuredGrid> read_vtu(const std::filesystem::path &file, Points points) {
  const SilencedVtk silenced;
  if (!std::filesystem::exists(file)) throw InputError(file.string() + ": missing, though the .pvd lists it");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  bool failed = false;
  vtkNew<vtkCallbackCommand> on_error;
  on_error->SetClientData(&failed);
  on_error->SetCallback(
      [](vtkObject *, unsigned long, void *flag, void *) { *static_cast<bool *>(flag) = true; });
  reader->AddObserver(vtkCommand::ErrorEvent, on_error);
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  // A cut-off file reads as one without points (and pieces), and GetErrorCode() stays 0.
  const bool nothing_is_right = points == Points::maybe_none && reader->GetNumberOfPieces() > 0;
  if (failed || reader->GetErrorCode() != 0 || (grid->GetNumberOfPoints() == 0 && !nothing_is_right))
    throw InputError(file.string() + ": damaged or empty, no points could be read");
  return grid;
}

std::vector<double> point_field(vtkUnstructuredGrid &grid, const char *name, int component, int components,
                                const std::string &where) {
  vtkDataArray *array = grid.GetPointData()->GetArray(name);
  if (array == nullptr) throw InputError(where + ": no point data \"" + name + "\"");
  if (array->GetNumberOfComponents() != components || array->GetNumberOfTuples() != grid.GetNumberOfPoints())
    throw InputError(where + ": point data \"" + name + "\" has another shape than expected");
  std::vector<double> values(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = array->GetComponent(static_cast<vtkIdType>(k), component);
  return values;
}

} // namespace

const Frame &nearest(const FrameSeries &series, double time) {
  return *std::min_element(series.begin(), series.end(), [time](const Frame &a, const Frame &b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
}

FrameSeries read_pvd(const std::filesystem::path &file) {
  const SilencedVtk silenced;
  FrameSeries series;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  vtkXMLDataElement *collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (collection == nullptr) throw InputError(file.string() + ": not a whole ParaView collection (.pvd)");

  std::map<double, Frame> by_time;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement *entry = collection->GetNestedElement(k);
    const char *name = entry->GetAttribute("file");
    double time = 0;
    if (name == nullptr || entry->GetScalarAttribute("timestep", time) != 1)
      throw InputError(file.string() + ": an entry without file or timestep");
    Frame &frame = by_time[time];
    frame.time = time;
    frame.parts.push_back(file.parent_path() / name);
  }
  for (auto &[time, frame] : by_time)
    series.push_back(std::move(frame));
  return series;
}

vtkSmartPointer<vtkUnstructuredGrid> read_frame(const Frame &frame, Points points) {
  if (frame.parts.size() == 1) return read_vtu(frame.parts[0], points);
  vtkNew<vtkAppendFilter> joined;
  for (const auto &part : frame.parts)
    joined->AddInputData(read_vtu(part, points));
  joined->Update();
  return joined->GetOutput();
}

vtkDataArray &point_data(vtkUnstructuredGrid &grid, const char *name, int components, const Frame &frame) {
  vtkDataArray *array = grid.GetPointData()->GetArray(name);
  if (array == nullptr || array->GetNumberOfComponents() != components)
    throw InputError(frame.parts.front().string() + ": no point data \"" + name + "\" of " +
                     std::to_string(components) + " components");
  return *array;
}

double Spheres::displacement(std::size_t k) const {
  const Position &a = position[k], &b = initial[k];
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double Spheres::outward_displacement(std::size_t k) const {
  return std::hypot(position[k][0], position[k][1]) - std::hypot(initial[k][0], initial[k][1]);
}

double Spheres::damage(std::size_t k) const {
  const double bonds = intact_bonds[k] + broken_bonds[k];
  return bonds > 0 ? broken_bonds[k] / bonds : 0;
}

Spheres read_spheres(const Frame &frame) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame);
  const std::string where = frame.parts.front().string();
  Spheres spheres;
  spheres.radius = point_field(*grid, "radius", 0, 1, where);
  spheres.intact_bonds = point_field(*grid, "intact_bonds", 0, 1, where);
  spheres.broken_bonds = point_field(*grid, "broken_bonds", 0, 1, where);
  for (const double id : point_field(*grid, "id", 0, 1, where))
    spheres.id.push_back(std::llround(id));
  for (const auto &[name, column] :
       {std::pair{"fragment", &spheres.fragment}, std::pair{"moves_with", &spheres.moves_with}})
    if (grid->GetPointData()->HasArray(name))
      for (const double value : point_field(*grid, name, 0, 1, where))
        column->push_back(static_cast<int>(value));
  spheres.position.resize(spheres.radius.size());
  for (std::size_t k = 0; k < spheres.size(); ++k)
    grid->GetPoint(static_cast<vtkIdType>(k), spheres.position[k].data());
  spheres.initial = spheres.position;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::vector<double> displacement =
        point_field(*grid, "displacement", static_cast<int>(d), 3, where);
    for (std::size_t k = 0; k < spheres.size(); ++k)
      spheres.initial[k][d] -= displacement[k];
  }
  return spheres;
}

Extent extent_of(const Spheres &spheres) {
  Extent extent;
  extent.bottom = extent.top = spheres.size() > 0 ? spheres.initial[0][2] : 0;
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const auto &[x, y, z] = spheres.initial[k];
    const double r = spheres.radius[k];
    extent.half_width = std::max(extent.half_width, std::abs(x) + r);
    extent.half_depth = std::max(extent.half_depth, std::abs(y) + r);
    extent.bottom = std::min(extent.bottom, z - r);
    extent.top = std::max(extent.top, z + r);
  }
  double round = 0, disc = 0; // of the spheres' skins: from the axis along z, and along y
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const auto &[x, y, z] = spheres.initial[k];
    round = std::max(round, std::hypot(x, y) + spheres.radius[k]);
    disc = std::max(disc, std::hypot(x, z - 0.5 * (extent.bottom + extent.top)) + spheres.radius[k]);
  }
  // In a box the corners are filled: the reach is up to sqrt(2) half widths, in a circle it is one.
  constexpr double corner_reach = 1.15;
  const auto is_circle = [&](double reach, double a, double b) {
    return reach < corner_reach * std::min(a, b) && std::max(a, b) < corner_reach * std::min(a, b);
  };
  if (!is_circle(round, extent.half_width, extent.half_depth))
    extent.form =
        is_circle(disc, extent.half_width, 0.5 * extent.height()) ? Extent::Form::disc : Extent::Form::box;
  return extent;
}

} // namespace platen::apps::report
