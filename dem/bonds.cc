#include "dem/bonds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "base/pi.h"
#include "base/shortest_text.h"
#include "base/state.h"
#include "dem/kernels/cohesive_kernel.h"
#include "dem/measure/damage.h"
#include "dem/pairs_in_state.h"

namespace platen::dem {
namespace {

Rotation<double> rotation(const Quaternion &q) {
  return {q.w, q.x, q.y, q.z};
}

// dU/dt at the velocities of the last drift.
double power_taken(const BrokenBond &b, const Particles &p) {
  const auto along = [](const Triple<double> &a, const Vector3 &v) {
    return a.x * v.x + a.y * v.y + a.z * v.z;
  };
  double power = along(b.last.force, p.velocity[b.second] - p.velocity[b.first]);
  if (p.has_rotation())
    power -= along(b.last.torque_i, (*p.angular_velocity)[b.first]) +
             along(b.last.torque_j, (*p.angular_velocity)[b.second]);
  return power;
}

// Allowed values of a history variable, by its name in the laws.
Allowed allowed_memory(const std::string &column) {
  const std::string damage = "damage";
  if (column.size() >= damage.size() &&
      column.compare(column.size() - damage.size(), damage.size(), damage) == 0)
    return between(0, 1);
  if (column == "broken") return between(0, 2);
  if (column == "plastic") return at_least(0);
  return {};
}

} // namespace

double packing_factor(const Specimen &s, const BondLayout &layout) {
  const double pairs =
      static_cast<double>(pairs_in_range(s.centre.data(), s.radius.data(), s.size(), layout).size());
  if (pairs == 0)
    throw BadParameter(
        BondLayout::name, "area_factor", "0",
        "is taken from the bonds of a sphere, and there are none: no two spheres are that near. "
        "Allowed: > 0, a larger gap, or a denser packing.");
  const double porosity = 1 - volume_of_spheres(s) / s.shape.volume();
  if (!(porosity > 0))
    throw BadParameter(BondLayout::name, "area_factor", "0",
                       "is taken from the porosity, and there is none: the spheres, overlaps counted twice, "
                       "fill " +
                           std::to_string(100 * (1 - porosity)) + " % of the shape. Allowed: > 0.");
  return 40 * porosity * static_cast<double>(s.size()) / (2 * pairs);
}

Bonds::Bonds(const Particles &particles, const BondLayout &layout, const BondParameters &parameters,
             const Notch &notch, const BondChoice &choice)
    : law(bond_law(parameters)), particles_(particles.size()), rotation_(particles.has_rotation()) {
  require_in_range(layout);
  require_given(layout, "modulus", layout.modulus);
  if (layout.radius_rule == RadiusRule::given) require_given(layout, "radius", layout.radius);
  if (needs_rotation(law) && !rotation_) throw std::invalid_argument("beams need spheres that turn");
  const BondedPairs chosen = bonded_pairs(particles, layout, notch, choice);
  const std::vector<IndexPair> &pairs = chosen.pairs;
  in_flaw = chosen.in_flaw;

  table.resize(pairs.size());
  records.resize(pairs.size());
  for (Column<int> *column : {&first, &second, &record_first, &record_second})
    column->allow(row_of(particles.size()));
  record.allow(row_of(pairs.size()));
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const double ri = particles.radius[i], rj = particles.radius[j];
    first[k] = record_first[k] = i;
    second[k] = record_second[k] = j;
    record[k] = static_cast<int>(k);
    reference[k] = particles.position[j] - particles.position[i];
    rest_length[k] = norm(reference[k]);
    if (!(rest_length[k] > 0)) throw std::invalid_argument("bonded spheres share one centre");
    lever[k] = centre_to_centre(law) ? 0.5 : ri / (ri + rj);
    normal_stiffness[k] =
        over_distance(law) ? layout.modulus / rest_length[k] : layout.normal_stiffness(ri, rj);
    bond_radius[k] = layout.bond_radius(ri, rj);
    state[k] = static_cast<int>(BondState::intact);
    break_time[k] = std::numeric_limits<double>::quiet_NaN();
  }
  const auto differs = [](double factor) { return factor != 1; };
  if (std::any_of(chosen.strength_factor.begin(), chosen.strength_factor.end(), differs)) {
    add_strength_factor();
    std::copy(chosen.strength_factor.begin(), chosen.strength_factor.end(), strength_factor->begin());
  }
  if (has_history(law)) add_history();
  count_and_cut();
}

void Bonds::add_history() {
  of_remembering(law, [&](const auto &one) {
    using State = typename std::decay_t<decltype(one)>::template State<double>;
    State empty{};
    State::describe(
        [&](const char *name, const char *unit, const auto &member) {
          if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>)
            memory_scalars.push_back(&table.add<double>(name, unit, allowed_memory(name)));
          else
            memory_vectors.push_back(&table.add<Vector3>(name, unit));
        },
        empty);
    return true;
  });
  if (memory_scalars.size() > kernels::most_scalars || memory_vectors.size() > kernels::most_vectors)
    throw std::logic_error("a law remembers more than its kernel has columns for");
}

void Bonds::cut_blocks() {
  const int stride = kernels::row_stride(rotation_, rows_move());
  blocks.rebuild(first.data(), second.data(), size(), particles_, rotation_, stride);
}

void Bonds::require_ductile(const Particles &particles) const {
  const auto *facet = std::get_if<FacetBond>(&law);
  if (facet == nullptr || !(facet->parameters.fracture_energy > 0)) return;
  std::size_t worst = 0;
  double least = std::numeric_limits<double>::infinity(), radii = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    const double ductility = facet->ductility(cohesive_geometry(k));
    if (ductility < least) least = ductility, worst = k;
  }
  if (least > 1) return;
  for (const double radius : particles.radius)
    radii += radius;
  const double energy = facet->parameters.fracture_energy;
  throw BadParameter(FacetBond::Parameters::name, "fracture_energy", shortest_text(energy),
                     "is not above the elastic energy at its strength of the bond between spheres " +
                         std::to_string(particles.id[first[worst]]) + " and " +
                         std::to_string(particles.id[second[worst]]) + ", " +
                         shortest_text(rest_length[worst]) + " m long: it would be brittle. Allowed: > " +
                         text_of(energy / least) + " J/m2, or spheres of a mean radius below " +
                         text_of(least * radii / static_cast<double>(particles.size())) + " m.");
}

void Bonds::add_strength_factor() {
  if (strength_factor != nullptr) return;
  strength_factor = &table.add<double>("strength_factor", "1", at_least(0));
  std::fill(strength_factor->begin(), strength_factor->end(), 1.0);
}

std::size_t Bonds::bytes() const {
  return size() * table.bytes_per_row() + records.size() * records.bytes_per_row() + blocks.bytes();
}

// Broken rows are not stored, because the time when they are dropped is not part of the state.
void Bonds::describe(Archive &archive) {
  archive.version(1);
  if (archive.writes() && broken_rows > 0) compact();
  archive.table("rows", table);
  archive.same_table("records", records);
  if (const StateSource *from = archive.looks_at()) require_consistent(*from, archive.path(""));
  if (archive.reads()) count_and_cut();
}

// Throws StateError if rows and records are not consistent: pairs must ascend, blocks of rows too, a row must
// match its record, and each bond that is not broken must have a row.
void Bonds::require_consistent(const StateSource &from, const std::string &at) const {
  const std::string rows = at + "rows/", of_records = at + "records/";
  const std::vector<int> i = rows_of<int>(from, rows + "first"), j = rows_of<int>(from, rows + "second"),
                         of = rows_of<int>(from, rows + "record"),
                         record_i = rows_of<int>(from, of_records + "first"),
                         record_j = rows_of<int>(from, of_records + "second"),
                         states = rows_of<int>(from, of_records + "state");
  const std::vector<double> stiffness = rows_of<double>(from, rows + "normal_stiffness", "Pa/m"),
                            times = rows_of<double>(from, of_records + "break_time", "s");
  require_ascending_pairs(of_records + "second", record_i, record_j, particles_);
  std::vector<char> has_row(states.size(), 0);
  for (std::size_t k = 0; k < of.size(); ++k) {
    const std::size_t r = static_cast<std::size_t>(of[k]);
    if (i[k] != record_i[r] || j[k] != record_j[r] || std::exchange(has_row[r], 1))
      refuse_row(rows + "record", k, std::to_string(of[k]), "the record of its pair, each once");
    if (k > 0 && i[k] / static_cast<int>(block_rows) < i[k - 1] / static_cast<int>(block_rows))
      refuse_row(rows + "first", k, std::to_string(i[k]), "in the order of blocks of particles");
    if (is_broken(states[r]) && !has_history(law) ? stiffness[k] > 0 : stiffness[k] == 0)
      refuse_row(rows + "normal_stiffness", k, shortest_text(stiffness[k]),
                 "0 of a bond that has broken, > 0 of one that has not, or stays as a contact");
  }
  for (std::size_t r = 0; r < states.size(); ++r) {
    if (!is_broken(states[r]) && !has_row[r])
      refuse_row(of_records + "state", r, std::to_string(states[r]), "2 or 3 of a bond that has no row");
    if (is_broken(states[r]) == std::isnan(times[r]))
      refuse_row(of_records + "break_time", r, shortest_text(times[r]),
                 "a time of a bond that has broken, nan of one that has not");
  }
}

// f(law, history of the row), for laws with history.
template <class F>
auto Bonds::with_memory(std::size_t k, const F &f) const {
  return of_remembering(law, [&](const auto &one) {
    return f(one, memory<typename std::decay_t<decltype(one)>::template State<double>>(k));
  });
}

void Bonds::count_and_cut() {
  count_rows();
  cut_blocks();
}

void Bonds::count_rows() {
  broken_rows = static_cast<std::size_t>(std::count(normal_stiffness.begin(), normal_stiffness.end(), 0.0));
  failed_rows = 0;
  disorder_.clear();
  if (!has_history(law)) return;
  if (failed_rows_last(law)) disorder_.resize(number_of_blocks(particles_));
  for (std::size_t k = 0; k < size();) {
    const std::size_t begin = k, block = static_cast<std::size_t>(first[k]) / block_rows;
    for (; k < size() && static_cast<std::size_t>(first[k]) / block_rows == block; ++k)
      failed_rows += has_failed(k);
    if (!disorder_.empty()) disorder_[block] = in_disorder(begin, k);
  }
}

int Bonds::place(std::size_t k) const {
  const double damaged = damage(k);
  if (normal_stiffness[k] == 0.0 || damaged >= 1.0) return 2;
  return damaged > 0 && damaged_rows_separate(law);
}

// Whether enough rows stand before one of a lower place, so that SIMD vectors would contain several kinds.
bool Bonds::in_disorder(std::size_t begin, std::size_t end) const {
  constexpr int enough = 8; // lanes of the widest SIMD vector
  int before[3] = {}, misplaced[3] = {};
  for (std::size_t k = begin; k < end; ++k) {
    const int here = place(k);
    for (int at = 1; at <= 2; ++at)
      if (here >= at)
        ++before[at];
      else
        misplaced[at] = before[at];
  }
  return misplaced[1] >= enough || misplaced[2] >= enough;
}

void Bonds::look_at_order(std::size_t block) {
  if (!disorder_.empty())
    disorder_[block] = in_disorder(blocks.first_pair[block], blocks.first_pair[block + 1]);
}

// Each block decides by its own rows only: threads, ranks and restarts do not change the time of reordering.
void Bonds::order_rows() {
  for (std::size_t b = 0; b < disorder_.size(); ++b) {
    if (!disorder_[b]) continue;
    disorder_[b] = 0;
    const std::size_t begin = blocks.first_pair[b], count = blocks.first_pair[b + 1] - begin;
    std::vector<int> order(count), places(count);
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t k = 0; k < count; ++k)
      places[k] = place(begin + k);
    std::stable_sort(order.begin(), order.end(), [&](int k, int l) { return places[k] < places[l]; });
    table.permute_from(begin, order);
    blocks.permute_pairs(begin, order);
  }
}

void Bonds::compact() {
  std::vector<int> intact;
  intact.reserve(size());
  for (std::size_t k = 0; k < size(); ++k)
    if (normal_stiffness[k] != 0.0) intact.push_back(static_cast<int>(k));
  table.permute(intact);
  broken_rows = 0;
  cut_blocks();
}

void Bonds::keep_blocks(const std::vector<char> &marked) {
  std::vector<int> kept;
  for (std::size_t k = 0; k < size(); ++k)
    if (marked[static_cast<std::size_t>(first[k]) / block_rows]) kept.push_back(static_cast<int>(k));
  table.permute(kept);
  count_and_cut();
}

BrokenBond Bonds::marked(const BondBreak &b, const Particles &particles, double time) {
  const int k = b.row;
  if (dashpot != nullptr) (*dashpot)[k] = 0;
  if (dashpot_bending != nullptr) (*dashpot_bending)[k] = 0;
  state[record[k]] = static_cast<int>(b.mode);
  break_time[record[k]] = time;
  const double area = pi * bond_radius[k] * bond_radius[k];
  return {first[k], second[k], record[k], b.mode, rest_length[k], area, response(k, particles), 0.0, 0.0};
}

std::vector<BrokenBond> Bonds::break_rows(const std::vector<BondBreak> &breaks, const Particles &particles,
                                          double time) {
  std::vector<BrokenBond> broken;
  broken.reserve(breaks.size());
  for (const BondBreak &b : breaks) {
    broken.push_back(marked(b, particles, time));
    broken.back().power = power_taken(broken.back(), particles);
    normal_stiffness[b.row] = 0;
  }
  broken_rows += breaks.size();
  return broken;
}

std::vector<BrokenBond> Bonds::fail_rows(const std::vector<BondBreak> &breaks, const Particles &particles,
                                         double time) {
  std::vector<BrokenBond> failed;
  failed.reserve(breaks.size());
  for (const BondBreak &b : breaks) {
    failed.push_back(marked(b, particles, time));
    failed.back().released = with_memory(b.row, [&](const auto &, auto remembered) {
      const double dissipated = std::exchange(remembered.dissipated, 0);
      set_memory(b.row, remembered);
      return dissipated;
    });
  }
  failed_rows += breaks.size();
  return failed;
}

bool Bonds::has_failed(std::size_t k) const {
  return normal_stiffness[k] == 0.0 || damage(k) >= 1.0;
}

double Bonds::damage(std::size_t k) const {
  return with_memory(k, [](const auto &of, const auto &remembered) { return of.damage_of(remembered); });
}

bool Bonds::failed_in_tension(std::size_t k) const {
  return with_memory(k,
                     [](const auto &of, const auto &remembered) { return of.failed_in_tension(remembered); });
}

CohesiveGeometry<double> Bonds::cohesive_geometry(std::size_t k) const {
  CohesiveGeometry<double> g{rest_length[k], lever[k], normal_stiffness[k],
                             pi * bond_radius[k] * bond_radius[k]};
  if (strength_factor != nullptr) g.strength_factor = (*strength_factor)[k];
  g.reference = triple(reference[k]);
  g.radius = bond_radius[k];
  return g;
}

BondGeometry<double> Bonds::geometry(std::size_t k) const {
  BondGeometry<double> g{triple(reference[k]), rest_length[k], lever[k], normal_stiffness[k], bond_radius[k]};
  if (strength_factor != nullptr) g.strength_factor = (*strength_factor)[k];
  return g;
}

BondStiffness Bonds::stiffness(std::size_t k) const {
  return std::visit([&](const auto &l) { return l.stiffness(geometry(k)); }, law);
}

BondResponse<double> Bonds::response(std::size_t k, const Particles &p) const {
  const int i = first[k], j = second[k];
  const Triple<double> d = triple(p.position[j] - p.position[i]);
  if (has_history(law)) {
    CohesiveMotion<double> now{};
    now.distance = d;
    const Quaternion unturned{1, 0, 0, 0};
    now.turn_i = rotation(p.has_rotation() ? (*p.orientation)[i] : unturned);
    now.turn_j = rotation(p.has_rotation() ? (*p.orientation)[j] : unturned);
    return with_memory(k, [&](const auto &of, const auto &remembered) {
      return of.bond_response(remembered, cohesive_geometry(k), now);
    });
  }
  return of_elastic(law, [&](const auto &elastic) -> BondResponse<double> {
    if (p.has_rotation())
      return elastic(geometry(k),
                     BondMotion<double>{d, rotation((*p.orientation)[i]), rotation((*p.orientation)[j])});
    if constexpr (!only_with_rotation<std::decay_t<decltype(elastic)>>)
      return elastic.without_rotation(geometry(k), d);
    else
      throw std::logic_error("a bond that needs rotation has none");
  });
}

} // namespace platen::dem
