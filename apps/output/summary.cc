#include "apps/output/summary.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "apps/output/file.h"
#include "apps/output/seed_statistics.h"
#include "dem/measure/acoustic_emission.h"

namespace platen::apps {

void write_summary(const std::filesystem::path &path, const Json &summary) {
  write_text_aside(path, summary.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

ReadSummary read_summary(const std::filesystem::path &path) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) return {nullptr, "is missing"};
  if (!std::filesystem::is_regular_file(path, none)) return {nullptr, "is no file"};
  std::ifstream file(path, std::ios::binary);
  const Json read = Json::parse(std::istreambuf_iterator<char>(file), {}, nullptr, false);
  if (!read.is_object()) return {nullptr, "is damaged: it is no JSON object"};
  return {read, ""};
}

double number_in(const Json &summary, const std::string &key) {
  const Json::json_pointer place("/" + key);
  const bool measured = summary.contains(place) && summary[place].is_number();
  return measured ? summary[place].get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string text_in(const Json &summary, const std::string &key) {
  const auto found = summary.find(key);
  return found != summary.end() && found->is_string() ? found->get<std::string>() : "";
}

Json json_of_b(const dem::BValue &value, const std::string &key) {
  const std::string reason = dem::reason_against(value);
  return {{key, value.b},
          {key + "_error", value.error},
          {key + "_events", static_cast<long>(value.events)},
          {key + "_limit", value.limit},
          {key + "_upper", std::isfinite(value.upper) ? Json(value.upper) : Json()},
          {key + "_above", static_cast<long>(value.above)},
          {key + "_reason", reason.empty() ? Json() : Json(reason)}};
}

Json json_of(const SeedStatistics &s, const char *counted) {
  return {{"mean", s.mean()},
          {"deviation", s.deviation()},
          {"low", s.least()},
          {"high", s.largest()},
          {counted, s.count()}};
}

} // namespace platen::apps
