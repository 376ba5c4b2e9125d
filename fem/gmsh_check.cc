#include "fem/gmsh.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_set>
#include <vector>

#include "fem/words.h"

namespace platen::fem {
namespace {

using Id = int;

enum Kind { line_kind = 1, quad_kind = 3, hexahedron_kind = 5, point_kind = 15 };

struct Element {
  Kind kind;
  int line;
  std::array<Id, 8> nodes; // -1 beyond the nodes of its kind
};

int nodes_of(const Words &words, int kind) {
  switch (kind) {
    case line_kind:
      return 2;
    case quad_kind:
      return 4;
    case hexahedron_kind:
      return 8;
    case point_kind:
      return 1;
  }
  words.refuse(
      "elements of type " + std::to_string(kind) +
      ": only hexahedra are taken, with quadrilaterals and lines on them (in Gmsh: transfinite volumes "
      "with Recombine, or extrusions with Layers and Recombine)");
}

struct Contents {
  std::unordered_set<Id> nodes;
  std::vector<Element> elements;
};

void add_node(Words &words, Contents &mesh) {
  const Id id = words.whole("number of a node", 1);
  if (!mesh.nodes.insert(id).second) words.refuse("node " + std::to_string(id) + " is there twice");
}

void add_element(Words &words, int kind, Contents &mesh) {
  Element element{static_cast<Kind>(kind), words.line(), {}};
  element.nodes.fill(-1);
  for (int k = 0, count = nodes_of(words, kind); k < count; ++k) {
    const Id id = words.whole("number of a node", 1);
    if (mesh.nodes.count(id) == 0) words.refuse("names node " + std::to_string(id) + ", which is not there");
    if (std::find(element.nodes.begin(), element.nodes.begin() + k, id) != element.nodes.begin() + k)
      words.refuse("names node " + std::to_string(id) + " twice in one element");
    element.nodes[static_cast<std::size_t>(k)] = id;
  }
  element.line = words.line();
  mesh.elements.push_back(element);
}

// Format 2.2: single nodes and elements.
void read_singly(Words &words, Contents &mesh) {
  for (int k = 0, count = words.whole("number of nodes", 1); k < count; ++k) {
    add_node(words, mesh);
    words.numbers("coordinate of a node", 3);
  }
  words.expect("$EndNodes");
  words.expect("$Elements");
  for (int k = 0, count = words.whole("number of elements", 1); k < count; ++k) {
    words.whole("number of an element", 0);
    const int kind = words.whole("type of an element", 1);
    for (int tag = 0, tags = words.whole("number of tags", 0); tag < tags; ++tag)
      words.whole("tag of an element", tag < 2 ? 0 : -Words::most);
    add_element(words, kind, mesh);
  }
}

// Format 4.1: in blocks, one for each entity of the geometry.
void read_in_blocks(Words &words, Contents &mesh) {
  const int node_blocks = words.whole("number of blocks", 1), nodes = words.whole("number of nodes", 1);
  words.whole("smallest number of a node", 0);
  words.whole("largest number of a node", 0);
  for (int block = 0; block < node_blocks; ++block) {
    const int dimension = words.whole("dimension of an entity", 0, 3);
    words.whole("number of an entity", -Words::most);
    const int parametric = words.whole("whether coordinates are parametric", 0, 1);
    const int count = words.whole("number of nodes in the block", 0, nodes);
    for (int k = 0; k < count; ++k)
      add_node(words, mesh);
    for (int k = 0; k < count; ++k)
      words.numbers("coordinate of a node", 3 + parametric * dimension);
  }
  if (mesh.nodes.size() != static_cast<std::size_t>(nodes))
    words.refuse("has " + std::to_string(mesh.nodes.size()) + " nodes, not " + std::to_string(nodes));
  words.expect("$EndNodes");
  words.expect("$Elements");
  const int blocks = words.whole("number of blocks", 1), elements = words.whole("number of elements", 1);
  words.whole("smallest number of an element", 0);
  words.whole("largest number of an element", 0);
  for (int block = 0; block < blocks; ++block) {
    words.whole("dimension of an entity", 0, 3);
    words.whole("number of an entity", -Words::most);
    const int kind = words.whole("type of an element", 1);
    const int count = words.whole("number of elements in the block", 0, elements);
    for (int k = 0; k < count; ++k) {
      words.whole("number of an element", 0);
      add_element(words, kind, mesh);
    }
  }
  if (mesh.elements.size() != static_cast<std::size_t>(elements))
    words.refuse("has " + std::to_string(mesh.elements.size()) + " elements, not " +
                 std::to_string(elements));
}

void read_entities(Words &words) {
  std::array<int, 4> count{};
  for (int &of_dimension : count)
    of_dimension = words.whole("number of entities", 0);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (int k = 0; k < count[static_cast<std::size_t>(dimension)]; ++k) {
      words.whole("number of an entity", -Words::most);
      words.numbers("bound of an entity", dimension == 0 ? 3 : 6);
      for (int of = 0; of < (dimension == 0 ? 1 : 2); ++of) // physical groups, bounding entities
        for (int tag = 0, tags = words.whole("number of tags", 0); tag < tags; ++tag)
          words.whole("tag of an entity", of == 0 ? 0 : -Words::most);
    }
  words.expect("$EndEntities");
}

Contents read(Words &words) {
  words.expect("$MeshFormat");
  const std::string version(words.next());
  if (version != "2.2" && version != "4.1")
    words.refuse("format " + Words::quoted(version) + ". Allowed: 2.2 or 4.1 (gmsh -format msh22, msh41)");
  if (words.whole("kind of file (1: binary)", 0, 1) != 0)
    words.refuse("a binary file. Allowed: ASCII (gmsh without -bin)");
  words.whole("size of a number", 8, 8);
  words.expect("$EndMeshFormat");
  std::string_view section = words.next();
  if (section == "$PhysicalNames") {
    words.skip_to("$EndPhysicalNames");
    section = words.next();
  }
  if (section == "$Entities" && version == "4.1") {
    read_entities(words);
    section = words.next();
  }
  if (section != "$Nodes") words.refuse(Words::quoted(section) + " where $Nodes is due");
  Contents mesh;
  version == "2.2" ? read_singly(words, mesh) : read_in_blocks(words, mesh);
  words.expect("$EndElements");
  return mesh;
}

// Equal for equal loops of corners, with any start and direction.
using Face = std::array<Id, 4>;
Face face_of(Face loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  if (loop[1] > loop[3]) std::swap(loop[1], loop[3]);
  return loop;
}
using Edge = std::array<Id, 2>;
Edge edge_of(Id a, Id b) {
  return {std::min(a, b), std::max(a, b)};
}

template <class Item>
bool holds(const std::vector<Item> &sorted, const Item &item) {
  return std::binary_search(sorted.begin(), sorted.end(), item);
}

template <class Nodes>
std::string named(const Nodes &nodes) {
  std::string text;
  for (const Id id : nodes)
    text += " " + std::to_string(id);
  return text;
}

// Two faces of the same four nodes are one, unless a cell has its nodes in another order.
void check_loops(const Words &words, const std::vector<Face> &faces) {
  std::vector<std::array<Face, 2>> loops; // nodes in order, loop
  for (const Face &face : faces) {
    loops.push_back({face, face});
    std::sort(loops.back()[0].begin(), loops.back()[0].end());
  }
  std::sort(loops.begin(), loops.end());
  for (std::size_t k = 1; k < loops.size(); ++k)
    if (loops[k][0] == loops[k - 1][0] && loops[k][1] != loops[k - 1][1])
      words.refuse("two hexahedra go through the nodes" + named(loops[k][0]) + " of a face in another order");
}

void check_body(const Words &words, const Contents &mesh) {
  constexpr std::size_t sides[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                       {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::vector<Face> faces;
  std::vector<Edge> edges;
  std::vector<std::array<Id, 8>> bodies;
  for (const Element &element : mesh.elements) {
    if (element.kind != hexahedron_kind) continue;
    const std::array<Id, 8> &n = element.nodes;
    bodies.push_back(n);
    std::sort(bodies.back().begin(), bodies.back().end());
    for (const auto &side : sides) {
      faces.push_back(face_of({n[side[0]], n[side[1]], n[side[2]], n[side[3]]}));
      for (std::size_t k = 0; k < 4; ++k)
        edges.push_back(edge_of(n[side[k]], n[side[(k + 1) % 4]]));
    }
  }
  if (bodies.empty()) words.refuse("there are no hexahedra");
  std::sort(bodies.begin(), bodies.end());
  std::sort(faces.begin(), faces.end());
  std::sort(edges.begin(), edges.end());
  if (const auto twice = std::adjacent_find(bodies.begin(), bodies.end()); twice != bodies.end())
    words.refuse("two hexahedra have the same nodes" + named(*twice));
  for (std::size_t k = 2; k < faces.size(); ++k)
    if (faces[k] == faces[k - 2]) words.refuse("three hexahedra share the face of nodes" + named(faces[k]));
  check_loops(words, faces);
  for (const Element &element : mesh.elements) {
    const std::array<Id, 8> &n = element.nodes;
    if (element.kind == quad_kind && !holds(faces, face_of({n[0], n[1], n[2], n[3]})))
      words.refuse(element.line, "the quadrilateral is no face of a hexahedron");
    if (element.kind == line_kind && !holds(edges, edge_of(n[0], n[1])))
      words.refuse(element.line, "the line is no edge of a hexahedron");
  }
}

} // namespace

void check_gmsh(std::string_view text, const std::string &name) {
  Words words(text, name);
  check_body(words, read(words));
}

} // namespace platen::fem
