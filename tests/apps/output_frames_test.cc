// Frames for ParaView and the series that list them.
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "apps/output/errors.h"
#include "apps/output/file.h"
#include "apps/output/output_folder.h"
#include "apps/output/pvd.h"
#include "apps/output/vtu.h"
#include "apps/scratch_folder.h"
#include "fem/elastic_solid.h"
#include "fem/rigid_body.h"

namespace platen::apps {
namespace {

using namespace testing;

class Vtu : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "specimen_000003.vtu";
  vtkNew<vtkXMLUnstructuredGridReader> reader_;
  vtkUnstructuredGrid *read() {
    reader_->SetFileName(path_.c_str());
    reader_->Update();
    EXPECT_EQ(reader_->GetErrorCode(), 0u);
    return reader_->GetOutput();
  }
};

std::vector<Vector3> random_points(std::size_t n) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  std::vector<Vector3> points(n);
  for (Vector3 &p : points)
    p = {uniform(random), uniform(random), uniform(random)};
  return points;
}

TEST_F(Vtu, particles_read_back_to_the_same_bits) {
  const std::size_t n = 5000;
  const std::vector<Vector3> points = random_points(n);
  std::vector<double> radius(n), stress(9 * n);
  std::vector<int> broken(n);
  for (std::size_t k = 0; k < n; ++k) {
    radius[k] = 1e-3 / static_cast<double>(k + 1);
    broken[k] = static_cast<int>(k % 7) - 1;
    for (std::size_t c = 0; c < 9; ++c)
      stress[9 * k + c] = -1e6 * static_cast<double>(k) + static_cast<double>(c);
  }
  write_points(path_, 0.125, points,
               {{"radius", radius}, {"velocity", points}, {"broken_bonds", broken}, {"stress", stress, 9}});
  vtkUnstructuredGrid *grid = read();
  ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(n));
  ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(n));
  EXPECT_EQ(grid->GetCellType(static_cast<vtkIdType>(n) - 1), VTK_VERTEX);
  vtkPointData *data = grid->GetPointData();
  ASSERT_EQ(data->GetNumberOfArrays(), 4);
  const auto value = [&](const char *name, std::size_t k, int c) {
    return data->GetArray(name)->GetComponent(static_cast<vtkIdType>(k), c);
  };
  EXPECT_EQ(data->GetArray("stress")->GetNumberOfComponents(), 9);
  EXPECT_EQ(data->GetArray("broken_bonds")->GetDataType(), VTK_INT);
  for (std::size_t k = 0; k < n; ++k) {
    double p[3];
    grid->GetPoint(static_cast<vtkIdType>(k), p);
    for (int c = 0; c < 3; ++c) {
      ASSERT_EQ(p[c], points[k][c]);
      ASSERT_EQ(value("velocity", k, c), points[k][c]);
    }
    ASSERT_EQ(value("radius", k, 0), radius[k]);
    ASSERT_EQ(value("broken_bonds", k, 0), broken[k]);
    for (int c = 0; c < 9; ++c)
      ASSERT_EQ(value("stress", k, c), stress[9 * k + static_cast<std::size_t>(c)]);
  }
  double range[2];
  data->GetArray("radius")->GetRange(range);
  EXPECT_EQ(range[0], *std::min_element(radius.begin(), radius.end()));
  EXPECT_EQ(range[1], *std::max_element(radius.begin(), radius.end()));
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.125);
}

// VTK has a place in the element for each of its points; in an oblique block, whose elements are linear in
// each direction, the points of all elements must be there.
TEST_F(Vtu, points_of_finite_elements_are_in_the_order_of_vtk) {
  const auto oblique = [](const Vector3 &p) {
    return Vector3{p.x + 0.3 * p.y, p.y - 0.2 * p.z, p.z + 0.1 * p.x};
  };
  const fem::Grid block =
      fem::moved_grid(fem::make_grid(fem::BoxPlate{{0, 0, 0}, {0.3, 0.2, 0.1}, {3, 2, 2}}), oblique);
  const fem::Material steel{7850, 210e9, 0.3};
  int bodies = 0;
  const auto expect_order = [&](const fem::Picture &picture, int type) {
    path_ = folder_ / ("body_" + std::to_string(bodies++) + ".vtu");
    write_body(path_, 0.5, picture);
    vtkUnstructuredGrid *grid = read();
    ASSERT_EQ(grid->GetNumberOfCells(), 12);
    double volume = 0; // m^3
    for (vtkIdType c = 0; c < 12; ++c) {
      vtkCell *cell = grid->GetCell(c);
      ASSERT_EQ(cell->GetCellType(), type);
      double first[3], edge[3][3];
      cell->GetPoints()->GetPoint(0, first);
      for (const auto &[axis, corner] : {std::pair{0, 1}, {1, 3}, {2, 4}})
        cell->GetPoints()->GetPoint(corner, edge[axis]);
      Vector3 origin{first[0], first[1], first[2]}, along[3];
      for (int k = 0; k < 3; ++k)
        along[k] = Vector3{edge[k][0], edge[k][1], edge[k][2]} - origin;
      volume += dot(cross(along[0], along[1]), along[2]);
      const double *place = cell->GetParametricCoords();
      for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k) {
        double at[3];
        cell->GetPoints()->GetPoint(k, at);
        const Vector3 expected =
            origin + place[3 * k] * along[0] + place[3 * k + 1] * along[1] + place[3 * k + 2] * along[2];
        EXPECT_LT(norm(Vector3{at[0], at[1], at[2]} - expected), 1e-12) << "point " << k;
      }
    }
    EXPECT_NEAR(volume, fem::volume_moments(block).volume, 1e-15);
    EXPECT_STREQ(grid->GetPointData()->GetScalars()->GetName(), "contact_pressure");
    EXPECT_EQ(grid->GetPointData()->GetArray("displacement")->GetNumberOfComponents(), 3);
    EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.5);
  };
  expect_order(fem::RigidBody(block, steel).picture(), VTK_HEXAHEDRON);
  fem::ElasticOptions quadratic;
  quadratic.degree = 2;
  expect_order(fem::ElasticSolid(block, {steel}, {}).picture(), VTK_HEXAHEDRON);
  expect_order(fem::ElasticSolid(block, {steel}, {}, quadratic).picture(), VTK_TRIQUADRATIC_HEXAHEDRON);
}

// Zeros of both signs: the smallest value of a file is always the same one.
TEST_F(Vtu, fields_of_finite_elements_have_no_negative_zero) {
  const fem::Grid block = fem::make_grid(fem::BoxPlate{{0, 0, 0}, {1, 1, 1}});
  fem::Picture picture = fem::RigidBody(block, {7850, 210e9, 0.3}).picture();
  picture.of_points = {{"contact_pressure", 1, {0.0, -0.0, 0.0, -0.0, 5e6, -0.0, 0.0, -0.0}}};
  write_body(path_, 0, picture);
  vtkDataArray *pressure = read()->GetPointData()->GetArray(0);
  for (vtkIdType k = 0; k < 8; ++k)
    EXPECT_FALSE(std::signbit(pressure->GetComponent(k, 0))) << k;
  EXPECT_EQ(pressure->GetComponent(4, 0), 5e6);
}

TEST_F(Vtu, bonds_are_lines_with_values_of_their_own) {
  const std::vector<Vector3> points = random_points(4);
  const std::vector<std::array<int, 2>> lines{{0, 1}, {3, 2}, {1, 3}};
  write_lines(path_, 1.5, points, lines, {{"id", std::vector<int>{4, 5, 6, 7}}},
              {{"state", std::vector<int>{0, 2, 3}}, {"normal_force", std::vector<double>{1.5, -2.5, 0}}});
  vtkUnstructuredGrid *grid = read();
  ASSERT_EQ(grid->GetNumberOfPoints(), 4);
  ASSERT_EQ(grid->GetNumberOfCells(), 3);
  for (vtkIdType k = 0; k < 3; ++k) {
    EXPECT_EQ(grid->GetCellType(k), VTK_LINE);
    const auto row = static_cast<std::size_t>(k);
    EXPECT_EQ(grid->GetCell(k)->GetPointId(0), lines[row][0]);
    EXPECT_EQ(grid->GetCell(k)->GetPointId(1), lines[row][1]);
  }
  EXPECT_EQ(grid->GetCellData()->GetArray("state")->GetComponent(2, 0), 3);
  EXPECT_EQ(grid->GetCellData()->GetArray("normal_force")->GetComponent(1, 0), -2.5);
  EXPECT_EQ(grid->GetPointData()->GetArray("id")->GetComponent(3, 0), 7);
}

TEST_F(Vtu, is_binary_and_compressed) {
  write_points(path_, 0, random_points(100), {});
  const std::string text = content_of(path_);
  EXPECT_TRUE(contains(text, "vtkZLibDataCompressor"));
  EXPECT_TRUE(contains(text, "<AppendedData encoding=\"raw\">"));
  // Equal values shrink to next to nothing.
  write_points(path_, 0, std::vector<Vector3>(100000), {{"radius", std::vector<double>(100000, 0.25)}});
  EXPECT_LT(fs::file_size(path_), 400000u); // 3.2 MB and the cells' 1.7 MB as they are in memory
}

TEST_F(Vtu, without_points_reads_back_without_points) {
  write_points(path_, 0, {}, {{"radius", std::vector<double>{}}});
  EXPECT_EQ(read()->GetNumberOfPoints(), 0);
  write_lines(path_, 0, random_points(2), {}, {}, {{"state", std::vector<int>{}}});
  EXPECT_EQ(read()->GetNumberOfCells(), 0);
}

TEST_F(Vtu, fields_of_another_length_and_lines_to_nowhere_are_refused) {
  const std::vector<Vector3> points = random_points(3);
  EXPECT_THROW(write_points(path_, 0, points, {{"radius", std::vector<double>(2)}}), std::logic_error);
  EXPECT_THROW(write_points(path_, 0, points, {{"stress", std::vector<double>(9), 9}}), std::logic_error);
  EXPECT_THROW(write_lines(path_, 0, points, {{0, 3}}, {}, {}), std::logic_error);
  EXPECT_THROW(write_lines(path_, 0, points, {{-1, 0}}, {}, {}), std::logic_error);
  EXPECT_FALSE(fs::exists(path_));
}

// From a file that a buffer holds to one that is written in many pieces: the place where the failure shows
// differs.
TEST_F(Vtu, on_a_full_disk_says_so_and_keeps_the_former_file) {
  write_points(path_, 0, random_points(7), {});
  const std::string former = content_of(path_);
  for (const std::size_t n : {std::size_t{0}, std::size_t{3}, std::size_t{1000}, std::size_t{200000}}) {
    fs::create_symlink("/dev/full", part_path(path_));
    const std::string text = message_of<OutputError>([&] { write_points(path_, 0, random_points(n), {}); });
    EXPECT_TRUE(contains(text, part_path(path_).string()) && contains(text, "No space left")) << text;
    EXPECT_EQ(content_of(path_), former);
    EXPECT_FALSE(fs::exists(fs::symlink_status(part_path(path_))));
  }
  EXPECT_TRUE(fs::exists("/dev/full"));
}

TEST_F(Vtu, in_no_folder_says_so) {
  EXPECT_THROW(write_points(folder_ / "none" / "a.vtu", 0, random_points(3), {}), OutputError);
}

class Pvd : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "specimen.pvd";
  static double time_of(int k) { return 1e-4 * k / 3; }
  void frame(PvdSeries &series, int k) const {
    const std::string name = OutputPaths::frame_name("specimen", k);
    fs::create_directories((folder_ / name).parent_path());
    write_points(folder_ / name, time_of(k), {{0, 0, 0.01 * k}}, {});
    series.append(time_of(k), name);
  }
  // Files that are listed, with their times, as ParaView reads them.
  std::vector<std::pair<double, std::string>> listed() const {
    std::vector<std::pair<double, std::string>> frames;
    const auto root =
        vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path_.c_str()));
    if (!root) return frames;
    EXPECT_STREQ(root->GetAttribute("type"), "Collection");
    vtkXMLDataElement *collection = root->FindNestedElementWithName("Collection");
    for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
      vtkXMLDataElement *entry = collection->GetNestedElement(k);
      frames.emplace_back(std::stod(entry->GetAttribute("timestep")), entry->GetAttribute("file"));
    }
    return frames;
  }
};

TEST_F(Pvd, lists_every_frame_with_its_time_after_each_one) {
  PvdSeries series(path_);
  EXPECT_FALSE(fs::exists(path_));
  for (int k = 0; k < 4; ++k) {
    frame(series, k);
    const auto frames = listed();
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(k) + 1);
    EXPECT_EQ(frames.back().first, time_of(k));
    EXPECT_TRUE(fs::exists(folder_ / frames.back().second));
  }
}

TEST_F(Pvd, of_a_resumed_run_equals_that_of_an_uninterrupted_one) {
  {
    PvdSeries series(path_);
    for (int k = 0; k < 10; ++k)
      frame(series, k);
  }
  const std::string whole = content_of(path_);
  for (const int last : {9, 5, 0}) {
    PvdSeries series(path_);
    series.resume(time_of(last)); // a checkpoint at the very time of a frame: the frame stays
    ASSERT_EQ(listed().size(), static_cast<std::size_t>(last) + 1);
    for (int k = last + 1; k < 10; ++k)
      frame(series, k);
    EXPECT_EQ(content_of(path_), whole);
  }
}

TEST_F(Pvd, resumed_before_its_first_frame_starts_anew) {
  {
    PvdSeries series(path_);
    frame(series, 1);
  }
  PvdSeries series(path_);
  series.resume(0);
  EXPECT_TRUE(listed().empty());
  fs::remove(path_);
  PvdSeries none(path_);
  EXPECT_NO_THROW(none.resume(1));
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(Pvd, that_cannot_go_on_is_refused) {
  {
    PvdSeries series(path_);
    frame(series, 0);
    frame(series, 1);
  }
  const std::string whole = content_of(path_);
  const auto refused = [&] {
    PvdSeries series(path_);
    const std::string text = message_of<CheckpointError>([&] { series.resume(1); });
    EXPECT_TRUE(contains(text, path_.string()));
    return text;
  };
  put(path_, whole.substr(0, whole.size() / 2));
  refused();
  put(path_, whole);
  fs::remove(folder_ / OutputPaths::frame_name("specimen", 0));
  EXPECT_TRUE(contains(refused(), "specimen_000000.vtu"));
}

TEST_F(Pvd, goes_forward_in_time_and_numbers_the_parts_of_a_frame) {
  PvdSeries series(path_);
  series.append(1, "top.vtu");
  series.append(1, "bottom.vtu");
  EXPECT_THROW(series.append(0.5, "late.vtu"), std::logic_error);
  EXPECT_THROW(series.append(std::numeric_limits<double>::quiet_NaN(), "never.vtu"), std::logic_error);
  EXPECT_EQ(listed().size(), 2u);
  EXPECT_TRUE(contains(content_of(path_), "part=\"0\" file=\"top.vtu\""));
  EXPECT_TRUE(contains(content_of(path_), "part=\"1\" file=\"bottom.vtu\""));
}

TEST_F(Pvd, on_a_full_disk_stays_as_it_was) {
  PvdSeries series(path_);
  frame(series, 0);
  const std::string before = content_of(path_);
  fs::create_symlink("/dev/full", folder_ / "specimen.part.pvd");
  EXPECT_THROW(series.append(1, "next.vtu"), OutputError);
  EXPECT_EQ(content_of(path_), before);
}

} // namespace
} // namespace platen::apps
