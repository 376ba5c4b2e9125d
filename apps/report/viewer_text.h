// The element of a report's page in which the specimen is turned, as text.
#pragma once

#include <string_view>

namespace platen::apps::report {

extern const std::string_view viewer_html;    // with @META@, @DATA@ and @PROGRAM@ to be filled
extern const std::string_view viewer_program; // JavaScript

} // namespace platen::apps::report
