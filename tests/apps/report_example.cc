#include "apps/report_example.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;
using Point = std::array<double, 3>;

struct Bond {
  std::size_t a, b;
  bool breaks, in_tension;
};

struct Example {
  ExampleRun run;
  std::vector<Point> centres;
  std::vector<double> radii;
  std::vector<Bond> bonds;
};

double distance(const Point &a, const Point &b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// A shaken close packing: layers of triangles.
void fill(Example &example) {
  const ExampleRun &run = example.run;
  const double s = run.spacing, row = s * std::sqrt(0.75), layer = s * std::sqrt(2.0 / 3.0), r = 0.5 * s;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shake(-0.12 * s, 0.12 * s);
  const int reach = static_cast<int>(run.radius / s) + 2;
  for (int k = 0; r + k * layer <= run.height - r; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i) {
        const double x = (i + 0.5 * (j & 1) + 0.5 * (k & 1)) * s + shake(random);
        const double y = (j + (k & 1) / 3.0) * row + shake(random);
        if ((run.square ? std::max(std::abs(x), std::abs(y)) : std::hypot(x, y)) > run.radius - r) continue;
        example.centres.push_back({x, y, run.first_height + r + k * layer});
        example.radii.push_back(r * (0.85 + 0.1 * (shake(random) / s)));
      }
}

bool in_destroyed_part(const ExampleRun &run, double z) {
  const double height = (z - run.first_height) / run.height, from_middle = std::abs(height - 0.5);
  return run.hourglass == (from_middle < 0.25);
}

void join(Example &example) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> draw(0, 1);
  for (std::size_t a = 0; a < example.centres.size(); ++a)
    for (std::size_t b = a + 1; b < example.centres.size(); ++b) {
      if (example.centres[b][2] - example.centres[a][2] > 1.3 * example.run.spacing)
        break; // layers come in order
      if (distance(example.centres[a], example.centres[b]) > 1.15 * example.run.spacing) continue;
      const double z = 0.5 * (example.centres[a][2] + example.centres[b][2]);
      example.bonds.push_back(
          {a, b, in_destroyed_part(example.run, z) && draw(random) < 0.8, draw(random) < 0.9});
    }
}

Point displacement(const Example &example, const Point &p, double time) {
  const double height = (p[2] - example.run.first_height) / example.run.height;
  const double shape =
      example.run.hourglass ? std::sin(3.14159265 * height) : 1 - 0.8 * std::sin(3.14159265 * height);
  const double outward = 0.02 * shape * std::max(0.0, time - 0.8 * example_peak_time);
  return {outward * p[0], outward * p[1], -0.0025 * time * height * example.run.height};
}

vtkSmartPointer<vtkDoubleArray> column(const char *name, int components) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  return array;
}

void write_vtu(const fs::path &file, vtkUnstructuredGrid *grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(file.c_str());
  writer->Write();
}

// Of an hourglass: 1 in the lowest, 2 in the highest third.
int end_that_holds(const ExampleRun &run, const Point &p) {
  const double share = (p[2] - run.first_height) / run.height;
  return !run.hourglass ? 0 : share < 1. / 3 ? 1 : share > 2. / 3 ? 2 : 0;
}

void write_spheres(const fs::path &file, const Example &example, double time) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  const auto radius = column("radius", 1), moved = column("displacement", 3),
             intact = column("intact_bonds", 1), broken = column("broken_bonds", 1), id = column("id", 1),
             fragment = column("fragment", 1), moves_with = column("moves_with", 1);
  std::vector<std::array<int, 2>> counts(example.centres.size(), {0, 0});
  for (const Bond &bond : example.bonds)
    for (const std::size_t end : {bond.a, bond.b})
      ++counts[end][bond.breaks && time >= example_fall_time ? 1 : 0];
  for (std::size_t k = 0; k < example.centres.size(); ++k) {
    const Point &p = example.centres[k], u = displacement(example, p, time);
    points->InsertNextPoint(p[0] + u[0], p[1] + u[1], p[2] + u[2]);
    radius->InsertNextValue(example.radii[k]);
    moved->InsertNextTuple(u.data());
    intact->InsertNextValue(counts[k][0]);
    broken->InsertNextValue(counts[k][1]);
    id->InsertNextValue(static_cast<double>(100 + k));
    moves_with->InsertNextValue(time < example_fall_time ? 0 : end_that_holds(example.run, p));
    fragment->InsertNextValue(p[2] > example.run.first_height + 0.5 * example.run.height ? 0 : 1);
  }
  grid->SetPoints(points);
  for (const auto &array : {radius, moved, intact, broken, id, fragment, moves_with})
    grid->GetPointData()->AddArray(array);
  for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k)
    grid->InsertNextCell(VTK_VERTEX, 1, &k);
  write_vtu(file, grid);
}

void write_bonds(const fs::path &file, const Example &example, double time) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  const auto state = column("state", 1);
  for (const Point &p : example.centres) {
    const Point u = displacement(example, p, time);
    points->InsertNextPoint(p[0] + u[0], p[1] + u[1], p[2] + u[2]);
  }
  grid->SetPoints(points);
  for (const Bond &bond : example.bonds) {
    const vtkIdType ends[] = {static_cast<vtkIdType>(bond.a), static_cast<vtkIdType>(bond.b)};
    grid->InsertNextCell(VTK_LINE, 2, ends);
    state->InsertNextValue(!bond.breaks || time < example_fall_time ? 0 : bond.in_tension ? 2 : 3);
  }
  grid->GetCellData()->AddArray(state);
  write_vtu(file, grid);
}

void write_platens(const fs::path &file, const ExampleRun &run, double time) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  const double w = 1.2 * run.radius, t = 0.4 * run.radius,
               top = run.first_height + run.height * (1 - 0.0025 * time);
  for (const double z : {run.first_height - t, top}) {
    vtkIdType corners[8];
    int corner = 0;
    for (const double dz : {0.0, t})
      for (const auto &[x, y] : {std::array{-w, -w}, std::array{w, -w}, std::array{w, w}, std::array{-w, w}})
        corners[corner++] = points->InsertNextPoint(x, y, z + dz);
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
  }
  grid->SetPoints(points);
  write_vtu(file, grid);
}

// A sunflower of contacts at each end and a few of a sleeve's at mid-height.
void write_contacts(const fs::path &file, const ExampleRun &run, double time) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  const auto normal = column("normal", 3), shear = column("shear", 3), force = column("normal_force", 1),
             sliding = column("sliding", 1);
  constexpr int count = 2000;
  const double each = run.peak_stress * time * 3.14159265358979 * run.radius * run.radius / count;
  for (const double up : {1.0, -1.0})
    for (int k = 0; k < count; ++k) {
      const double share = (k + 0.5) / count, r = run.radius * std::sqrt(share), turn = 2.399963 * k;
      const double x = std::cos(turn), y = std::sin(turn),
                   inward = example_inward_shear * each * r / run.radius;
      points->InsertNextPoint(r * x, r * y, run.first_height + (up > 0 ? 0 : run.height));
      normal->InsertNextTuple3(0, 0, up);
      shear->InsertNextTuple3(-inward * x, -inward * y, 0);
      force->InsertNextValue(each);
      sliding->InsertNextValue(share > example_sticking_share ? 1 : 0);
    }
  for (int k = 0; k < 5; ++k) {
    points->InsertNextPoint(run.radius, 0, run.first_height + 0.1 * k * run.height);
    normal->InsertNextTuple3(-1, 0, 0);
    shear->InsertNextTuple3(0, 0, 0);
    force->InsertNextValue(1e3);
    sliding->InsertNextValue(0);
  }
  grid->SetPoints(points);
  for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k)
    grid->InsertNextCell(VTK_VERTEX, 1, &k);
  for (const auto &array : {normal, shear, force, sliding})
    grid->GetPointData()->AddArray(array);
  write_vtu(file, grid);
}

void write_frames(const fs::path &folder, const Example &example) {
  std::ofstream specimen(folder / "specimen.pvd"), bonds(folder / "bonds.pvd"),
      platens(folder / "platens.pvd"), contacts(folder / "contacts.pvd");
  for (std::ofstream *list : {&specimen, &bonds, &platens, &contacts})
    *list << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  int number = 0;
  for (const double time : {0.0, example_peak_time, example_fall_time, example_end_time}) {
    const auto entry = [&](std::ofstream &list, const char *name) {
      const std::string file = std::string(name) + std::to_string(number) + ".vtu";
      list << "<DataSet timestep=\"" << time << "\" part=\"0\" file=\"" << file << "\"/>\n";
      return folder / file;
    };
    write_spheres(entry(specimen, "specimen_"), example, time);
    write_bonds(entry(bonds, "bonds_"), example, time);
    write_platens(entry(platens, "platens_"), example.run, time);
    write_contacts(entry(contacts, "contacts_"), example.run, time);
    ++number;
  }
  for (std::ofstream *list : {&specimen, &bonds, &platens, &contacts})
    *list << "</Collection>\n</VTKFile>\n";
}

double stress_at(const ExampleRun &run, double time) {
  const double before = std::sin(0.5 * 3.14159265358979 * time / example_peak_time);
  return run.peak_stress * (time <= example_peak_time ? before : 1 - 0.4 * (time - example_peak_time));
}

void write_history(const fs::path &folder, const Example &example) {
  std::ofstream out(folder / "history.csv");
  out << "time_s,axial_strain_platen,axial_strain_gauge,lateral_strain,volumetric_strain,axial_stress_top_pa,"
         "axial_stress_bottom_pa,confining_pressure_pa,intact_bonds,broken_tension,broken_shear,kinetic_"
         "energy_j,"
         "bond_energy_j,contact_energy_j,body_energy_j,damping_work_j,friction_work_j,fracture_work_j,"
         "boundary_work_j,energy_residual_j,unbalanced_force_ratio\n";
  const double volume = 3.14159265 * example.run.radius * example.run.radius * example.run.height;
  const double bonds = static_cast<double>(example.bonds.size());
  double work = 0, last = 0;
  for (int k = 0; k <= 100; ++k) {
    const double time = 0.02 * k, strain = 0.0025 * time, stress = stress_at(example.run, time);
    work += 0.5 * (stress + last) * 0.0025 * 0.02 * volume;
    last = stress;
    const double late = std::max(0.0, time - 0.5), broken = 0.2 * bonds * late * late;
    const double gauge = time < example_peak_time ? 0.9 * strain : 0.00225 - 0.3 * (strain - 0.0025);
    const double elastic = 0.45 * work / (1 + late), fracture = 0.5 * (work - elastic);
    out << time << ',' << strain << ',' << gauge << ',' << -0.17 * strain - 0.001 * late * late << ",0,"
        << stress << ',' << stress << ",0," << bonds - broken << ',' << 0.9 * broken << ',' << 0.1 * broken
        << ",1e-4," << elastic << ',' << 0.1 * (work - elastic) << ",0," << 0.15 * (work - elastic) << ','
        << 0.25 * (work - elastic) << ',' << fracture << ',' << work << ",1e-6,0.001\n";
  }
}

void write_cracks(const fs::path &folder, const Example &example) {
  std::ofstream out(folder / "cracks.csv");
  out << "time_s,axial_strain,x_m,y_m,z_m,nx,ny,nz,area_m2,mode,energy_j,particle_a,particle_b\n";
  for (const Bond &bond : example.bonds) {
    if (!bond.breaks) continue;
    const Point &a = example.centres[bond.a], &b = example.centres[bond.b];
    const double length = distance(a, b), r = std::min(example.radii[bond.a], example.radii[bond.b]);
    out << example_fall_time - 0.01 << ",0.0037";
    for (int d = 0; d < 3; ++d)
      out << ',' << 0.5 * (a[d] + b[d]);
    for (int d = 0; d < 3; ++d)
      out << ',' << (b[d] - a[d]) / length;
    out << ',' << 3.14159265 * r * r << ',' << (bond.in_tension ? "tension" : "shear") << ",1e-6,"
        << 100 + bond.a << ',' << 100 + bond.b << '\n';
  }
}

void write_summary(const fs::path &folder, const Example &example) {
  const ExampleRun &run = example.run;
  const double end = run.hourglass ? 0.12 : 0.55, middle = run.hourglass ? 0.7 : 0.1;
  nlohmann::json summary = {{"status", "done"},
                            {"strength_pa", run.peak_stress},
                            {"strain_at_peak_platen", 0.0025},
                            {"strain_at_peak_gauge", 0.00225},
                            {"youngs_modulus_gauge_pa", 25e9},
                            {"youngs_modulus_platen_pa", 22e9},
                            {"poisson_ratio", 0.17},
                            {"broken_tension", 900},
                            {"broken_shear", 100},
                            {"end_damage_top", end},
                            {"end_damage_bottom", end + 0.05},
                            {"middle_damage", middle},
                            {"end_spread", nullptr},
                            {"cone_top", nullptr},
                            {"cone_bottom", nullptr},
                            {"barrel_at_peak", 0.6}};
  if (run.hourglass) {
    summary["pattern"] = summary["final_pattern"] = "cones";
    for (const std::string key : {"cone_top", "cone_bottom", "final_cone_top", "final_cone_bottom"}) {
      const bool top = key.find("top") != std::string::npos;
      const auto cone = key.find("cone");
      summary[key.substr(0, cone) + "dead_zone" + key.substr(cone + 4)] = {{"base_ratio", top ? 0.9 : 0.95}};
      summary[key] = {{"half_angle_deg", top ? 45 : 30},
                      {"confidence", 0.8},
                      {"apex_m", {0, 0, run.first_height + (top ? 0.7 : 0.3) * run.height}},
                      {"axis", {0, 0, top ? 1 : -1}}};
    }
  } else {
    summary["pattern"] = summary["final_pattern"] = "crushing";
  }
  std::ofstream(folder / "summary.json") << summary.dump(2) << '\n';
}

} // namespace

void write_example(const fs::path &folder, const ExampleRun &run) {
  fs::create_directories(folder);
  Example example{run, {}, {}, {}};
  fill(example);
  join(example);
  write_frames(folder, example);
  write_history(folder, example);
  write_cracks(folder, example);
  write_summary(folder, example);
  std::ofstream(folder / "scene.prm")
      << "# made up\nsubsection Scene\n  set Title = Cylinder 50 mm x 100 mm, "
      << (run.hourglass ? "dry" : "lubricated") << " platens\nend\n";
}

} // namespace platen::apps::report
