#include <cstdio>
#include <map>
#include <ostream>
#include <set>
#include <utility>

#include "apps/report/html_page.h"
#include "apps/report/study_pictures.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

// Cases that differ in platens and slenderness alone, by sphere radius and pressure.
std::map<std::pair<double, double>, std::vector<std::size_t>> groups_of(const StudyResults &study) {
  std::map<std::pair<double, double>, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < study.cases.size(); ++k)
    groups[{study.cases[k].sphere_radius, study.cases[k].pressure}].push_back(k);
  return groups;
}

std::string group_words(const std::pair<double, double> &group) {
  char text[96];
  std::snprintf(text, sizeof text, " Spheres of %.3g mm, cell pressure %.3g MPa.", 1e3 * group.first,
                1e-6 * group.second);
  return text;
}

} // namespace

void write_study_report(const StudyResults &study, const fs::path &folder, std::ostream &out) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": cannot be made: " + error.message());
  std::vector<Picture> drawn;
  const auto groups = groups_of(study);
  for (const auto &[group, cases] : groups) {
    std::set<double> frictions, slendernesses;
    for (const std::size_t k : cases) {
      if (study.cases[k].plain) frictions.insert(study.cases[k].friction);
      slendernesses.insert(study.cases[k].slenderness);
    }
    const std::string number = drawn.empty() ? "" : "_" + std::to_string(drawn.size()),
                      which = groups.size() > 1 ? group_words(group) : "";
    if (frictions.size() > 1) {
      const fs::path png = folder / ("strength_friction" + number + ".png");
      draw_friction(study, cases, png);
      drawn.push_back({png,
                       "Strength against the friction of the platens, and its gain over free ends; bars: "
                       "standard deviation over the seeds, range of the laboratory." +
                           which});
    }
    if (slendernesses.size() > 1) {
      const fs::path png = folder / ("strength_slenderness" + number + ".png");
      draw_slenderness(study, cases, png);
      drawn.push_back({png,
                       "Strength against height over width, and its ratio to that at 2; bars: standard "
                       "deviation over the seeds, range of the laboratory." +
                           which});
    }
  }
  std::vector<std::string> remarks = study.remarks;
  if (drawn.empty()) remarks.push_back("one friction and one slenderness: there is no curve to draw");
  const TableOfFigures table = table_of_study(study);
  write_page(study.title, table, remarks, {{"", drawn}}, folder / "report.html");
  for (const std::string &remark : remarks)
    out << remark << '\n';
  for (const Picture &picture : drawn)
    out << "drawn: " << picture.file.string() << '\n';
  out << "page: " << (folder / "report.html").string() << "\n\n" << as_text(table);
}

} // namespace platen::apps::report
