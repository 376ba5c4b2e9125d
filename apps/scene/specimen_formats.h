// The forms in which programs list spheres as text: how a line becomes names of columns, a row, or nothing.
//   columns      a header line, rows; "#" begins a comment
//   yade         export.textExt of Yade: "#format x_y_z_r", rows with blanks
//   lammps data  what write_data of LAMMPS writes for atom_style sphere
//   lammps dump  dump custom of LAMMPS with x y z radius; of several frames the last
#pragma once

#include "apps/scene/specimen_file.h"
#include "apps/scene/text_table.h"

namespace platen::apps {

// A file of spheres on its way.
struct SpecimenReading {
  explicit SpecimenReading(const SpecimenForm &form);

  const SpecimenForm &form;
  TextPlace place;
  TextTable table;
  SpecimenFile read;
  // Of LAMMPS: what the lines are about, atoms that are told, atoms of the frame that is read.
  enum class Part { header, units, count, bounds, atoms, other };
  Part part = Part::header;
  std::optional<double> atoms;
  bool has_atoms = false, states_si = false;

  void take_row(std::string_view line);
  void take_comment(std::string_view line); // the shape stands in one
};

struct SpecimenFormatRule {
  const char *word; // Specimen/File format
  SpecimenFormat format;
  bool (*is_one)(const std::vector<std::string> &first_lines); // that have something in them
  void (*take)(SpecimenReading &, std::string_view line);      // trimmed, not empty
  void (*end)(SpecimenReading &);
};
// The last one is of all files.
const std::vector<SpecimenFormatRule> &specimen_formats();

} // namespace platen::apps
