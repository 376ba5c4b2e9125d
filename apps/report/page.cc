#include "apps/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <ostream>

#include "apps/output/file.h"
#include "apps/report/embedded.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

struct Figure {
  const char *title;
  std::vector<const char *> keys; // the largest of them, or the least; a member of an object after "/"
  double factor;                  // from SI to the unit in the title
  int digits;
  bool only_if_measured; // no row where no run has it
  bool least = false;
};

const std::vector<Figure> figures = {
    {"strength (MPa)", {"strength_pa"}, 1e-6, 2, false},
    {"stress at the end (MPa)", {"stress_at_end_pa"}, 1e-6, 2, true},
    {"strain at peak, platens (mm/m)", {"strain_at_peak_platen"}, 1e3, 3, false},
    {"strain at peak, gauge (mm/m)", {"strain_at_peak_gauge"}, 1e3, 3, false},
    {"Young's modulus, gauge (GPa)", {"youngs_modulus_gauge_pa"}, 1e-9, 2, false},
    {"Young's modulus, platens (GPa)", {"youngs_modulus_platen_pa"}, 1e-9, 2, false},
    {"Poisson's ratio", {"poisson_ratio"}, 1, 3, false},
    {"tensile strength (MPa)", {"tensile_strength_pa"}, 1e-6, 2, true},
    {"bonds broken in tension", {"broken_tension"}, 1, 0, false},
    {"bonds broken in shear", {"broken_shear"}, 1, 0, false},
    {"damage of the worse end", {"end_damage_top", "end_damage_bottom"}, 1, 3, false},
    {"damage of the middle", {"middle_damage"}, 1, 3, false},
    {"spread of the ends", {"end_spread"}, 1, 3, false},
    {"barrel at peak", {"barrel_at_peak"}, 1, 3, false},
    {"base of the worse end's cone, r0",
     {"dead_zone_top/base_ratio", "dead_zone_bottom/base_ratio"},
     1,
     2,
     true,
     true},
    {"half-angle of the top cone (degrees)", {"cone_top/half_angle_deg"}, 1, 1, true},
    {"half-angle of the bottom cone", {"cone_bottom/half_angle_deg"}, 1, 1, true},
    {"top cone at the end", {"final_cone_top/half_angle_deg"}, 1, 1, true},
    {"bottom cone at the end", {"final_cone_bottom/half_angle_deg"}, 1, 1, true},
    {"b-value before the peak", {"acoustic/b_before"}, 1, 2, true},
    {"b-value after the peak", {"acoustic/b_after"}, 1, 2, true},
};

// NaN where the run did not measure it.
double value_of(const Run &run, const Figure &figure) {
  double value = std::nan("");
  for (const char *key : figure.keys) {
    const double one = number_in(run.summary, key) * figure.factor;
    value = figure.least ? std::fmin(value, one) : std::fmax(value, one);
  }
  return value;
}

std::string fixed(double value, int digits) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, digits);
}

std::vector<std::string> row_of(const Figure &figure, const std::vector<Run> &runs,
                                const std::vector<double> &values) {
  const bool strength = figure.keys.front() == std::string("strength_pa");
  std::vector<std::string> row{figure.title};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool without_peak = strength && !runs[k].peak_reached().value_or(true);
    row.push_back(!without_peak           ? fixed(values[k], figure.digits)
                  : std::isnan(values[k]) ? "no peak reached"
                                          : fixed(values[k], figure.digits) + ", no peak reached");
  }
  for (std::size_t k = 1; k < values.size(); ++k)
    row.push_back(values[k] == 0 ? "-" : fixed(values[0] / values[k], 3));
  return row;
}

// Words of the summaries; no gain. Nothing where no run has them.
std::vector<std::string> row_of_words(const char *title, const char *key, const std::vector<Run> &runs) {
  std::vector<std::string> row{title};
  bool told = false;
  for (const Run &run : runs) {
    const auto found = run.summary.find(key);
    const bool here = found != run.summary.end() && found->is_string();
    row.push_back(here ? found->get<std::string>() : "-");
    told = told || here;
  }
  row.resize(2 * runs.size(), "-");
  return told ? row : std::vector<std::string>{};
}

// "valid", the reasons against it, or "-".
std::string verdict_on(const Run &run, const std::string &key) {
  const auto validity = run.summary.find("validity");
  if (validity == run.summary.end() || !validity->is_object()) return "-";
  const auto verdict = validity->find(key);
  if (verdict == validity->end()) return "-";
  if (verdict->is_string()) return verdict->get<std::string>();
  std::string reasons;
  if (verdict->is_array())
    for (const Json &reason : *verdict)
      if (reason.is_string()) reasons += (reasons.empty() ? "not valid: " : "; ") + reason.get<std::string>();
  return reasons.empty() ? "-" : reasons;
}

constexpr const char *style_sheet = R"(<style>
body { font-family: sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #111; background: #fff; }
table { border-collapse: collapse; margin-bottom: 1.5rem; } td, th { padding: 0.2rem 1rem; border-bottom: 1px solid #ccc; text-align: right; }
td:first-child, th:first-child { text-align: left; padding-left: 0; }
h2 { margin-top: 3rem; border-bottom: 2px solid #0072b2; } nav { margin: 1rem 0; } a { color: #0072b2; }
@media (max-width: 40rem) { body { margin: 0.5rem auto; padding: 0 0.6rem; } table { display: block; overflow-x: auto; } td, th { padding: 0.2rem 0.5rem; } }
figure { margin: 1.5rem 0 2.5rem; } img { max-width: 100%; } figcaption { margin-top: 0.5rem; color: #333; }
</style>
)";

std::string html_row(const std::vector<std::string> &fields, const std::string &kind) {
  std::string row = "<tr>";
  for (const std::string &field : fields)
    row.append("<").append(kind).append(">").append(escaped(field)).append("</").append(kind).append(">");
  return row + "</tr>\n";
}

std::string html_table(const TableOfFigures &table) {
  std::string html = "<table>\n" + html_row(table.header, "th");
  for (const auto &row : table.rows)
    html += html_row(row, "td");
  return html + "</table>\n";
}

} // namespace

TableOfFigures table_of_figures(const std::vector<Run> &runs) {
  TableOfFigures table;
  table.header = {"figure"};
  for (const Run &run : runs)
    table.header.push_back(run.name);
  for (std::size_t k = 1; k < runs.size(); ++k)
    table.header.push_back(runs[0].name + " / " + runs[k].name);

  for (const Figure &figure : figures) {
    std::vector<double> values;
    for (const Run &run : runs)
      values.push_back(value_of(run, figure));
    const bool measured = std::any_of(values.begin(), values.end(), [](double v) { return !std::isnan(v); });
    if (measured || !figure.only_if_measured) table.rows.push_back(row_of(figure, runs, values));
  }
  for (const auto &[title, key] :
       {std::pair{"pattern", "pattern"}, std::pair{"pattern at the end", "final_pattern"}})
    if (std::vector<std::string> row = row_of_words(title, key, runs); !row.empty())
      table.rows.push_back(std::move(row));
  return table;
}

TableOfFigures table_of_validity(const std::vector<Run> &runs) {
  TableOfFigures table;
  table.header = {"figure"};
  std::vector<std::string> keys;
  for (const Run &run : runs) {
    table.header.push_back(run.name);
    const auto validity = run.summary.find("validity");
    if (validity == run.summary.end() || !validity->is_object()) continue;
    for (const auto &[key, verdict] : validity->items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  }
  for (const std::string &key : keys) {
    table.rows.push_back({key});
    for (const Run &run : runs)
      table.rows.back().push_back(verdict_on(run, key));
  }
  return table;
}

std::string as_text(const TableOfFigures &table) {
  std::vector<std::vector<std::string>> lines{table.header};
  lines.insert(lines.end(), table.rows.begin(), table.rows.end());
  std::vector<std::size_t> widths(table.header.size());
  for (const auto &line : lines)
    for (std::size_t k = 0; k < line.size(); ++k)
      widths[k] = std::max(widths[k], line[k].size());
  std::string text;
  for (const auto &line : lines) {
    for (std::size_t k = 0; k < line.size(); ++k) { // by bytes, as the widths: fmt would count letters
      const std::string gap(widths[k] - line[k].size(), ' ');
      text += k == 0 ? line[k] + gap : "  " + gap + line[k];
    }
    text += '\n';
    if (&line == &lines.front())
      text += std::string(std::accumulate(widths.begin(), widths.end(), 2 * (widths.size() - 1)), '-') + '\n';
  }
  return text;
}

std::string escaped(const std::string &text) {
  static const std::map<char, const char *> entities = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string html;
  for (const char letter : text)
    if (const auto entity = entities.find(letter); entity != entities.end())
      html += entity->second;
    else
      html += letter;
  return html;
}

Album::Album(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw OutputError(folder_.string() + ": cannot be made: " + error.message());
}

std::size_t Album::size() const {
  std::size_t count = 0;
  for (const Section &section : sections_)
    count += section.pictures.size();
  return count;
}

std::string Album::Section::anchor() const {
  std::string anchor = escaped(heading);
  std::replace(anchor.begin(), anchor.end(), ' ', '-');
  return anchor;
}

std::string Album::Section::html() const {
  std::string html;
  if (!is_empty() && !heading.empty())
    html = fmt::format("<h2 id=\"{}\">{}</h2>\n", anchor(), escaped(heading));
  for (const TableOfFigures &table : tables)
    html += html_table(table);
  html += element;
  for (const Picture &picture : pictures)
    html += fmt::format(
        "<figure><img alt=\"{0}\" src=\"{1}\">"
        "<figcaption>{0}</figcaption></figure>\n",
        escaped(picture.caption), source_of_picture(picture.file));
  return html;
}

void Album::finish(const std::string &title, const TableOfFigures &figures,
                   const std::vector<std::string> &remarks, std::ostream &out) const {
  std::string links, sections, list, head, head_in_words;
  for (const Lead &lead : head_) {
    if (!lead.sentence.empty()) head += "<p><strong>" + escaped(lead.sentence) + "</strong></p>\n";
    if (!lead.sentence.empty()) head_in_words += lead.sentence + '\n';
    if (lead.table.rows.empty()) continue;
    head += html_table(lead.table);
    head_in_words += as_text(lead.table) + '\n';
  }
  for (const Section &section : sections_) {
    if (!section.is_empty() && !section.heading.empty())
      links += fmt::format("{}<a href=\"#{}\">{}</a>", links.empty() ? "<nav>" : " &middot; ",
                           section.anchor(), escaped(section.heading));
    sections += section.html();
  }
  if (!links.empty()) links += "</nav>\n";
  for (const std::string &remark : remarks)
    list += "<li>" + escaped(remark) + "</li>\n";
  const std::filesystem::path html = folder_ / "report.html";
  write_text_aside(
      html, fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                        "<title>{0}</title>\n{1}</head>\n<body>\n<h1>{0}</h1>\n{6}{2}{3}"
                        "<ul>\n{4}</ul>\n{5}</body>\n</html>\n",
                        escaped(title), style_sheet, links, html_table(figures), list, sections, head));
  for (const Section &section : sections_)
    for (const Picture &picture : section.pictures)
      for (const char *ending : {".png", ".svg"}) // charts have both
        if (const auto file = std::filesystem::path(picture.file).replace_extension(ending);
            std::filesystem::exists(file))
          out << "drawn: " << file.string() << '\n';
  out << "page: " << html.string() << "\n\n" << head_in_words << as_text(figures);
  for (const Section &section : sections_)
    for (const TableOfFigures &table : section.tables)
      out << '\n' << as_text(table);
}

} // namespace platen::apps::report
