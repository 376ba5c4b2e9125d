// The script that lays a run's folder out in ParaView (apps/run/view.py), as text.
#pragma once

#include <string_view>

namespace platen::apps {

extern const std::string_view view_script;

} // namespace platen::apps
