// Pictures within a page.
#pragma once

#include <filesystem>
#include <string>

namespace platen::apps::report {

// A PNG as the source of an <img>: as it is, or as JPEG where that takes less than half of it, which shaded
// spheres do and charts do not. Throws OutputError where it cannot be read back.
std::string source_of_picture(const std::filesystem::path &png);

} // namespace platen::apps::report
