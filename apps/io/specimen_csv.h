// Text files that list spheres, one a row in full precision, as apps/scene/specimen_file.h reads them.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "apps/scene/specimen_file.h"

namespace platen::apps {

// Writes shape and spheres so that they read back to the same bits. Throws OutputError.
void write_specimen_csv(const std::filesystem::path &path, const dem::Specimen &specimen);
// The same text in pieces, one after the other.
void tell_specimen_csv(const dem::Specimen &specimen, const std::function<void(std::string_view)> &take);

} // namespace platen::apps
