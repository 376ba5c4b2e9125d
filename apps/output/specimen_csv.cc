#include "apps/output/specimen_csv.h"

#include <fmt/format.h>

#include <functional>
#include <iterator>
#include <string>

namespace platen::apps {
namespace {

constexpr std::size_t write_bytes = 1 << 20; // of text collected before it is written

std::string shape_line(const dem::Shape &shape) {
  if (shape.kind == dem::ShapeKind::cylinder)
    return fmt::format("{} cylinder radius_m={} height_m={}\n", specimen_shape_words, shape.radius,
                       shape.height);
  if (shape.kind == dem::ShapeKind::disc)
    return fmt::format("{} disc radius_m={} thickness_m={}\n", specimen_shape_words, shape.radius,
                       shape.width_y);
  return fmt::format("{} box width_x_m={} width_y_m={} height_m={}\n", specimen_shape_words, shape.width_x,
                     shape.width_y, shape.height);
}

// What a text file of spheres begins with, and the row of one.
struct SpecimenText {
  std::string head;
  std::function<void(std::string &, std::size_t)> add_row;
};

void write_rows(OutputFile &to, const SpecimenText &rows, std::size_t count) {
  std::string text = rows.head;
  for (std::size_t k = 0; k < count; ++k) {
    rows.add_row(text, k);
    if (text.size() < write_bytes) continue;
    to.write(text);
    text.clear();
  }
  to.write(text);
}

void write_whole(const std::filesystem::path &path, const SpecimenText &rows, std::size_t count) {
  write_aside(path, [&](const std::filesystem::path &part) {
    OutputFile file(part);
    write_rows(file, rows, count);
    file.close();
  });
}

// x, y, z and radius with something between them.
std::function<void(std::string &, std::size_t)> row_of_four(const dem::Specimen &s, char between) {
  return [&s, between](std::string &text, std::size_t k) {
    const Vector3 &c = s.centre[k];
    fmt::format_to(std::back_inserter(text), "{}{}{}{}{}{}{}\n", c.x, between, c.y, between, c.z, between,
                   s.radius[k]);
  };
}

SpecimenText as_yade(const dem::Specimen &s) {
  return {"#format x_y_z_r\n" + shape_line(s.shape), row_of_four(s, '\t')};
}

SpecimenText as_lammps_data(const dem::Specimen &s, double density) {
  const dem::BoundingBox box = dem::bounding_box(s.shape);
  std::string head =
      fmt::format("LAMMPS data file of platen-pack, units = si\n{}\n{} atoms\n1 atom types\n\n",
                  shape_line(s.shape), s.size());
  for (int axis = 0; axis < 3; ++axis)
    head += fmt::format("{0} {1} {2}lo {2}hi\n", box.low[axis], box.high[axis], "xyz"[axis]);
  return {head + "\nAtoms # sphere\n\n", [&s, density](std::string &text, std::size_t k) {
            const Vector3 &c = s.centre[k];
            fmt::format_to(std::back_inserter(text), "{} 1 {} {} {} {} {}\n", k + 1, 2 * s.radius[k], density,
                           c.x, c.y, c.z);
          }};
}

SpecimenText as_lammps_dump(const dem::Specimen &s) {
  const dem::BoundingBox box = dem::bounding_box(s.shape);
  std::string head = fmt::format(
      "ITEM: UNITS\nsi\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{}\n"
      "ITEM: BOX BOUNDS ff ff ff\n",
      s.size());
  for (int axis = 0; axis < 3; ++axis)
    head += fmt::format("{} {}\n", box.low[axis], box.high[axis]);
  return {head + "ITEM: ATOMS id type x y z radius\n",
          [row = row_of_four(s, ' ')](std::string &text, std::size_t k) {
            fmt::format_to(std::back_inserter(text), "{} 1 ", k + 1);
            row(text, k);
          }};
}

} // namespace

void write_specimen_csv(OutputFile &to, const dem::Specimen &specimen) {
  const std::string head = shape_line(specimen.shape) + std::string(specimen_header) + '\n';
  write_rows(to, {head, row_of_four(specimen, ',')}, specimen.size());
}

void write_specimen_csv(const std::filesystem::path &path, const dem::Specimen &specimen) {
  write_aside(path, [&](const std::filesystem::path &part) {
    OutputFile file(part);
    write_specimen_csv(file, specimen);
    file.close();
  });
}

void write_specimen_as(SpecimenFormat format, const std::filesystem::path &folder,
                       const dem::Specimen &specimen, double grain_density) {
  const std::size_t count = specimen.size();
  if (format == SpecimenFormat::yade) write_whole(folder / "specimen.yade.txt", as_yade(specimen), count);
  if (format == SpecimenFormat::lammps_data)
    write_whole(folder / "specimen.data", as_lammps_data(specimen, grain_density), count);
  if (format == SpecimenFormat::lammps_dump)
    write_whole(folder / "specimen.dump", as_lammps_dump(specimen), count);
}

} // namespace platen::apps
