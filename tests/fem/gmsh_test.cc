#include "fem/gmsh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "fem/elastic_model.h"

namespace platen::fem::gmsh_test {
namespace {

constexpr Material steel{7850, 210e9, 0.3};

// A block of 2 x 2 x 1 hexahedra, sides 10 mm, in mm: two of physical volume 7 and two of 3. `last` places
// the last node.
std::string block(const std::string &surfaces = "", const std::string &last = "20 20 10") {
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n18\n";
  int node = 0;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        if (++node == 18)
          text << "18 " << last << "\n";
        else
          text << node << " " << 10 * i << " " << 10 * j << " " << 10 * k << "\n";
  const int named = surfaces.empty() ? 0 : 1;
  text << "$EndNodes\n$Elements\n" << 4 + named << "\n" << surfaces;
  for (int e = 0; e < 4; ++e) {
    const int a = 1 + e % 2 + 3 * (e / 2);
    text << e + 1 + named << " 5 2 " << (e < 2 ? 7 : 3) << " 1";
    for (const int offset : {0, 1, 4, 3, 9, 10, 13, 12})
      text << " " << a + offset;
    text << "\n";
  }
  text << "$EndElements\n";
  return text.str();
}

// The same block in format 4.1, with one entity a volume and one surface of physical number 9.
std::string block_in_entities() {
  std::ostringstream text;
  text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 9 \"foot of it\"\n$EndPhysicalNames\n"
          "$Entities\n1 0 1 2\n1 0 0 0 0\n1 0 0 0 10 10 0 1 9 0\n"
          "1 0 0 0 20 10 10 1 7 1 1\n2 0 10 0 20 20 10 1 3 0\n$EndEntities\n"
          "$Nodes\n2 18 1 18\n2 1 0 9\n";
  for (int node = 1; node <= 18; ++node) {
    text << node << (node == 9 || node == 18 ? "\n" : " ");
    if (node % 9 != 0) continue;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        text << 10 * i << " " << 10 * j << " " << (node == 9 ? 0 : 10) << "\n";
    if (node == 9) text << "3 1 0 9\n";
  }
  text << "$EndNodes\n$Elements\n3 5 1 5\n2 1 3 1\n1 1 2 5 4\n";
  for (int e = 0; e < 4; ++e) {
    if (e % 2 == 0) text << "3 " << 1 + e / 2 << " 5 2\n";
    const int a = 1 + e % 2 + 3 * (e / 2);
    text << e + 2;
    for (const int offset : {0, 1, 4, 3, 9, 10, 13, 12})
      text << " " << a + offset;
    text << "\n";
  }
  text << "$EndElements\n";
  return text.str();
}

std::string refusal(const std::string &text, double unit = 1e-3) {
  std::istringstream stream(text);
  try {
    read_gmsh(stream, {unit, "brush.msh"});
  } catch (const std::invalid_argument &error) {
    return error.what();
  }
  return "";
}

TEST(gmsh, a_block_is_read_with_its_materials_and_ends) {
  std::istringstream stream(block());
  const Grid grid = read_gmsh(stream, {1e-3, "block.msh"});
  const ElasticModel model = make_elastic_model(grid, 1, {steel, {1000, 1e9, 0.2}});
  EXPECT_EQ(model.cell_material.size(), 4u);
  EXPECT_EQ(model.nodes.size(), 18u);
  EXPECT_NEAR(model.volume, 4e-6, 1e-18);
  double mass = 0;
  for (const double m : model.mass)
    mass += m;
  EXPECT_NEAR(mass, 2e-6 * 8850, 1e-12); // physical volume 3 is material 0, 7 is material 1
  EXPECT_EQ(nodes_on(model, low_end_tag).size(), 9u);
  EXPECT_EQ(nodes_on(model, high_end_tag).size(), 9u);
}

TEST(gmsh, both_formats_give_the_same_body) {
  std::istringstream first(block("1 3 2 9 1 1 2 5 4\n")), second(block_in_entities());
  const Grid one = read_gmsh(first, {1e-3, "one.msh"}), other = read_gmsh(second, {1e-3, "other.msh"});
  const ElasticModel a = make_elastic_model(one, 1, {steel, {1000, 1e9, 0.2}});
  const ElasticModel b = make_elastic_model(other, 1, {steel, {1000, 1e9, 0.2}});
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(nodes_on(a, 9).size(), 4u);
  EXPECT_EQ(nodes_on(a, 9), nodes_on(b, 9));
  EXPECT_TRUE(nodes_on(a, high_end_tag).empty()); // named surfaces keep their numbers
}

TEST(gmsh, what_is_no_body_is_refused_with_its_reason) {
  const auto tells = [](const std::string &message, const char *word) {
    EXPECT_NE(message.find("brush.msh"), std::string::npos) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message;
  };
  tells(refusal("not a mesh"), ":1: error: \"not\" where $MeshFormat is due");
  tells(refusal(""), ":1: error: the end of the file where $MeshFormat is due");
  const auto with = [](const std::string &from, const std::string &to) {
    std::string text = block("1 3 2 9 1 1 2 5 4\n");
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  tells(refusal(with("2.2 0 8", "4.0 0 8")), ":2: error: format \"4.0\". Allowed: 2.2 or 4.1");
  tells(refusal(with("2.2 0 8", "2.2 1 8")), ":2: error: a binary file");
  tells(refusal(with("\n2 10 0 0", "\n1 10 0 0")), ":7: error: node 1 is there twice");
  tells(refusal(with("\n2 10 0 0", "\n2 10 nan 0")), ":7: error: coordinate of a node = \"nan\"");
  tells(refusal(with(" 1 1 2 5 4\n", " 1 1 2 5 44\n")), ":27: error: names node 44, which is not there");
  tells(refusal(with(" 1 1 2 5 4\n", " 1 1 2 5 5\n")), ":27: error: names node 5 twice");
  tells(refusal(with(" 1 1 2 5 4\n", " 1 1 2 5 6\n")), ":27: error: the quadrilateral is no face");
  tells(refusal(with("$Elements\n5", "$Elements\n6")), ":32: error: number of an element = \"$EndElements\"");
  tells(refusal(with("$EndElements\n", "")), "the end of the file where $EndElements is due");
  tells(refusal(with("2 3 6 5 11 12 15 14", "1 2 5 4 10 11 14 13")),
        "two hexahedra have the same nodes 1 2 4 5");
  tells(refusal(with("2 3 6 5 11 12 15 14", "11 3 6 5 2 12 15 14")),
        "nodes 2 5 11 14 of a face in another order");
  tells(refusal(block("", "12 12 2")), "inverted or warped");
  tells(refusal(block("", "12 12 2")), "cell 3 at");
  tells(refusal(block(), 1e4), "unit of length");
  tells(refusal(block(), -1), "unit");
  const std::string tetrahedron =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"
      "4 0 0 1\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
  tells(refusal(tetrahedron), "only hexahedra");
}

// `text` with one to three slips: a word that is another of the file, none, doubled or nonsense, or the end.
std::string mangled(const std::string &text, std::mt19937 &random) {
  const char *const nonsense[] = {"-1",     "1e30",   "nan",        "inf",
                                  "0.0001", "$Nodes", "2147483648", "-2147483648"};
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::string result = text;
  const auto word = [&] {
    const std::size_t found = result.find_first_of(" \n", pick(result.size()));
    const std::size_t from = found == std::string::npos ? 0 : found + 1;
    return std::pair(from, std::min(result.find_first_of(" \n", from), result.size()) - from);
  };
  for (std::size_t k = 0, slips = 1 + pick(3); k < slips && !result.empty(); ++k) {
    const auto [from, length] = word();
    const auto [other, others] = word();
    const std::string old = result.substr(from, length), taken = result.substr(other, others);
    const std::size_t what = pick(16);
    result.replace(from, length,
                   what == 0   ? ""
                   : what == 1 ? old + " " + old
                   : what == 2 ? nonsense[pick(std::size(nonsense))]
                               : taken);
    if (what == 3) result.resize(pick(result.size()));
  }
  return result;
}

// Of files with such slips, deal.II takes some for memory that is not there.
TEST(gmsh, mangled_meshes_are_read_or_refused) {
  std::mt19937 random(1);
  const std::string seeds[] = {block("1 3 2 9 1 1 2 5 4\n"), block_in_entities()};
  int read = 0, refused = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::string text = mangled(seeds[round % 2], random);
    std::istringstream stream(text);
    try {
      const Grid grid = read_gmsh(stream, {1e-3, "brush.msh"});
      EXPECT_GT(make_elastic_model(grid, 1, std::vector<Material>(8, steel)).volume, 0) << text;
      ++read;
    } catch (const std::invalid_argument &error) {
      EXPECT_EQ(std::string(error.what()).rfind("brush.msh:", 0), 0u) << error.what() << text;
      ++refused;
    }
  }
  EXPECT_GT(read, 200); // some slips do no harm; otherwise nothing but the first line was tried
  EXPECT_GT(refused, 2000);
}

} // namespace
} // namespace platen::fem::gmsh_test
