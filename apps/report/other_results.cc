#include "apps/report/other_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "apps/report/head.h"
#include "apps/scene/regular_file.h"

namespace platen::apps::report {

namespace fs = std::filesystem;

Json summary_of(const fs::path &folder) {
  std::ifstream stream = open_file(folder / "summary.json");
  Json summary = Json::parse(stream, nullptr, false);
  return summary.is_object() ? summary : Json::object();
}

std::string title_of(const Json &summary, const fs::path &folder) {
  const auto told = summary.find("scene");
  if (told == summary.end() || !told->is_string()) return folder.filename().string();
  return true_title(told->get<std::string>(), folder, summary);
}

// Numbers of the summary as they stand there: key and value.
TableOfFigures numbers_of(const Json &summary, const std::vector<std::string> &left_out) {
  TableOfFigures table{{"figure (SI)", "value"}, {}};
  for (const auto &[key, value] : summary.items()) {
    if (std::find(left_out.begin(), left_out.end(), key) != left_out.end()) continue;
    if (value.is_number()) table.rows.push_back({key, fmt::format("{:.6g}", value.get<double>())});
  }
  return table;
}

std::string app_of(const fs::path &folder) {
  const Json summary = summary_of(folder);
  const auto told = summary.find("app");
  if (told != summary.end() && told->is_string()) return told->get<std::string>();
  return fs::exists(folder / "specimen.csv") && !fs::exists(folder / "history.csv") ? "platen-pack" : "";
}

Reader reader_of(const fs::path &folder) {
  const std::string app = app_of(folder);
  if (app == "platen-pack") return write_pack_report;
  if (app == "platen-bonds") return write_bonds_report;
  if (app == "platen-bar") return write_bar_report;
  return nullptr;
}

} // namespace platen::apps::report
