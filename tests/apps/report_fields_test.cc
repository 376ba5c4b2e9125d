// Fields through platens and specimen: the platens' forces are in the stress, and each body keeps to itself.
#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <fstream>

#include "apps/report/fields.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

constexpr double radius = 0.01, force = 50, share = 0.6; // m, N, 1
constexpr double steel = -7e6;                           // Pa, vertical stress of the lower platen

struct Column {
  const char *name;
  int components;
  std::vector<double> values;
};

void write_points(const std::filesystem::path &file, const std::vector<std::array<double, 3>> &places,
                  const std::vector<Column> &columns, bool hexahedron = false) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto &p : places)
    points->InsertNextPoint(p.data());
  grid->SetPoints(points);
  const vtkIdType corners[] = {0, 1, 2, 3, 4, 5, 6, 7};
  if (hexahedron) grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
  for (vtkIdType k = 0; k < points->GetNumberOfPoints() && !hexahedron; ++k)
    grid->InsertNextCell(VTK_VERTEX, 1, &k);
  for (const Column &column : columns) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(column.name);
    array->SetNumberOfComponents(column.components);
    array->SetNumberOfTuples(points->GetNumberOfPoints());
    for (std::size_t k = 0; k < column.values.size(); ++k)
      array->SetValue(static_cast<vtkIdType>(k), column.values[k]);
    grid->GetPointData()->AddArray(array);
  }
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(file.c_str());
  writer->Write();
}

void write_pvd(const std::filesystem::path &folder, const std::string &name) {
  std::ofstream(folder / (name + ".pvd"))
      << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
      << "<DataSet timestep=\"1\" part=\"0\" file=\"" << name << ".vtu\"/>\n</Collection>\n</VTKFile>\n";
}

// One sphere on an elastic platen, pressed from above, with some shear from below.
report::Run one_sphere(const std::filesystem::path &folder, double shear) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "history.csv")
      << "time_s,axial_strain_platen,axial_stress_top_pa,axial_stress_bottom_pa\n"
      << "0,0,0,0\n1,0.001,1e6,1e6\n";
  std::ofstream(folder / "summary.json") << "{\"packing_fraction\": " << share << "}\n";
  write_points(folder / "specimen.vtu", {{0, 0, radius}},
               {{"radius", 1, {radius}},
                {"displacement", 3, {0, 0, -1e-5}},
                {"stress", 9, {1e3, 0, 0, 0, 2e3, 0, 0, 0, 3e3}},
                {"id", 1, {7}},
                {"intact_bonds", 1, {3}},
                {"broken_bonds", 1, {1}}});
  write_points(folder / "contacts.vtu", {{0, 0, 0}, {0, 0, 2 * radius}},
               {{"normal", 3, {0, 0, 1, 0, 0, -1}},
                {"shear", 3, {shear, 0, 0, 0, 0, 0}},
                {"normal_force", 1, {force, force}},
                {"particle", 1, {7, 7}},
                {"sliding", 1, {0, 0}}});
  std::vector<std::array<double, 3>> corners;
  for (const double z : {-radius, 0.0})
    for (const auto &[x, y] :
         {std::array{-1., -1.}, std::array{1., -1.}, std::array{1., 1.}, std::array{-1., 1.}})
      corners.push_back({2 * radius * x, 2 * radius * y, z});
  std::vector<double> stress;
  for (int k = 0; k < 8; ++k)
    stress.insert(stress.end(), {0, 0, 0, 0, 0, 0, 0, 0, steel});
  write_points(folder / "platens.vtu", corners, {{"stress", 9, stress}}, true);
  for (const char *name : {"specimen", "contacts", "platens"})
    write_pvd(folder, name);
  return read_run(folder);
}

TEST(ReportFields, what_presses_on_a_sphere_is_in_its_stress) {
  const TestFolder folder;
  const report::Run run = one_sphere(folder / "run", 12);
  ASSERT_TRUE(tells_stress(run));
  const dem::SphereColumns spheres = stressed_spheres(run, 1);
  const double volume = 4.0 / 3 * 3.14159265358979 * std::pow(radius, 3) / share;
  ASSERT_EQ(spheres.stress.size(), 1u);
  const auto &s = spheres.stress[0];
  EXPECT_NEAR(s[8], 3e3 - 2 * radius * force / volume, 1e-6); // on top of what bonds bring
  EXPECT_NEAR(s[0], 1e3, 1e-6);
  EXPECT_NEAR(s[2], -0.5 * radius * 12 / volume, 1e-6);
  EXPECT_EQ(s[2], s[6]);
  EXPECT_EQ(spheres.damage[0], 0.25);
}

TEST(ReportFields, platens_keep_their_own_stress_and_outside_is_empty) {
  const TestFolder folder;
  const report::Run run = one_sphere(folder / "run", 0);
  const dem::RegularGrid grid{{0, 0, -1.5 * radius}, radius, {1, 1, 5}}; // outside, platen, sphere ...
  const FieldFrame frame = field_frame(run, 1, grid, 1.2 * radius);
  EXPECT_EQ(frame.body[0], Body::outside);
  EXPECT_TRUE(std::isnan(frame.fields.stress[0][8]));
  EXPECT_EQ(frame.body[1], Body::platen);
  EXPECT_NEAR(frame.fields.stress[1][8], steel, 1e-6 * std::abs(steel));
  EXPECT_TRUE(std::isnan(frame.fields.damage[1]));
  EXPECT_EQ(frame.body[2], Body::specimen);
  EXPECT_NEAR(frame.fields.stress[2][8], stressed_spheres(run, 1).stress[0][8], 1e-3);
  EXPECT_NEAR(frame.fields.damage[2], 0.25, 1e-12);
  EXPECT_EQ(frame.body[4], Body::outside);
}

TEST(ReportFields, files_for_paraview_stand_beside_the_frames) {
  const TestFolder folder;
  const report::Run run = one_sphere(folder / "run", 0);
  EXPECT_EQ(write_fields(run), folder / "run" / "fields.pvd");
  const FrameSeries series = read_pvd(folder / "run" / "fields.pvd");
  ASSERT_EQ(series.size(), 1u);
  EXPECT_EQ(series[0].time, 1);
  EXPECT_EQ(series[0].parts[0].filename(), "fields_000000.vti");
  EXPECT_TRUE(std::filesystem::exists(series[0].parts[0]));
}

TEST(ReportFields, a_run_that_does_not_say_how_dense_it_is_tells_no_stress) {
  const TestFolder folder;
  report::Run run = one_sphere(folder / "run", 0);
  run.summary = nullptr;
  EXPECT_FALSE(tells_stress(run));
}

TEST(ReportFields, contacts_may_be_none_but_a_damaged_file_is_told) {
  const TestFolder folder;
  report::Run run = one_sphere(folder / "run", 0);
  write_points(folder / "run" / "contacts.vtu", {}, {});
  EXPECT_EQ(stressed_spheres(run, 1).stress[0][8], 3e3);
  const std::string whole = text_of(folder / "run" / "contacts.vtu");
  std::ofstream(folder / "run" / "contacts.vtu") << whole.substr(0, whole.size() / 2);
  EXPECT_THROW(stressed_spheres(run, 1), InputError);
}

} // namespace
} // namespace platen::apps::report
