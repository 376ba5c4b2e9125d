// Bytes as text that a page can hold.
#pragma once

#include <string>
#include <vector>

namespace platen::apps::report {

std::string base64(const std::vector<unsigned char> &bytes);

} // namespace platen::apps::report
