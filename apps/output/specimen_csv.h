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

} // namespace platen::apps
