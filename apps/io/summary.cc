#include "apps/io/summary.h"

#include "apps/io/file.h"

namespace platen::apps {

void write_summary(const std::filesystem::path &path, const Json &summary) {
  write_text_aside(path, summary.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

} // namespace platen::apps
