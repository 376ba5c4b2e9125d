#include "apps/io/summary.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

#include "apps/io/file.h"
#include "apps/io/sha256.h"
#include "dem/measure/acoustic_emission.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char *checksum_key = "checksum";
constexpr std::string_view checksum_line = "  \"checksum\":", object_end = "\n}";

// The lines of a text but those of the checksum; members of inner objects are indented further.
std::string without_checksum(std::string_view text) {
  std::string rest;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end == std::string_view::npos ? end : end + 1);
    if (line.substr(0, checksum_line.size()) != checksum_line) rest += line;
    text.remove_prefix(line.size());
  }
  return rest;
}

} // namespace

void write_summary(const fs::path &path, const Json &summary) {
  Json content = summary;
  content.erase(checksum_key);
  content[checksum_key] = "";
  std::string text = content.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
  const std::string sum = sha256_of(without_checksum(text));
  text.insert(text.size() - object_end.size() - 2, sum); // between the quotes
  write_text_aside(path, text);
}

ReadSummary read_summary(const fs::path &path) {
  std::error_code none;
  if (!fs::exists(path, none)) return {nullptr, "is missing"};
  if (!fs::is_regular_file(path, none)) return {nullptr, "is no file"};
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  ReadSummary read{Json::parse(text, nullptr, false), ""};
  if (!read.summary.is_object()) return {nullptr, "is damaged: it is no JSON object"};
  const std::string sum = text_in(read.summary, checksum_key);
  if (sum.empty()) {
    read.fault = "has no checksum, older versions wrote none: nothing shows that it is as it was written";
  } else if (sum != sha256_of(without_checksum(text))) {
    read.fault = "has been changed since it was written: its checksum does not hold";
    read.changed = true;
  }
  return read;
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

} // namespace platen::apps
