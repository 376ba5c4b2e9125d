// The figures of a run: summary.json.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace platen::dem {
struct BValue;
}

namespace platen::apps {

class SeedStatistics;
using Json = nlohmann::ordered_json; // keys stay in the order in which they were given

// Writes aside and renames, so that an existing summary is complete. Numbers that are not finite become null,
// numbers are written in full precision, text that is not UTF-8 gets replacement characters. Throws
// OutputError.
void write_summary(const std::filesystem::path &path, const Json &summary);

// A summary that is read, and what is wrong with it.
struct ReadSummary {
  Json summary;      // an object; null if the file is missing or no such thing
  std::string fault; // "" if it is an object, else a sentence without the name of the file
};
ReadSummary read_summary(const std::filesystem::path &path);

// A number of a summary by its key, `object/member` for that of an object; NaN where it is no number or is
// not there.
double number_in(const Json &summary, const std::string &key);

// A text of a summary by its key; "" where it is none or is not there.
std::string text_in(const Json &summary, const std::string &key);

// Members of `acoustic` for one b-value: `key` ("b_before"), with its _error, the range of magnitudes
// that it is of (_limit, _upper: null where all from the limit on are), how many _events lie there and _above
// it, and the _reason where there is no b.
Json json_of_b(const dem::BValue &value, const std::string &key);

// Mean, deviation, low and high, and under the name `counted` ("runs") of how many.
Json json_of(const SeedStatistics &statistics, const char *counted);

} // namespace platen::apps
