#include "apps/scene/bond_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "apps/output/numbers.h"
#include "apps/scene/text_table.h"

namespace platen::apps {
namespace {

enum BondColumn : std::size_t { a, b, factor, broken };
constexpr double largest_factor = 1e3; // as of phases

const KnownColumns &columns_of_bonds() {
  static const KnownColumns known{
      {{"a", a}, {"b", b}, {"strength_factor", factor}, {"broken", broken}}, 2, 0};
  return known;
}

// Row of each id.
std::map<double, int> rows_of_ids(const SpecimenFile &spheres, const TextPlace &place) {
  std::map<double, int> rows;
  for (std::size_t k = 0; k < spheres.specimen.size(); ++k) {
    const double id = spheres.ids.empty() ? static_cast<double>(k) : spheres.ids[k];
    if (!rows.emplace(id, static_cast<int>(k)).second)
      place.fail(fmt::format("names spheres by ids, and two in their file have the id {}", id));
  }
  return rows;
}

class BondRows {
public:
  BondRows(const SpecimenFile &spheres, const dem::BondLayout &layout, const TextPlace &place)
      : spheres_(spheres.specimen), layout_(layout), place_(place), rows_(rows_of_ids(spheres, place)) {}

  void take(const TextTable &table) {
    const int first = row(table, a), second = row(table, b);
    if (first == second) place_.fail(fmt::format("bonds sphere {} to itself", table.value(a)));
    const auto [found, fresh] = lines_.try_emplace(std::minmax(first, second), place_.line);
    if (!fresh)
      place_.fail(
          fmt::format("bonds {} and {}, as line {} does", table.value(a), table.value(b), found->second));
    require_near(table, first, second);
    const double strength = table.has(factor) ? table.value(factor) : 1;
    if (!(strength > 0) || strength > largest_factor)
      place_.fail(fmt::format("strength_factor {} is out of range. Allowed: above 0 ... {}.", strength,
                              largest_factor));
    const double state = table.has(broken) ? table.value(broken) : 0;
    if (state != 0 && state != 1) place_.fail(fmt::format("broken is {}. Allowed: 0, 1.", state));
    if (state == 0) bonds.push_back({first, second, strength});
  }

  std::vector<dem::GivenBond> bonds;

private:
  int row(const TextTable &table, std::size_t column) const {
    const auto found = rows_.find(table.value(column));
    if (found == rows_.end())
      place_.fail(fmt::format("column {}: there is no sphere {}. Allowed: ids from {} to {}.",
                              table.label(column), table.value(column), rows_.begin()->first,
                              rows_.rbegin()->first));
    return found->second;
  }
  // Farther apart than a radius spheres have others between them, whatever Bond/Gap is.
  void require_near(const TextTable &table, int first, int second) const {
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    const double ri = spheres_.radius[i], rj = spheres_.radius[j];
    const double gap = norm(spheres_.centre[j] - spheres_.centre[i]) - ri - rj,
                 most = std::max(layout_.reach(ri, rj), std::min(ri, rj));
    if (gap > most)
      place_.fail(
          fmt::format("spheres {} and {} are {:.4g} m apart, which no bond spans. Allowed: up to {:.4g} m, "
                      "the smaller radius.",
                      table.value(a), table.value(b), gap, most));
  }

  const dem::Specimen &spheres_;
  const dem::BondLayout &layout_;
  const TextPlace &place_;
  std::map<double, int> rows_;
  std::map<std::pair<int, int>, std::size_t> lines_;
};

} // namespace

std::vector<dem::GivenBond> read_bond_file(const std::filesystem::path &path, const SpecimenFile &spheres,
                                           const dem::BondLayout &layout) {
  TextPlace place;
  place.file = path.string();
  TextTable table(columns_of_bonds());
  BondRows rows(spheres, layout, place);
  read_lines(path, place, [&](std::string_view line) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') return true;
    if (!table.is_named()) {
      table.take_header(text, place);
    } else {
      table.read_row(text, place);
      rows.take(table);
    }
    return true;
  });
  if (rows.bonds.empty()) place.fail("the file holds no bond that is not broken");
  return std::move(rows.bonds);
}

} // namespace platen::apps
