// Specimens and lists of ids from text files; apps/output/specimen_csv.h writes them.
//   # shape: cylinder radius_m=0.025 height_m=0.1
//   x_m,y_m,z_m,radius_m
//   0.001,-0.0024,0.0013,0.0012
// or, in the first line, "box width_x_m=... width_y_m=... height_m=...", "disc radius_m=... thickness_m=...".
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/packing/specimen.h"

namespace platen::apps {

// The line above the rows, and what begins the line of the shape.
constexpr std::string_view specimen_header = "x_m,y_m,z_m,radius_m";
constexpr std::string_view specimen_shape_words = "# shape:";

// How a file lists spheres (apps/scene/specimen_formats.h). Automatic: as its first lines look.
enum class SpecimenFormat { automatic, columns, yade, lammps_data, lammps_dump };

struct SpecimenForm {
  SpecimenFormat format = SpecimenFormat::automatic;
  std::string columns = {}; // names, of a file without a header; "": it has one
  // What the spheres fill where the file states no shape, a box or a standing cylinder: they are moved so
  // that they stand on z = 0, in the middle about x = y = 0. None: the shape stays empty.
  std::optional<dem::ShapeKind> filled = std::nullopt;
  bool with_ids = false;
};

struct SpecimenFile {
  dem::Specimen specimen;
  bool states_shape = false;      // else specimen.shape is empty, or found, or the scene must say what it is
  std::vector<double> ids;        // of its column "id", if asked for and there
  std::vector<std::string> notes; // what was taken for granted
};

// Reads such a file, also one from elsewhere: comment lines (#), empty lines, CR LF, a byte order mark and
// blanks around numbers are taken. Throws InputError with file, line, column and value where a column is
// missing or there twice, its unit is not known, a row has too few or too many values, a number is none or
// not finite, or a radius is not positive; and where no sphere is there.
SpecimenFile read_specimen_file(const std::filesystem::path &path, const SpecimenForm &form);
inline SpecimenFile read_specimen_csv(const std::filesystem::path &path) {
  return read_specimen_file(path, {});
}

// The numbers of the file in its order: whole, not negative, one a line; empty lines and what follows a "#"
// are passed over. Throws InputError, naming file and line, where the file cannot be read, a line holds
// something else, or a number comes twice, or is not below the number of spheres that there are.
std::vector<int> read_id_list(const std::filesystem::path &path,
                              std::size_t spheres = std::numeric_limits<std::size_t>::max());

} // namespace platen::apps
