#include "apps/report/comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace platen::apps::report {
namespace {

struct Figure {
  const char *title;
  std::vector<const char *> keys; // the largest of them; a member of an object after "/"
  double factor;                  // from SI to the unit in the title
  int digits;
  bool only_if_measured; // no row where no run has it
};

const std::vector<Figure> &figures() {
  static const std::vector<Figure> all = {
      {"strength (MPa)", {"strength_pa"}, 1e-6, 2, false},
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
      {"half-angle of the top cone (degrees)", {"cone_top/half_angle_deg"}, 1, 1, true},
      {"half-angle of the bottom cone", {"cone_bottom/half_angle_deg"}, 1, 1, true},
      {"top cone at the end", {"final_cone_top/half_angle_deg"}, 1, 1, true},
      {"bottom cone at the end", {"final_cone_bottom/half_angle_deg"}, 1, 1, true},
      {"b-value before the peak", {"acoustic/b_before"}, 1, 2, true},
      {"b-value after the peak", {"acoustic/b_after"}, 1, 2, true},
  };
  return all;
}

// Nothing where the run did not measure it.
std::optional<double> value_of(const Run &run, const Figure &figure) {
  std::optional<double> largest;
  for (const char *key : figure.keys) {
    // A pointer of JSON; null where any part is not there.
    const nlohmann::json::json_pointer place("/" + std::string(key));
    if (!run.summary.is_object() || !run.summary.contains(place) || !run.summary[place].is_number()) continue;
    const double value = run.summary[place].get<double>() * figure.factor;
    if (!largest || value > *largest) largest = value;
  }
  return largest;
}

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::vector<std::string> row_of(const Figure &figure, const std::vector<std::optional<double>> &values) {
  std::vector<std::string> row{figure.title};
  for (const auto &value : values)
    row.push_back(value ? fixed(*value, figure.digits) : "-");
  for (std::size_t k = 1; k < values.size(); ++k)
    row.push_back(values[0] && values[k] && *values[k] != 0 ? fixed(*values[0] / *values[k], 3) : "-");
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

} // namespace

TableOfFigures table_of_figures(const std::vector<Run> &runs) {
  TableOfFigures table;
  table.header = {"figure"};
  for (const Run &run : runs)
    table.header.push_back(run.name);
  for (std::size_t k = 1; k < runs.size(); ++k)
    table.header.push_back(runs[0].name + " / " + runs[k].name);

  for (const Figure &figure : figures()) {
    std::vector<std::optional<double>> values;
    for (const Run &run : runs)
      values.push_back(value_of(run, figure));
    const bool measured =
        std::any_of(values.begin(), values.end(), [](const auto &v) { return v.has_value(); });
    if (measured || !figure.only_if_measured) table.rows.push_back(row_of(figure, values));
  }
  for (const auto &[title, key] :
       {std::pair{"pattern", "pattern"}, std::pair{"pattern at the end", "final_pattern"}})
    if (std::vector<std::string> row = row_of_words(title, key, runs); !row.empty())
      table.rows.push_back(std::move(row));
  return table;
}

std::string as_text(const TableOfFigures &table) {
  std::vector<std::size_t> widths(table.header.size());
  const auto widen = [&](const std::vector<std::string> &row) {
    for (std::size_t k = 0; k < row.size(); ++k)
      widths[k] = std::max(widths[k], row[k].size());
  };
  widen(table.header);
  for (const auto &row : table.rows)
    widen(row);

  std::string text;
  const auto add = [&](const std::vector<std::string> &row) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string gap(widths[k] - row[k].size(), ' ');
      text += k == 0 ? row[k] + gap : "  " + gap + row[k];
    }
    text += '\n';
  };
  add(table.header);
  std::size_t whole = 2 * (widths.size() - 1);
  for (const std::size_t width : widths)
    whole += width;
  text += std::string(whole, '-') + '\n';
  for (const auto &row : table.rows)
    add(row);
  return text;
}

} // namespace platen::apps::report
