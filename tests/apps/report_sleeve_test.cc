// The sleeve of a report: which faces it has, how it is stretched, and that it stands on the page as it is.
#include "apps/report/sleeve.h"

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>

#include "apps/report/joined.h"
#include "apps/report/viewer.h"
#include "apps/report_example.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

constexpr int around = 16, along = 5, layers = 2;
constexpr double inner_radius = 0.025, wall = 0.003, height = 0.1; // m
constexpr double wider = 0.04, shorter = 0.02;                     // at the end of the test

// Of a tube whose elements have corners of their own, wider and shorter by a share of what it is at the end.
void write_tube(const std::filesystem::path &file, double share) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> displacement, pressure, slip;
  displacement->SetName("displacement"), pressure->SetName("contact_pressure"), slip->SetName("slip");
  displacement->SetNumberOfComponents(3);
  for (int layer = 0; layer < layers; ++layer)
    for (int j = 0; j < along; ++j)
      for (int i = 0; i < around; ++i) {
        vtkIdType corners[8];
        int corner = 0;
        for (const int up : {j, j + 1})
          for (const auto &[r, turn] :
               {std::pair{layer, i}, {layer + 1, i}, {layer + 1, i + 1}, {layer, i + 1}}) {
            const double radius = inner_radius + wall * r / layers, angle = 2 * pi * (turn % around) / around;
            const double x = radius * std::cos(angle), y = radius * std::sin(angle), z = height * up / along;
            const double u[] = {wider * share * x, wider * share * y, -shorter * share * z};
            corners[corner++] = points->InsertNextPoint(x + u[0], y + u[1], z + u[2]);
            displacement->InsertNextTuple(u);
            pressure->InsertNextValue(1e6 * (up < 2 ? 1 : 2));
            slip->InsertNextValue(1e-4 * share);
          }
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
      }
  grid->SetPoints(points);
  for (vtkDoubleArray *array : {displacement.Get(), pressure.Get(), slip.Get()})
    grid->GetPointData()->AddArray(array);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(file.c_str());
  writer->Write();
}

void add_sleeve(const std::filesystem::path &folder) {
  std::string list;
  for (const double time : {0.0, example_peak_time, example_fall_time, example_end_time}) {
    const std::string name = "sleeve_" + std::to_string(time) + ".vtu";
    write_tube(folder / name, time / example_end_time);
    list += "<DataSet timestep=\"" + std::to_string(time) + "\" part=\"0\" file=\"" + name + "\"/>\n";
  }
  std::ofstream(folder / "sleeve.pvd")
      << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\">\n<Collection>\n"
      << list << "</Collection>\n</VTKFile>\n";
}

Run run_in_a_sleeve(const TestFolder &folder) {
  write_example(folder / "run", {});
  add_sleeve(folder / "run");
  return read_run(folder / "run");
}

TEST(ReportSleeve, corners_that_elements_share_are_one_and_each_face_has_its_elements) {
  const TestFolder folder;
  const report::Run run = run_in_a_sleeve(folder);
  ASSERT_EQ(run.sleeve.size(), 4u);
  const SleeveFaces faces = faces_of_sleeve(run.sleeve.back()); // deformed: the faces are those of before
  EXPECT_EQ(faces.points.size(), std::size_t(around * (along + 1) * (layers + 1)));
  ASSERT_EQ(faces.inner.size(), std::size_t(around * along));
  ASSERT_EQ(faces.outer.size(), std::size_t(around * along));
  for (const auto &face : faces.outer) {
    const auto place = [&](int k) {
      return faces.initial[static_cast<std::size_t>(face[static_cast<std::size_t>(k)])];
    };
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(std::hypot(place(k)[0], place(k)[1]), inner_radius + wall, 1e-9);
    EXPECT_NEAR(place(0)[2], place(1)[2], 1e-9);
    EXPECT_NEAR(place(2)[2], place(3)[2], 1e-9);
    EXPECT_GT(place(2)[2], place(1)[2]);
    for (int k : {0, 1}) // upper corners above lower ones
      EXPECT_NEAR(place(k)[0], place(3 - k)[0], 1e-9);
  }
}

TEST(ReportSleeve, stretch_is_that_of_a_known_widening) {
  const TestFolder folder;
  const report::Run run = run_in_a_sleeve(folder);
  const SleeveFaces faces = faces_of_sleeve(run.sleeve.front());
  for (const Frame &frame : run.sleeve) {
    const SleeveState state = sleeve_state(faces, frame);
    const double share = frame.time / example_end_time;
    for (std::size_t k = 0; k < faces.inner.size(); ++k) {
      EXPECT_NEAR(state.around[k], wider * share, 1e-6) << "time " << frame.time << ", face " << k;
      EXPECT_NEAR(state.along[k], -shorter * share, 1e-6);
      EXPECT_NEAR(state.slip[k], 1e-4 * share, 1e-12);
    }
    const auto [least, largest] = std::minmax_element(state.pressure.begin(), state.pressure.end());
    EXPECT_NEAR(*least, 1e6, 1);
    EXPECT_NEAR(*largest, 2e6, 1);
  }
}

TEST(ReportSleeve, what_is_no_tube_of_hexahedra_is_refused) {
  const TestFolder folder;
  const report::Run run = run_in_a_sleeve(folder);
  EXPECT_THROW(faces_of_sleeve(run.specimen.front()), InputError);
  const SleeveFaces faces = faces_of_sleeve(run.sleeve.front());
  EXPECT_THROW(sleeve_places(faces, run.specimen.front()), InputError);
}

TEST(ReportSleeve, the_page_holds_its_outer_face_in_every_frame) {
  const TestFolder folder;
  const report::Run run = run_in_a_sleeve(folder);
  const SpecimenView view = pack_view(run, extent_of(read_spheres(run.specimen.front())), 20);
  const std::size_t corners = view.meta["sleeve"]["corners"];
  EXPECT_EQ(corners, std::size_t(around * (along + 1)));
  EXPECT_EQ(view.meta["sleeve"]["faces"].size(), std::size_t(4 * around * along));
  const std::size_t states = 1 + view.meta["frames"].size(); // before the test, and each frame
  ASSERT_GT(view.bytes.size(), 6 * corners * states);
  const double step = view.meta["step"];
  std::size_t at = view.bytes.size() - 6 * corners * states;
  for (std::size_t state = 0; state < states; ++state) {
    const double share = state == 0 ? 0 : run.sleeve[state - 1].time / example_end_time;
    for (std::size_t k = 0; k < corners; ++k) {
      Position place;
      for (std::size_t axis = 0; axis < 3; ++axis, at += 2)
        place[axis] =
            view.meta["origin"][axis].get<double>() + step * (view.bytes[at] + 256 * view.bytes[at + 1]);
      ASSERT_NEAR(std::hypot(place[0], place[1]), (inner_radius + wall) * (1 + wider * share), step)
          << "state " << state << ", corner " << k;
      ASSERT_LE(place[2], height * (1 - shorter * share) + step);
    }
  }
}

TEST(ReportSleeve, two_supports_are_two_bodies) {
  const TestFolder folder;
  write_example(folder / "run", {});
  const report::Run run = read_run(folder / "run");
  const auto bodies = bounds_of_bodies(*read_frame(run.platens.front())); // both platens in one file
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_LT(bodies[0][5], bodies[1][2]) << "the lower one reaches into the upper one";
  const auto tube = bounds_of_bodies(*read_frame(run_in_a_sleeve(folder).sleeve.front()));
  ASSERT_EQ(tube.size(), 1u) << "elements with corners of their own are one body";
  EXPECT_NEAR(tube[0][0], -(inner_radius + wall), 1e-8);
  EXPECT_NEAR(tube[0][5], height, 1e-8);
}

} // namespace
} // namespace platen::apps::report
