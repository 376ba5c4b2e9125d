// Parts that describe themselves: written, read, refused, listed and compared by name.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/same_state.h"

namespace platen {
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
    archive.same_rows("nodes", nodes, "m");
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

// A copy of a state without one block, or with another in its place.
State changed(const State &state, const std::string &left_out) {
  State result;
  for (const std::string &name : state.names()) {
    if (name == left_out) continue;
    const StoredBlock block = *state.find(name);
    std::vector<char> bytes(block.rows * block.type.bytes_per_row());
    state.read(name, bytes.data());
    result.add(name, block.type, bytes.data(), block.rows);
  }
  return result;
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
    EXPECT_EQ(message([&] { set_state(machine, changed(whole, name)); }), "lacks \"" + name + "\"");
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
    State state = changed(whole, name);
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
  const State whole = state_of(a), less = changed(whole, "state/spring/force");
  EXPECT_EQ(first_difference(whole, less), "state/spring/force: only the first has it");
  EXPECT_EQ(first_difference(less, whole), "state/spring/force: only the second has it");
}

} // namespace
} // namespace platen
