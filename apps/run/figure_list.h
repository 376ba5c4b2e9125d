// A row of the list of figures (figures.h), and who takes the rows.
#pragma once

#include <string>

#include "apps/output/summary.h"
#include "apps/scene/scene.h"

namespace platen::apps {

// What a figure needs to be valid. One that needs any of the first five is read off history.csv: it rests on
// all columns but those that rows name as their own.
enum Need : unsigned {
  history = 1u << 0,
  peak = 1u << 1,            // a peak that was reached
  modulus = 1u << 2,         // a stress in which the specimen is elastic
  damage = 1u << 3,          // a stress that has fallen to 0.8 of the peak
  consolidation = 1u << 4,   // a hydrostatic stage
  elastic = 1u << 5,         // no bond that has broken or yielded, where there is no peak
  bare = 1u << 6,            // an even stress, with nothing on the sides that holds them
  stiffness = 1u << 7,       // no more than the bonds can have
  ratio = 1u << 8,           // what an elastic solid can have
  section = 1u << 9,         // a section that is filled
  gauge = 1u << 10,          // spheres in the middle half
  along_z = 1u << 11,        // a test along z
  closure = 1u << 12,        // a strain of the platens that is one of the material
  strain = 1u << 13,         // a strain that is one of the material
  compressed = 1u << 14,     // a test that presses the specimen along its axis
  top_cone = 1u << 15,       // a cone on top
  bottom_cone = 1u << 16,    // on the bottom
  of_machine = 1u << 17,     // costs: Expect does not name them
  of_every_test = 1u << 18,  // also reported, or null, by programs that test without platens
  whole_bar = 1u << 19,      // a bar without a notch
  ligament = 1u << 20,       // a bar with one
  broken_through = 1u << 21, // a load that has fallen to next to nothing, of the platens alone
  torn = 1u << 22            // a wrap that has begun to tear
};
constexpr unsigned read_off = history | peak | modulus | damage | consolidation | torn;
constexpr unsigned youngs = modulus | elastic | bare | stiffness | section | of_every_test,
                   poissons = modulus | elastic | bare | ratio | along_z;

// A line on the screen: "  strength    43.12 MPa".
struct Line {
  std::string label = {};    // "": not shown
  const char *format = "{}"; // of the number times `factor`
  double factor = 1;
};

struct Figure {
  std::string key;          // of summary.json; a member of an object after "/"
  std::string unit;         // SI; "" of words, lists and objects
  unsigned needs = 0;       // of Need
  Line line = {};           // on the screen
  std::string columns = {}; // its own ones of history.csv, which all other figures do without
  bool is_number() const { return !unit.empty(); }
  bool is_read_off() const { return (needs & read_off) != 0; }
  bool is_headline() const { return (needs & read_off & ~unsigned{history}) != 0; } // named in `validity`
};

// Takes the rows one after the other: `take(figure, value)`, and `where(holds)`, by which those that follow
// are reported where it holds. `value` and `holds` are called with a TestRecord (test_record.h), or not at
// all.
template <class Taker>
struct FigureList {
  template <class Value>
  void add(const std::string &key, const char *unit, Value value) {
    add(key, unit, 0, value);
  }
  template <class Value>
  void add(const std::string &key, const char *unit, unsigned needs, Value value) {
    add(key, unit, needs, {}, value);
  }
  template <class Value>
  void add(const std::string &key, const char *unit, unsigned needs, const Line &line, Value value) {
    add(key, unit, needs, line, "", value);
  }
  template <class Value>
  void add(const std::string &key, const char *unit, unsigned needs, const Line &line, const char *columns,
           Value value) {
    static_cast<Taker &>(*this).take({key, unit, needs, line, columns}, value);
  }
  void add_object(const std::string &key, unsigned needs = 0) { // null, until a member is added
    add(key, "", needs, [](auto &) { return Json(); });
  }
};
constexpr auto everywhere = [](const auto &) { return true; };

inline Json list_of(const Vector3 &v) {
  return Json::array({v.x, v.y, v.z});
}
inline Json word_or_null(const std::string &word) {
  return word.empty() ? Json() : Json(word);
}

} // namespace platen::apps
