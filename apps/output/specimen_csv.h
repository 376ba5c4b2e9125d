// Text files that list spheres, one a row in full precision, as apps/scene/specimen_file.h reads them.
#pragma once

#include <filesystem>

#include "apps/output/file.h"
#include "apps/scene/specimen_file.h"

namespace platen::apps {

// Writes shape and spheres so that they read back to the same bits. Throws OutputError.
void write_specimen_csv(const std::filesystem::path &path, const dem::Specimen &specimen);
// The same to the end of an open file.
void write_specimen_csv(OutputFile &to, const dem::Specimen &specimen);

// The spheres as another program reads them, to the same bits: specimen.yade.txt, specimen.data or
// specimen.dump in `folder`, with ids from 1 and the density of the grains (kg/m3) where the format has them.
// Throws OutputError.
void write_specimen_as(SpecimenFormat format, const std::filesystem::path &folder,
                       const dem::Specimen &specimen, double grain_density);

} // namespace platen::apps
