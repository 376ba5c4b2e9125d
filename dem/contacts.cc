#include "dem/contacts.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/state.h"
#include "dem/heterogeneity.h"
#include "dem/laws/normal_contact.h"
#include "dem/pairs_in_state.h"
#include "dem/particles.h"

namespace platen::dem {
namespace {

// Margins of the two pair lists in mean radii: the wide list is valid for some hundred steps of a fast
// fragment; the close one excludes pairs that are merely near from the contact loop.
constexpr double wide_skin = 0.5, close_skin = 0.06;
// Overlap in smaller radii at which the time step counts a Hertz contact that is about to form.
constexpr double early_overlap = 2e-3;

double elastic_energy(NormalContact law, double coefficient, double overlap) {
  return NormalContacts::with(law, [&](auto of) { return of.energy(coefficient, overlap); });
}

// The overlap at which the law stores `energy`.
double overlap_of_energy(NormalContact law, double coefficient, double energy) {
  return NormalContacts::with(law, [&](auto of) { return of.overlap_of_energy(coefficient, energy); });
}

} // namespace

double ContactSettings::coefficient(double ri, double rj, const BondLayout &layout) const {
  return NormalContacts::with(normal, [&](auto of) { return of.coefficient(*this, ri, rj, layout); });
}

double ContactSettings::dashpot() const {
  return NormalContacts::with(normal, [&](auto of) { return of.dashpot(*this); });
}

double ContactSettings::dashpot_reserve() const {
  return NormalContacts::with(normal, [&](auto of) { return of.dashpot_reserve(*this); });
}

Contacts::Contacts(const Particles &particles, const ContactSettings &settings, const BondLayout &layout,
                   bool energy_ledger, InstructionSet instruction_set)
    : settings_(settings),
      layout_(layout),
      search_(wide_skin * mean_radius(particles), close_skin * mean_radius(particles)),
      particles_(particles.size()) {
  require_in_range(settings);
  first.allow(row_of(particles_));
  second.allow(row_of(particles_));
  if (NormalContacts::with(settings.normal, [&](auto of) { return of.follows_bonds(settings); }))
    require_given(layout, "modulus", layout.modulus);
  if (settings.tangential != TangentialContact::none) {
    normal = &table.add<Vector3>("normal", "1", unit_length_or_zero());
    spring = &table.add<Vector3>("spring", "N");
    tangential_stiffness = &table.add<double>("tangential_stiffness", "N/m", at_least(0));
    sliding = &table.add<int>("sliding", "1", flag());
  }
  if (settings.tangential == TangentialContact::coulomb_with_rolling) {
    rolling = &table.add<Vector3>("rolling", "N m");
    rolling_stiffness = &table.add<double>("rolling_stiffness", "N m", at_least(0));
  }
  dashpot_ = settings.dashpot();
  if (dashpot_ > 0) dashpot = &table.add<Vector3>("dashpot", "N");
  loop_ = loop_for(particles.has_rotation(), energy_ledger, instruction_set);
  // Spheres that overlap from the start touch from their initial distance, bonded or not.
  for (const IndexPair &p :
       near_pairs(particles.position.data(), particles.radius.data(), particles.size(), 0.0))
    search_.set_rest_distance(p, norm(particles.position[p.second] - particles.position[p.first]));
}

void Contacts::update(const Particles &particles, const Bonds *bonds, const BlockList *listed) {
  if (search_.update(particles, bonds, listed)) carry_rows(particles);
}

void Contacts::renew_close(const Particles &particles) {
  if (!search_.made()) return;
  search_.renew_close(particles);
  carry_rows(particles);
}

void Contacts::keep_blocks(const std::vector<char> &marked) {
  sort_rows();
  search_.keep_blocks(marked);
  std::vector<int> kept;
  for (std::size_t k = 0; k < table.size(); ++k)
    if (marked[static_cast<std::size_t>(first[k]) / block_rows]) kept.push_back(static_cast<int>(k));
  table.permute(kept);
  rows_changed();
}

void Contacts::carry_rows(const Particles &particles) {
  const std::vector<int> before = rows_in_order();
  rows_changed();
  const std::vector<IndexPair> pairs = search_.close_pairs();
  std::vector<int> order(pairs.size(), 0);
  std::vector<unsigned char> fresh(pairs.size(), 0);
  // Old rows and pairs are both sorted; a pair without an old row starts from a blank row at the end.
  std::size_t k = 0;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    while (k < before.size() && comes_before(before[k], pairs[n]))
      ++k;
    fresh[n] = k == before.size() || pairs[n] < pair_of(before[k]);
    order[n] = fresh[n] ? static_cast<int>(before.size()) : before[k];
  }
  table.resize(before.size() + 1);
  table.permute(order, order.size() / 8);
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    if (fresh[n]) begin_row(particles, n, pairs[n]);
  }
}

// Returns table.size() if the pair has no row.
std::size_t Contacts::place_of(const IndexPair &pair) const {
  const auto is_it = [&](std::size_t row) { return first[row] == pair.first && second[row] == pair.second; };
  const auto end = first.begin() + static_cast<std::ptrdiff_t>(sorted_rows());
  const auto [from, to] = std::equal_range(first.begin(), end, pair.first);
  const auto at = second.begin() + (from - first.begin()), last = second.begin() + (to - first.begin());
  const std::size_t row = static_cast<std::size_t>(std::lower_bound(at, last, pair.second) - second.begin());
  if (row < static_cast<std::size_t>(to - first.begin()) && is_it(row)) return row;
  if (!added_.empty())
    for (const int added : added_[static_cast<std::size_t>(pair.first) / block_rows])
      if (is_it(static_cast<std::size_t>(added))) return static_cast<std::size_t>(added);
  return table.size();
}

void Contacts::begin_row(const Particles &particles, std::size_t k, const IndexPair &pair) {
  first[k] = pair.first;
  second[k] = pair.second;
  rest_distance[k] = search_.rest_distance(pair, particles);
  coefficient[k] = coefficient_of(particles, pair.first, pair.second);
  if (tangential_stiffness != nullptr)
    (*tangential_stiffness)[k] = settings_.tangential_ratio * coefficient[k];
}

// Adds a row, behind all others, for a new pair of the close list.
void Contacts::add_row(const Particles &particles, const IndexPair &pair) {
  const std::size_t row = table.size();
  table.resize(row + 1);
  begin_row(particles, row, pair);
  if (added_.empty()) added_.resize(number_of_blocks(particles_));
  std::vector<int> &added = added_[static_cast<std::size_t>(pair.first) / block_rows];
  added.insert(std::lower_bound(added.begin(), added.end(), pair,
                                [&](int k, const IndexPair &p) { return comes_before(k, p); }),
               static_cast<int>(row));
  ++added_rows_;
  if (stale_ == Stale::none) blocks_.add(pair.first, pair.second, particles_);
}

void Contacts::sort_rows() {
  if (added_rows_ == 0) return;
  if (stale_ == Stale::none) {
    stale_ = Stale::some;
    stale_blocks_.assign(blocks_.blocks(), 0);
  }
  for (std::size_t block = 0; stale_ == Stale::some && block < added_.size(); ++block)
    if (!added_[block].empty()) stale_blocks_[block] = 1;
  table.permute(rows_in_order());
  added_.clear();
  added_rows_ = 0;
}

std::vector<int> Contacts::rows_in_order() const {
  std::vector<int> order;
  order.reserve(table.size());
  for (std::size_t block = 0; block < number_of_blocks(particles_); ++block)
    for_rows_of_block(block, [&](std::size_t row) { order.push_back(static_cast<int>(row)); });
  return order;
}

void Contacts::cut_blocks(const Particles &particles) {
  if (stale_ != Stale::none)
    blocks_.rebuild(first.data(), second.data(), table.size(), particles.size(), particles.has_rotation(), 1,
                    stale_ == Stale::some ? &stale_blocks_ : nullptr);
  stale_ = Stale::none;
}

void Contacts::take_over(const Particles &p, const Bonds &bonds, std::vector<BrokenBond> &broken, double dt,
                         bool sorted) {
  for (BrokenBond &b : broken) {
    const double ri = p.radius[b.first], rj = p.radius[b.second], c = coefficient_of(p, b.first, b.second);
    const double length = norm(p.position[b.second] - p.position[b.first]);
    double rest = std::min(ri + rj, b.rest_length);
    // The contact must not store more energy than the bond did.
    if (rest > length && elastic_energy(settings_.normal, c, rest - length) > b.last.energy)
      rest = length + overlap_of_energy(settings_.normal, c, b.last.energy);
    search_.set_rest_distance({b.first, b.second}, rest);
    if (search_.add_pair({b.first, b.second})) add_row(p, {b.first, b.second});
  }
  if (!search_.made()) {
    search_.update(p, &bonds);
    carry_rows(p);
  }
  if (stale_ != Stale::none || sorted) sort_rows();
  for (BrokenBond &b : broken) {
    b.released = b.last.energy;
    double power = b.power;
    const std::size_t row = place_of({b.first, b.second});
    if (row < table.size()) power -= start_contact(p, row, dt, b);
    b.released = std::max(0.0, b.released - 0.5 * dt * power);
  }
}

// Transfers a broken bond's energy to its contact; returns the power that the contact stores, W.
double Contacts::start_contact(const Particles &p, std::size_t k, double dt, BrokenBond &b) {
  rest_distance[k] = search_.rest_distance({b.first, b.second}, p);
  const Vector3 d = p.position[b.second] - p.position[b.first];
  const double length = norm(d), lever = p.radius[b.first] / (p.radius[b.first] + p.radius[b.second]);
  overlap[k] = std::max(0.0, rest_distance[k] - length);
  if (overlap[k] == 0) return 0;
  touching[k] = 1;
  b.released = std::max(0.0, b.released - elastic_energy(settings_.normal, coefficient[k], overlap[k]));
  const Vector3 n = d / length, ri = lever * d, rj = ri - d;
  Vector3 v = p.velocity[b.second] - p.velocity[b.first];
  if (p.has_rotation())
    v += cross((*p.angular_velocity)[b.second], rj) - cross((*p.angular_velocity)[b.first], ri);
  const double pressing =
      NormalContacts::with(settings_.normal, [&](auto of) { return of.force(coefficient[k], overlap[k]); });
  double power = -pressing * dot(v, n);
  if (spring != nullptr && b.mode == BondState::broken_in_shear) {
    const Vector3 slip_velocity = v - dot(v, n) * n, kept = keep_shear(k, pressing, b);
    // The row's next evaluation adds this drift's slip, which the bond's shear force already contains.
    (*spring)[k] = kept - (*tangential_stiffness)[k] * dt * slip_velocity;
    (*normal)[k] = n;
    power += dot(kept, slip_velocity);
  }
  return power;
}

// Transfers the shear force (N) of a bond broken in shear to the contact, as far as friction and energy
// allow.
Vector3 Contacts::keep_shear(std::size_t k, double pressing, BrokenBond &b) {
  double &kt = (*tangential_stiffness)[k];
  kt = NormalContacts::with(settings_.normal, [&, now = kt](auto of) {
    return of.constant_stiffness ? now
                                 : of.tangential_ratio(settings_) * of.stiffness(coefficient[k], overlap[k]);
  });
  if (!(kt > 0) || !(b.last.shear_force > 0)) return {};
  const double kept =
      std::min({b.last.shear_force, settings_.friction * pressing, std::sqrt(2 * kt * b.released)});
  b.released = std::max(0.0, b.released - 0.5 * kept * kept / kt);
  return (kept / b.last.shear_force) * Vector3{b.last.shear.x, b.last.shear.y, b.last.shear.z};
}

double Contacts::coefficient_of(const Particles &p, int i, int j) const {
  const double c = settings_.coefficient(p.radius[i], p.radius[j], layout_);
  if (!NormalContacts::with(settings_.normal, [&](auto of) { return of.follows_bonds(settings_); })) return c;
  return c * settings_.modulus_factors[aggregates_of_pair(p, i, j)];
}

ContactStiffness Contacts::stiffness_bound(const Particles &p, int i, int j, double approach) const {
  const double pressed = std::max(approach, early_overlap * std::min(p.radius[i], p.radius[j]));
  return NormalContacts::with(settings_.normal, [&](auto of) -> ContactStiffness {
    const double normal_stiffness = of.stiffness(coefficient_of(p, i, j), pressed);
    if (settings_.tangential == TangentialContact::none) return {normal_stiffness, 0};
    return {normal_stiffness, normal_stiffness * of.tangential_ratio(settings_)};
  });
}

double Contacts::stored_energy(std::size_t k) const {
  double sum = elastic_energy(settings_.normal, coefficient[k], overlap[k]);
  if (spring != nullptr && (*tangential_stiffness)[k] > 0)
    sum += 0.5 * norm_squared((*spring)[k]) / (*tangential_stiffness)[k];
  if (rolling != nullptr && (*rolling_stiffness)[k] > 0)
    sum += 0.5 * norm_squared((*rolling)[k]) / (*rolling_stiffness)[k];
  return sum;
}

std::vector<double> Contacts::energy_of_blocks(const BlockList *listed) const {
  std::vector<double> energy(number_of_blocks(particles_));
  for_listed_blocks(listed, particles_, [&](std::size_t, std::size_t, std::size_t block) {
    for_rows_of_block(block, [&](std::size_t k) {
      if (touching[k]) energy[block] += stored_energy(k);
    });
  });
  return energy;
}

double Contacts::energy() const {
  double sum = 0;
  for (const double of_block : energy_of_blocks())
    sum += of_block;
  return sum;
}

void Contacts::set_friction(double friction) {
  if (!(friction >= 0)) throw std::invalid_argument("contacts: friction must not be negative");
  if (settings_.tangential == TangentialContact::none)
    throw std::invalid_argument("contacts: were made without friction and have no springs for it");
  settings_.friction = friction;
}

std::size_t Contacts::touching_count() const {
  return table.size() - static_cast<std::size_t>(std::count(touching.begin(), touching.end(), 0));
}

void Contacts::describe(Archive &archive) {
  sort_rows();
  archive.version(1);
  platen::describe(archive, "friction_work", friction_work, "J");
  platen::describe(archive, "damping_work", damping_work, "J");
  archive.table("rows", table);
  archive.part("search", search_);
  if (const StateSource *state = archive.looks_at()) require_consistent(*state, archive.path(""));
  if (archive.reads()) rows_changed();
}

// Throws StateError if the lists of pairs do not ascend or contain particles that do not exist, or if the
// close pairs are not the pairs of the rows.
void Contacts::require_consistent(const StateSource &state, const std::string &at) const {
  const std::vector<int> of_first = rows_of<int>(state, at + "rows/first"),
                         of_second = rows_of<int>(state, at + "rows/second");
  require_ascending_pairs(at + "rows/second", of_first, of_second, particles_);
  for (const char *list : {"search/wide", "search/close", "search/rest_pairs"}) {
    std::vector<int> i, j;
    for (const IndexPair &pair : rows_of<IndexPair>(state, at + list))
      i.push_back(pair.first), j.push_back(pair.second);
    require_ascending_pairs(at + list, i, j, particles_);
    if (list == std::string("search/close") && (i != of_first || j != of_second))
      throw StateError("\"" + at + list + "\" are not the pairs of \"" + at + "rows\"");
  }
}

} // namespace platen::dem
