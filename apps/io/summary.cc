#include "apps/io/summary.h"

#include <limits>

#include "apps/io/file.h"

namespace platen::apps {

void write_summary(const std::filesystem::path &path, const Json &summary) {
  write_text_aside(path, summary.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

double number_in(const Json &summary, const std::string &key) {
  if (const auto slash = key.find('/'); slash != std::string::npos) {
    const auto object = summary.find(key.substr(0, slash));
    if (object != summary.end() && object->is_object()) return number_in(*object, key.substr(slash + 1));
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto found = summary.find(key);
  const bool measured = found != summary.end() && found->is_number();
  return measured ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

} // namespace platen::apps
