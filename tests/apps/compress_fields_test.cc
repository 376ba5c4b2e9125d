// Frames of a run as ParaView reads them: arrays that are named, and numbers that agree with each other and
// with the tables.
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolygon.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <set>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class FramesOfRun : public Crushed {
protected:
  FramesOfRun() : Crushed("crushed.prm", Frames::as_in_the_scene), run_(crushed_once()) {}
  fs::path last(const std::string &series) const {
    fs::path found;
    for (const auto &entry : fs::directory_iterator(run_ / "frames"))
      if (entry.path().filename().string().rfind(series + "_", 0) == 0) found = std::max(found, entry.path());
    return found;
  }
  static vtkSmartPointer<vtkUnstructuredGrid> read(const fs::path &file) {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
  }
  double last_of(const char *name) const { return column_of(run_ / "history.csv", name).back(); }
  const fs::path run_;
};

vtkDataArray &array(vtkDataSetAttributes *of, const char *name) {
  vtkDataArray *found = of->GetArray(name);
  if (found == nullptr) throw std::runtime_error(std::string("no array ") + name);
  return *found;
}

std::array<double, 3> vector(vtkDataArray &of, vtkIdType k) {
  return {of.GetComponent(k, 0), of.GetComponent(k, 1), of.GetComponent(k, 2)};
}

double size(const std::array<double, 3> &v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

TEST_F(FramesOfRun, are_what_the_tables_tell) {
  // Scalars name an array that is there.
  for (const char *series : {"specimen", "bonds", "contacts", "platens"}) {
    const std::string text = content_of(last(series));
    std::smatch found;
    ASSERT_TRUE(std::regex_search(text, found, std::regex("Scalars=\"([^\"]+)\""))) << series;
    EXPECT_TRUE(contains(text, "Name=\"" + found[1].str() + "\"")) << series << ": " << found[1];
  }

  const auto specimen = read(last("specimen")), bonds = read(last("bonds")),
             contacts = read(last("contacts"));
  vtkPointData *spheres = specimen->GetPointData();
  for (vtkIdType k = 0; k < specimen->GetNumberOfPoints(); ++k) {
    ASSERT_EQ(array(spheres, "diameter").GetComponent(k, 0), 2 * array(spheres, "radius").GetComponent(k, 0));
    ASSERT_GE(array(spheres, "coordination").GetComponent(k, 0),
              array(spheres, "intact_bonds").GetComponent(k, 0));
  }
  double touching = 0, history_touching = last_of("grain_contacts");
  for (vtkIdType k = 0; k < specimen->GetNumberOfPoints(); ++k)
    touching +=
        array(spheres, "coordination").GetComponent(k, 0) - array(spheres, "intact_bonds").GetComponent(k, 0);
  EXPECT_GT(touching, 0);
  EXPECT_EQ(touching, 2 * history_touching);

  // A bond's ids are those of its ends, its force is made of both parts.
  vtkCellData *of_bonds = bonds->GetCellData();
  bool loaded = false;
  for (vtkIdType k = 0; k < bonds->GetNumberOfCells(); ++k) {
    for (const int end : {0, 1})
      ASSERT_EQ(array(of_bonds, end == 0 ? "particle_a" : "particle_b").GetComponent(k, 0),
                array(spheres, "id").GetComponent(bonds->GetCell(k)->GetPointId(end), 0));
    const double normal = array(of_bonds, "normal_force").GetComponent(k, 0),
                 shear = array(of_bonds, "shear_force").GetComponent(k, 0);
    ASSERT_NEAR(size(vector(array(of_bonds, "force"), k)), std::hypot(normal, shear),
                1e-3 * std::hypot(normal, shear)); // bent, its shear is not quite across
    loaded = loaded || normal != 0;
  }
  EXPECT_TRUE(loaded);

  vtkPointData *of_contacts = contacts->GetPointData();
  ASSERT_GT(contacts->GetNumberOfPoints(), 0);
  for (vtkIdType k = 0; k < contacts->GetNumberOfPoints(); ++k) {
    const auto force = vector(array(of_contacts, "force"), k),
               normal = vector(array(of_contacts, "normal"), k),
               shear = vector(array(of_contacts, "shear"), k);
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(force[c], array(of_contacts, "normal_force").GetComponent(k, 0) * normal[c] + shear[c],
                  1e-12 * size(force));
  }

  // Rigid platens show how far they have gone: together what the specimen is shortened by.
  std::set<fs::path> platens; // two of each frame
  for (const auto &entry : fs::directory_iterator(run_ / "frames"))
    if (entry.path().filename().string().rfind("platens_", 0) == 0) platens.insert(entry.path());
  double up = 0, down = 0; // m
  for (auto file = std::prev(platens.end(), 2); file != platens.end(); ++file) {
    const auto platen = read(*file);
    vtkDataArray &displacement = array(platen->GetPointData(), "displacement");
    const double along = displacement.GetComponent(0, 2);
    for (vtkIdType k = 0; k < platen->GetNumberOfPoints(); ++k)
      ASSERT_DOUBLE_EQ(displacement.GetComponent(k, 2), along);
    up = std::max(up, along), down = std::min(down, along);
  }
  const double closure = 0.02 * last_of("axial_strain_platen");
  EXPECT_GT(closure, 1e-4);
  EXPECT_NEAR(up - down, closure, 1e-6 * closure);

  // Field data of the frame: the last row of the history.
  const auto of_frame = [&](const char *name) {
    return specimen->GetFieldData()->GetArray(name)->GetComponent(0, 0);
  };
  EXPECT_EQ(of_frame("TimeValue"), last_of("time_s"));
  EXPECT_NEAR(of_frame("axial_strain"), last_of("axial_strain_platen"), 1e-12);
  const double stress = 0.5 * (last_of("axial_stress_top_pa") + last_of("axial_stress_bottom_pa"));
  EXPECT_NEAR(of_frame("axial_stress"), stress, 1e-9 * std::abs(stress));

  // A disc for each row of cracks.csv, of its area and across its normal.
  const auto cracks = read(run_ / "cracks.vtu");
  const std::vector<double> area = column_of(run_ / "cracks.csv", "area_m2"),
                            time = column_of(run_ / "cracks.csv", "time_s"),
                            z = column_of(run_ / "cracks.csv", "z_m");
  ASSERT_EQ(cracks->GetNumberOfCells(), static_cast<vtkIdType>(area.size()));
  ASSERT_GT(area.size(), 500u);
  for (vtkIdType k = 0; k < cracks->GetNumberOfCells(); k += 37) {
    vtkCell *disc = cracks->GetCell(k);
    double normal[3], middle = 0;
    const double drawn =
        vtkPolygon::ComputeArea(disc->GetPoints(), disc->GetNumberOfPoints(), nullptr, normal);
    const auto row = static_cast<std::size_t>(k);
    EXPECT_NEAR(drawn, area[row], 1e-6 * area[row]);
    for (int c = 0; c < 12; ++c)
      middle += disc->GetPoints()->GetPoint(c)[2] / 12;
    EXPECT_NEAR(middle, z[row], 1e-9);
    EXPECT_EQ(array(cracks->GetCellData(), "time").GetComponent(k, 0), time[row]);
    const auto told = vector(array(cracks->GetCellData(), "normal"), k);
    EXPECT_NEAR(std::abs(told[0] * normal[0] + told[1] * normal[1] + told[2] * normal[2]), 1, 1e-6);
  }
}

// The loop makes several steps at a time: none of them passes over a row that is due.
TEST_F(Crushed, rows_by_time_are_the_first_step_at_or_after_each_multiple) {
  const auto times = [&](const std::string &every) {
    crush("run", {"Output/Every = " + every, "Loading/Target strain = 0.0005"}, {"--overwrite"});
    return column("run", "time_s");
  };
  const std::vector<double> all = times("1"), rows = times("3.7 us");
  std::vector<double> due{0};
  for (std::size_t k = 1; k < all.size(); ++k)
    if (std::floor(all[k] / 3.7e-6) > std::floor(all[k - 1] / 3.7e-6)) due.push_back(all[k]);
  ASSERT_GT(all.size(), 3 * due.size());
  EXPECT_EQ(rows, due);
}

} // namespace
} // namespace platen::apps::testing
