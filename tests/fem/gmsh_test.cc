#include "fem/gmsh.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <string>

#include "fem/elastic_model.h"

namespace platen::fem {
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

TEST(gmsh, named_surfaces_keep_their_numbers) {
  std::istringstream stream(block("1 3 2 9 1 1 2 5 4\n"));
  const Grid grid = read_gmsh(stream, {1e-3, "block.msh"});
  const ElasticModel model = make_elastic_model(grid, 1, {steel, steel});
  EXPECT_EQ(nodes_on(model, 9).size(), 4u);
  EXPECT_TRUE(nodes_on(model, high_end_tag).empty());
}

TEST(gmsh, what_is_no_body_is_refused_with_its_reason) {
  const auto tells = [](const std::string &message, const char *word) {
    EXPECT_NE(message.find("brush.msh"), std::string::npos) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message;
  };
  tells(refusal("not a mesh"), "no mesh of hexahedra");
  tells(refusal(""), "no mesh of hexahedra");
  tells(refusal(block("", "12 12 2")), "inverted or warped");
  tells(refusal(block("", "12 12 2")), "cell 3 at");
  tells(refusal(block(), 1e4), "unit of length");
  tells(refusal(block(), -1), "unit");
  const std::string tetrahedron =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"
      "4 0 0 1\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
  tells(refusal(tetrahedron), "only hexahedra");
}

} // namespace
} // namespace platen::fem
