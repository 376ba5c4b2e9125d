// The figures of a run: summary.json.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace platen::apps {

using Json = nlohmann::ordered_json; // keys stay in the order in which they were given

// Writes aside and renames, so that a summary that is there is whole. Numbers that are not finite become
// null, numbers are written in full precision, text that is not UTF-8 gets replacement characters. Throws
// OutputError.
void write_summary(const std::filesystem::path &path, const Json &summary);

// A number of a summary by its key, `object/member` for that of an object; NaN where it is no number or is
// not there.
double number_in(const Json &summary, const std::string &key);

} // namespace platen::apps
