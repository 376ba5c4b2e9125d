// Parts that describe themselves: written, read, refused, listed and compared by name.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/same_state.h"

namespace platen::archive_test {
namespace {

enum class Phase : int { loading = 3, unloading = 7 };

struct Spring {
  double force = 0;
  void describe(Archive &archive) {
    archive.version(1);
    archive("force", force, "N");
  }
};

struct Machine {
  double time = 0.1 + 0.2;
  bool on = true;
  Phase phase = Phase::unloading;
  std::array<double, 3> axis{1, -0.0, std::numeric_limits<double>::denorm_min()};
  std::vector<double> nodes{1.0 / 3, std::nan(""), -INFINITY};
  std::vector<int> list{4, 5};
  std::string reason = "bond 7";
  Table table;
  Column<double> &radius = table.add<double>("radius", "m");
  Column<int> &id = table.add<int>("id", "1");
  Spring spring;
  Machine() {
    table.resize(2);
    radius[0] = 0.5, radius[1] = -0.0, id[0] = 8, id[1] = 9;
    spring.force = 6;
  }
  void describe(Archive &archive) {
    archive.version(2);
    archive("time", time, "s");
    archive("on", on);
    archive("phase", phase);
    archive("axis", axis);
    archive.same_rows("nodes", nodes, "m", any_value());
    archive.rows("list", list);
    archive.text("reason", reason);
    archive.table("rows", table);
    archive.part("spring", spring);
  }
};

template <class Act>
std::string message(const Act &act) {
  try {
    act();
  } catch (const StateError &e) {
    return e.what();
  }
  return "nothing was refused";
}

TEST(archive, gives_back_every_bit_of_every_kind_of_value) {
  const Machine whole;
  Machine other;
  other.time = 0, other.on = false, other.phase = Phase::loading, other.axis = {};
  other.nodes = {0, 0, 0}, other.list.clear(), other.reason = "a longer reason", other.table.resize(5);
  other.radius[0] = 3, other.spring.force = 0;
  ASSERT_FALSE(same_state(whole, other));
  set_state(other, state_of(whole));
  EXPECT_TRUE(same_state(whole, other));
  EXPECT_EQ(other.phase, Phase::unloading);
  EXPECT_TRUE(std::signbit(other.axis[1]) && std::signbit(other.radius[1]));
  EXPECT_EQ(other.table.size(), 2u);
}

TEST(archive, names_are_paths_with_units) {
  const State state = state_of(Machine());
  EXPECT_EQ(state.find("state/time")->type.unit, "s");
  EXPECT_EQ(describe(state.find("state/axis")->type), "8-byte floating-point numbers, 3 in a row");
  EXPECT_EQ(describe(state.find("state/rows/radius")->type), "8-byte floating-point numbers (m)");
  EXPECT_EQ(describe(state.find("state/on")->type), "1-byte unsigned integers");
  EXPECT_EQ(describe(state.find("state/phase")->type), "4-byte integers");
  EXPECT_EQ(state.find("state/nodes")->rows, 3u);
  EXPECT_TRUE(state.find("state/spring/force"));
  EXPECT_EQ(text_of(state, "state/reason"), "bond 7");
}

TEST(archive, what_a_state_lacks_is_refused_by_its_name) {
  const State whole = state_of(Machine());
  for (const std::string &name : whole.names()) {
    Machine machine;
    EXPECT_EQ(message([&] { set_state(machine, without(whole, name)); }), "lacks \"" + name + "\"");
  }
}

TEST(archive, what_nobody_asks_for_is_refused_by_its_name) {
  State more = state_of(Machine());
  add_rows(more, "state/spring/heat", std::vector<double>{1}, "J");
  Machine machine;
  EXPECT_EQ(message([&] { set_state(machine, more); }),
            "holds \"state/spring/heat\", which this program has no place for");
}

struct Later : Machine { // with what came later
  double heat = 5;
  Column<double> &wear = table.add<double>("wear", "1", 0.25);
  void describe(Archive &archive) {
    Machine::describe(archive);
    archive("heat", heat, "J", -1.0);
  }
};

TEST(archive, an_older_state_is_read_where_what_it_lacks_has_a_stated_value) {
  const Machine older;
  Later later;
  later.wear[0] = 9;
  set_state(later, state_of(older));
  EXPECT_EQ(later.heat, -1);
  EXPECT_EQ(later.wear[0], 0.25);
  EXPECT_EQ(later.wear[1], 0.25);
  later.heat = 2, later.wear[1] = 3;
  Later back;
  set_state(back, state_of(later)); // and kept from then on
  EXPECT_EQ(back.heat, 2);
  EXPECT_EQ(back.wear[1], 3);
}

TEST(archive, a_part_of_a_newer_version_is_refused_by_its_name) {
  struct Newer : Machine {
    void describe(Archive &archive) { archive.version(3); }
  };
  Machine machine;
  EXPECT_EQ(message([&] { set_state(machine, state_of(Newer())); }),
            "part \"state\" has version 3, this program knows versions up to 2");
  struct Older : Machine {
    int read = 0;
    void describe(Archive &archive) { read = archive.version(4); }
  };
  struct Old {
    void describe(Archive &archive) { archive.version(2); }
  };
  Older knows_more;
  set_state(knows_more, state_of(Old()));
  EXPECT_EQ(knows_more.read, 2);
}

TEST(archive, another_kind_unit_or_length_is_refused_by_name) {
  const State whole = state_of(Machine());
  const auto with = [&](const std::string &name, const BlockType &type, std::size_t rows) {
    State state = without(whole, name);
    const std::vector<char> zeros(rows * type.bytes_per_row());
    state.add(name, type, zeros.data(), rows);
    Machine machine;
    return message([&] { set_state(machine, state); });
  };
  using Kind = BlockType::Kind;
  EXPECT_EQ(with("state/time", {Kind::floating, 4, 1, "s"}, 1),
            "\"state/time\" holds 4-byte floating-point numbers (s), not 8-byte floating-point numbers (s)");
  EXPECT_EQ(with("state/time", {Kind::floating, 8, 1, "ms"}, 1),
            "\"state/time\" holds 8-byte floating-point numbers (ms), not 8-byte floating-point numbers (s)");
  EXPECT_EQ(with("state/time", {Kind::floating, 8, 1, "s"}, 2), "\"state/time\" has 2 rows, 1 are needed");
  EXPECT_EQ(with("state/nodes", {Kind::floating, 8, 1, "m"}, 4), "\"state/nodes\" has 4 rows, 3 are needed");
  EXPECT_EQ(with("state/rows/id", {Kind::signed_integer, 4, 1, "1"}, 3),
            "\"state/rows/id\" has 3 rows, 2 are needed");
}

TEST(archive, a_table_is_left_alone_where_a_column_is_refused) {
  struct Rows {
    Table table;
    Column<double> &mass = table.add<double>("mass", "kg");
    void describe(Archive &archive) { archive.table("rows", table); }
  };
  struct More : Rows {
    Column<double> &damage = table.add<double>("damage", "1");
  };
  Rows stored;
  stored.table.resize(3);
  More other;
  other.table.resize(1);
  other.mass[0] = 7;
  EXPECT_EQ(message([&] { set_state<Rows>(other, state_of(stored)); }), "lacks \"state/rows/damage\"");
  EXPECT_EQ(other.table.size(), 1u);
  EXPECT_EQ(other.mass[0], 7);
}

// A part with a number of every kind that is not all numbers.
struct Bounded {
  double mass = 2, unknown = std::nan(""), limit = INFINITY;
  int word = 1;
  bool on = true;
  std::array<double, 4> turn{0, 1, 0, 0};
  std::vector<int> rows{0, 2};
  std::vector<std::array<double, 3>> normals{{0, 0, 1}, {0, 0, 0}};
  std::vector<double> weights{1, 2};
  Table table;
  Column<double> &radius = table.add<double>("radius", "m", above(0));
  Bounded() {
    table.resize(3);
    for (double &r : radius)
      r = 1;
  }
  void describe(Archive &archive) {
    archive("mass", mass, "kg", above(0));
    archive("unknown", unknown, "Pa", or_nan(at_least(0)));
    archive("limit", limit, "s", or_infinite(above(0)));
    archive("word", word, "1", 1, between(0, 3));
    archive("on", on);
    archive("turn", turn, "1", unit_length());
    archive.rows("rows", rows, "1", row_of(3));
    archive.rows("normals", normals, "1", unit_length_or_zero());
    archive.same_rows("weights", weights, "N");
    archive.same_table("spheres", table);
  }
};

template <class T>
std::string with(const char *name, const std::vector<T> &rows) {
  Bounded part;
  part.mass = 7; // what is there stays there
  const State before = state_of(part);
  const std::string told =
      message([&] { set_state(part, with_rows(state_of(Bounded()), std::string("state/") + name, rows)); });
  EXPECT_TRUE(told == "nothing was refused" || same_state(before, part)) << name;
  return told;
}

TEST(archive, a_number_that_cannot_be_is_refused_by_name_row_and_value) {
  const double nan = std::nan(""), inf = INFINITY;
  const auto refused = [](const std::string &what) { return "\"state/" + what + "."; };
  EXPECT_EQ(with<double>("mass", {-1}), refused("mass\", row 0: -1. Allowed: finite, > 0 kg"));
  EXPECT_EQ(with<double>("mass", {0}), refused("mass\", row 0: 0. Allowed: finite, > 0 kg"));
  EXPECT_EQ(with<double>("mass", {nan}), refused("mass\", row 0: nan. Allowed: finite, > 0 kg"));
  EXPECT_EQ(with<double>("mass", {inf}), refused("mass\", row 0: inf. Allowed: finite, > 0 kg"));
  EXPECT_EQ(with<double>("mass", {1e101}),
            refused("mass\", row 0: 9.9999999999999998e+100. Allowed: finite, > 0 kg"));
  EXPECT_EQ(with<double>("mass", {1e99}), "nothing was refused");
  EXPECT_EQ(with<double>("unknown", {-1}), refused("unknown\", row 0: -1. Allowed: finite, >= 0 Pa, or nan"));
  EXPECT_EQ(with<double>("limit", {nan}), refused("limit\", row 0: nan. Allowed: > 0 s"));
  EXPECT_EQ(with<int>("word", {4}), refused("word\", row 0: 4. Allowed: 0 ... 3"));
  EXPECT_EQ(with<std::uint8_t>("on", {2}), refused("on\", row 0: 2. Allowed: 0 ... 1"));
  EXPECT_EQ(with<int>("rows", {0, 1, -1}), refused("rows\", row 2: -1. Allowed: 0 ... 2"));
  EXPECT_EQ(with<int>("rows", {3}), refused("rows\", row 0: 3. Allowed: 0 ... 2"));
  EXPECT_EQ(with<double>("weights", {1, inf}), refused("weights\", row 1: inf. Allowed: finite numbers N"));
  EXPECT_EQ(with<double>("spheres/radius", {1, 1, 0}),
            refused("spheres/radius\", row 2: 0. Allowed: finite, > 0 m"));
  using Four = std::array<double, 4>;
  EXPECT_EQ(with<Four>("turn", {{1, 1, 0, 0}}),
            refused("turn\", row 0: length 1.4142135623730951. Allowed: a row of length 1"));
  EXPECT_EQ(with<Four>("turn", {{1, 0, nan, 0}}),
            refused("turn\", row 0: number 3 of 4, nan. Allowed: a row of length 1"));
  EXPECT_NE(with<Four>("turn", {{1 + 2e-9, 0, 0, 0}}), "nothing was refused");
  EXPECT_EQ(with<Four>("turn", {{1 + 5e-10, 0, 0, 0}}), "nothing was refused"); // rounding
  using Three = std::array<double, 3>;
  EXPECT_EQ(with<Three>("normals", {{1, 0, 0}, {1e-3, 0, 0}}),
            refused("normals\", row 1: length 0.001. Allowed: a row of length 1, or of zeros"));
  for (const double value : {0.0, 5.0, nan})
    EXPECT_EQ(with<double>("unknown", {value}), "nothing was refused");
  EXPECT_EQ(with<double>("limit", {inf}), "nothing was refused");
  EXPECT_EQ(with<int>("rows", {}), "nothing was refused");
}

TEST(archive, a_table_of_another_size_is_refused_with_both) {
  Bounded more, less;
  more.table.resize(4);
  for (double &r : more.radius)
    r = 5;
  const auto told = [](const Bounded &stored, Bounded &into) {
    const State before = state_of(into);
    const std::string text = message([&] { set_state(into, state_of(stored)); });
    EXPECT_TRUE(same_state(before, into));
    return text;
  };
  EXPECT_EQ(told(more, less), "table \"state/spheres\" has 4 rows, 3 are needed");
  EXPECT_EQ(told(less, more), "table \"state/spheres\" has 3 rows, 4 are needed");
}

// The first blocks are good, the last is not.
TEST(archive, a_part_that_refuses_a_state_is_as_it_was) {
  const Machine good;
  State bad = without(state_of(good), "state/spring/force");
  add_rows(bad, "state/spring/force", std::vector<double>{INFINITY}, "N");
  Machine machine;
  machine.time = 5, machine.list = {1}, machine.reason = "mine", machine.table.resize(4),
  machine.spring.force = 3;
  const State before = state_of(machine);
  EXPECT_NE(message([&] { set_state(machine, bad); }), "nothing was refused");
  EXPECT_TRUE(same_state(before, machine));
  State more = state_of(good);
  add_rows(more, "state/spring/heat", std::vector<double>{1}, "J");
  EXPECT_NE(message([&] { set_state(machine, more); }), "nothing was refused");
  EXPECT_TRUE(same_state(before, machine));
}

TEST(archive, no_name_is_described_twice) {
  struct Twice {
    double a = 0;
    void describe(Archive &archive) { archive("a", a), archive("a", a); }
  };
  EXPECT_THROW(state_of(Twice()), std::logic_error);
}

TEST(state, ranges_pass_over_what_is_no_number) {
  State state;
  add_rows(state, "a", std::vector<std::array<double, 2>>{{3, std::nan("")}, {-2, 5}});
  add_rows(state, "none", std::vector<double>{});
  add_rows(state, "small", std::vector<std::int8_t>{-7, 2});
  add_text(state, "text", "x");
  EXPECT_EQ(range_of(state, "a").least, -2);
  EXPECT_EQ(range_of(state, "a").largest, 5);
  EXPECT_EQ(range_of(state, "small").least, -7);
  EXPECT_EQ(range_of(state, "small").largest, 2);
  EXPECT_TRUE(std::isnan(range_of(state, "none").least) && std::isnan(range_of(state, "text").largest));
}

TEST(state, the_first_difference_is_told_by_name_row_and_number) {
  const Machine a;
  Machine b;
  EXPECT_FALSE(first_difference(state_of(a), state_of(b)));
  const auto told = [&] { return first_difference(state_of(a), state_of(b)).value_or("none"); };
  b.radius[1] = 0.0; // a zero of the other sign is another number
  EXPECT_EQ(told(), "state/rows/radius, row 1: -0 and 0 m");
  b.list = {4, 6};
  EXPECT_EQ(told(), "state/list, row 1: 5 and 6");
  b.list = {4};
  EXPECT_EQ(told(), "state/list: 2 and 1 rows");
  b.axis[2] = 2;
  EXPECT_EQ(told(), "state/axis, row 0, number 3 of 3: 4.9406564584124654e-324 and 2");
  b.phase = Phase::loading;
  EXPECT_EQ(told(), "state/phase, row 0: 7 and 3");
  b.on = false;
  EXPECT_EQ(told(), "state/on, row 0: 1 and 0");
  Machine c;
  c.reason = "bond 8";
  EXPECT_EQ(first_difference(state_of(a), state_of(c)), "state/reason: \"bond 7\" and \"bond 8\"");
  const State whole = state_of(a), less = without(whole, "state/spring/force");
  EXPECT_EQ(first_difference(whole, less), "state/spring/force: only the first has it");
  EXPECT_EQ(first_difference(less, whole), "state/spring/force: only the second has it");
}

} // namespace
} // namespace platen::archive_test
