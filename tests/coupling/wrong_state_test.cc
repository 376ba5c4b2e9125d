// States that no run can have left: of another specimen, or with one number that cannot be. Each is refused
// by its name, or is one that a step can be made from; what refuses one stays as it was.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tests/coupling/set_ups.h"
#include "tests/same_state.h"

namespace platen::coupling::wrong_state_test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Bonds break, contacts close, slide and roll within some hundred steps.
PlatenTestSettings rolling() {
  PlatenTestSettings s = smooth();
  make_brittle(s);
  s.model.contact->damping = dem::ContactSettings{}.damping;
  s.model.contact->tangential = dem::TangentialContact::coulomb_with_rolling;
  s.model.contact->rolling_friction = 0.1;
  s.model.bond_dashpot = 0.05;
  s.seat = true;
  s.loading.rate = 1;
  s.loading.ramp = 5e-6;
  return s;
}

PlatenTestSettings of_hertz() {
  PlatenTestSettings s = rolling();
  s.model.contact->normal = dem::NormalContact::hertz;
  s.model.contact->tangential = dem::TangentialContact::coulomb;
  s.model.bond_dashpot = 0;
  s.model.scheme = dem::Scheme::tchamwa_wielgosz;
  s.model.phases.emplace();
  s.model.phases->radius_above = 0.85e-3;
  s.model.strength_scatter = dem::StrengthScatter{};
  s.model.strength_scatter->weibull_modulus = 5;
  s.seat = false;
  s.platens.machine.stiffness = 1e7;
  return s;
}

PlatenTestSettings softening() {
  PlatenTestSettings s = rolling();
  dem::ElastoDamagePlastic::Parameters bond;
  bond.tensile_strength = 2e6, bond.shear_strength = 6e6;
  s.model.bond = bond;
  s.model.bond_dashpot = 0;
  s.platens.spherical_seat = true;
  return s;
}

PlatenTestSettings yielding() {
  PlatenTestSettings s = rolling();
  dem::YieldingParallelBond::Parameters bond;
  bond.stiffness_ratio = 0.4, bond.tensile_strength = 2e6, bond.shear_strength = 6e6;
  bond.compression_limits = {2e6, 4e6, 8e6}, bond.compression_slopes = {2, 4, 8};
  s.model.bond = bond;
  return s;
}

PlatenTestSettings beams() {
  PlatenTestSettings s = rolling();
  dem::CohesiveBeam::Parameters bond;
  bond.tensile_strength = 2e6, bond.shear_strength = 6e6;
  s.model.bond = bond;
  s.model.contact->tangential = dem::TangentialContact::none;
  s.loading.unload_at = {2e-4};
  return s;
}

PlatenTestSettings staged() {
  PlatenTestSettings s = hydrostatic(false);
  s.loading.cell->alone = false;
  s.loading.stages = {
      asking({asked_of(SideGroup::lateral, SideControl::Mode::pressure, 1e6),
              asked_of(SideGroup::axial, SideControl::Mode::stress, 1e6)},
             {{Until::Reached::time, 4e-5}}),
      asking({asked_of(SideGroup::axial, SideControl::Mode::circumferential, 1)},
             {{Until::Reached::circumferential_strain, 0.1}, {Until::Reached::fraction_of_peak, 0.5}})};
  s.loading.stages[0].ramp = 2e-5;
  return s;
}

struct Kind {
  const char *name;
  std::function<PlatenTestSettings()> settings;
  long steps;
};
const std::vector<Kind> &kinds() {
  static const std::vector<Kind> all{
      {"bonds that break", rolling, 900},
      {"Hertz, two phases, a soft machine", of_hertz, 900},
      {"interfaces, a seat", softening, 900},
      {"yield", yielding, 900},
      {"beams", beams, 900},
      {"stages", staged, 700},
      {"a pressure on the skin", [] { return hydrostatic(false); }, 300},
      {"a sleeve", [] { return hydrostatic(true); }, 303},
      {"a wall", walled, 300},
      {"a stress that is held", [] { return held_at(5e6); }, 300},
      {"elastic platens", [] { return elastic(rolling(), ElasticMotion::explicit_steps, steel_modulus); },
       300},
      {"static platens", [] { return elastic(rolling(), ElasticMotion::quasi_static, steel_modulus); }, 310},
  };
  return all;
}

bool ends_with(const std::string &text, const std::string &end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}
bool is_any(const std::string &name, const std::vector<const char *> &ends) {
  for (const char *end : ends)
    if (ends_with(name, end)) return true;
  return false;
}

// Rows of other tables.
bool is_row_number(const std::string &name) {
  return is_any(name, {"/first", "/second", "/record", "/particle", "/id", "/loaded_vertices", "search/wide",
                       "search/close", "search/rest_pairs", "program/stage"});
}
bool is_positive(const std::string &name) {
  return is_any(name, {"/radius", "/mass", "/inertia", "/rest_length", "/bond_radius", "/normal_stiffness",
                       "/rest_distance", "/limit", "/limit_of_elements", "state/time_step"});
}
// What may be unknown: not reached, or not there.
bool may_be_nan(const std::string &name) {
  return is_any(name, {"_at_end", "/found", "/largest", "/zero", "contacts/elastic_energy",
                       "springs/elastic_energy", "springs/force", "/confined_share", "/zero_x", "/zero_y",
                       "/zero_z", "closure_at_begin", "strain_of_turn", "strain_found", "/path",
                       "/unbalanced", "/break_time"}); // of a bond that holds
}

// A state with one number in place of that at `place` in the block.
class WithNumber : public StateSource {
public:
  WithNumber(const State &of, const std::string &block, std::size_t place, double value)
      : of_(of), block_(block), stored_(*of.find(block)), place_(place), value_(value) {}
  std::vector<std::string> names() const override { return of_.names(); }
  std::optional<StoredBlock> find(const std::string &name) const override { return of_.find(name); }
  void read(const std::string &name, void *data) const override {
    of_.read(name, data);
    if (name != block_) return;
    char *at = static_cast<char *>(data) + place_ * stored_.type.bytes;
    const auto put = [&](auto number) { std::memcpy(at, &number, sizeof number); };
    if (stored_.type.kind == BlockType::Kind::floating)
      put(value_);
    else if (stored_.type.bytes == 1)
      put(static_cast<std::int8_t>(value_));
    else if (stored_.type.bytes == 4)
      put(static_cast<std::int32_t>(value_));
    else
      put(static_cast<std::int64_t>(value_));
  }

private:
  const State &of_;
  std::string block_;
  StoredBlock stored_;
  std::size_t place_;
  double value_;
};

std::string told_of(PlatenTest &test, const StateSource &state) {
  try {
    read_parts(state, [&](Archive &archive) { archive.part("state", test); });
  } catch (const StateError &e) {
    return e.what();
  }
  return "";
}

// Steps are made, or stop with words.
void make_steps(PlatenTest &test) {
  try {
    test.advance(2);
    test.model.take_cracks();
  } catch (const std::exception &e) {
    EXPECT_NE(std::string(e.what()), "");
  }
}

TEST(wrong_state, one_of_another_specimen_is_refused_with_both_sizes_and_changes_nothing) {
  const dem::Specimen other = small_cylinder(6);
  PlatenTest one(cylinder(), rolling()), two(other, rolling());
  advance_to(one, 300), advance_to(two, 200);
  const std::size_t of_one = one.model.particles.size(), of_two = two.model.particles.size();
  ASSERT_NE(of_one, of_two);
  PlatenTest twin(cylinder(), rolling());
  advance_to(twin, 300);
  const State kept = state_of(one);
  const auto told = [](std::size_t stored, std::size_t needed) {
    return "table \"state/specimen/particles\" has " + std::to_string(stored) + " rows, " +
           std::to_string(needed) + " are needed";
  };
  EXPECT_EQ(told_of(one, state_of(two)), told(of_two, of_one));
  EXPECT_TRUE(same_state(kept, one));
  EXPECT_EQ(told_of(two, kept), told(of_one, of_two));
  // Not in its state alone: both go on as if nothing had been asked.
  EXPECT_EQ(one.energy().contacts, twin.energy().contacts);
  advance_to(one, 350), advance_to(twin, 350);
  EXPECT_TRUE(same_state(twin, one));
}

// Every block, every number of one row in its middle, every kind of number that does not belong there.
TEST(wrong_state, no_number_of_any_block_is_believed_that_cannot_be) {
  std::size_t blocks = 0, refused = 0, taken = 0;
  for (const Kind &setup : kinds()) {
    PlatenTest run(thin_cylinder(), setup.settings()), other(thin_cylinder(), setup.settings());
    advance_to(run, setup.steps);
    const State good = state_of(run);
    ASSERT_EQ(told_of(other, good), "") << setup.name;
    for (const std::string &name : good.names()) {
      const StoredBlock block = *good.find(name);
      if (block.type.kind == BlockType::Kind::text || block.rows == 0) continue;
      ++blocks;
      const bool floating = block.type.kind == BlockType::Kind::floating;
      std::vector<double> values{-1, 0, 1000000};
      if (floating) values.insert(values.end(), {1e300, 1e90, std::nan(""), infinite, -infinite});
      const std::size_t row = block.rows / 2;
      for (std::size_t k = 0; k < std::min<std::size_t>(block.type.numbers, 4); ++k)
        for (const double value : values) {
          SCOPED_TRACE(std::string(setup.name) + ": " + name + " = " + std::to_string(value));
          const std::string why = told_of(other, WithNumber(good, name, row * block.type.numbers + k, value));
          const bool must = (floating && !std::isfinite(value) && !may_be_nan(name)) || std::isinf(value) ||
                            value == 1e300 || (is_row_number(name) && value != 0) ||
                            (is_positive(name) && value <= 0) ||
                            (is_any(name, {"/orientation", "/rotation"}) && std::abs(value) > 1) ||
                            ends_with(name, "/version");
          // A version is that of its part.
          const std::string by = ends_with(name, "/version") ? name.substr(0, name.rfind('/')) : name;
          EXPECT_TRUE(!must || why.find(by) != std::string::npos) << why;
          ++(why.empty() ? taken : refused);
          // Whether rubber is inside out is found when it is read.
          const bool was_read = why.empty() || why.find("inside out") != std::string::npos;
          if (!was_read) continue;
          if (why.empty()) make_steps(other);
          ASSERT_EQ(told_of(other, good), "");
        }
      // Those that were refused have changed nothing since the last that was taken.
      ASSERT_TRUE(same_state(good, other)) << setup.name << ": " << name;
    }
    // Whatever was tried in between.
    advance_to(run, setup.steps + 20), advance_to(other, setup.steps + 20);
    EXPECT_TRUE(
        same_state(without(state_of(run), "/contacts/rows/"), without(state_of(other), "/contacts/rows/")))
        << setup.name;
  }
  std::printf("%zu blocks, %zu numbers refused, %zu taken\n", blocks, refused, taken);
  EXPECT_GT(blocks, 1000u);
  EXPECT_GT(refused, taken);
}

// Each of these is a number that its own column may hold, beside others that it does not go with.
TEST(wrong_state, rows_that_do_not_go_together_are_refused) {
  PlatenTest run(cylinder(), rolling()), other(cylinder(), rolling());
  advance_to(run, 900);
  const State good = state_of(run);
  ASSERT_GT(run.model.broken_tension, 0);
  const auto told = [&](const std::string &name, std::size_t row, double value) {
    return told_of(other, WithNumber(good, "state/" + name, row, value));
  };
  const std::string bonds = "specimen/bonds/", contacts = "specimen/contacts/";
  const auto ints = [&](const std::string &name) { return rows_of<int>(good, "state/" + name); };
  EXPECT_EQ(told(bonds + "rows/record", 3, ints(bonds + "rows/record")[4]),
            "\"state/specimen/bonds/rows/record\", row 3: " + std::to_string(ints(bonds + "rows/record")[4]) +
                ". Allowed: the record of its pair, each once.");
  EXPECT_NE(told(bonds + "rows/second", 3, ints(bonds + "rows/second")[3] + 1), "");
  const int record = ints(bonds + "rows/record")[0];
  EXPECT_NE(told(bonds + "records/state", static_cast<std::size_t>(record), 2), "");
  const std::vector<int> states = ints(bonds + "records/state");
  const std::size_t broken = static_cast<std::size_t>(
      std::find_if(states.begin(), states.end(), [](int s) { return s > 1; }) - states.begin());
  EXPECT_NE(told(bonds + "records/state", broken, 0), "");
  EXPECT_NE(told(bonds + "records/break_time", broken, std::nan("")), "");
  EXPECT_NE(told(bonds + "rows/normal_stiffness", 0, 0), "");
  const std::vector<int> seconds = ints(contacts + "rows/second");
  ASSERT_GT(seconds.size(), 3u);
  EXPECT_NE(told(contacts + "rows/second", 0, seconds[0] + 1), "");
  const std::vector<int> near = ints("bottom/contacts/rows/particle");
  EXPECT_NE(told("bottom/contacts/rows/particle", 1, near[0]), "");
  EXPECT_NE(told("specimen/particles/id", 1, ints("specimen/particles/id")[0]), "");
  EXPECT_EQ(told("specimen/particles/mass", 7, -1),
            "\"state/specimen/particles/mass\", row 7: -1. Allowed: finite, > 0 kg.");
  EXPECT_EQ(told("specimen/particles/orientation", 28, 1e6),
            "\"state/specimen/particles/orientation\", row 7: length 1e6. Allowed: a row of length 1.");
  EXPECT_TRUE(same_state(PlatenTest(cylinder(), rolling()), other)); // all of them left it alone
}

} // namespace
} // namespace platen::coupling::wrong_state_test
