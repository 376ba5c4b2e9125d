#include "apps/io/summary.h"

#include <limits>

#include "apps/io/file.h"

namespace platen::apps {

void write_summary(const std::filesystem::path &path, const Json &summary) {
  write_text_aside(path, summary.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

double number_in(const Json &summary, const std::string &key) {
  const Json::json_pointer place("/" + key);
  const bool measured = summary.contains(place) && summary[place].is_number();
  return measured ? summary[place].get<double>() : std::numeric_limits<double>::quiet_NaN();
}

} // namespace platen::apps
