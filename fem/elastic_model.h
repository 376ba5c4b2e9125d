// A linear elastic solid as numbers: nodes, stiffness, lumped mass. Small strain, hexahedra of degree 1 or 2
// on trilinear cells (degree 2 bends and nearly keeps its volume without locking, so it is the one for thin
// sheets and for rubber).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "fem/grids.h"
#include "fem/material.h"
#include "fem/node_matrix.h"

namespace dealii {
template <int dim, int spacedim>
class DoFHandler;
}

namespace platen::fem {

struct ElasticModel {
  Grid grid;
  int degree = 1;
  std::vector<Material> materials; // by material id of the cells
  // Numbers the nodes: one per node, of dealii::FE_Q(degree).
  std::shared_ptr<const dealii::DoFHandler<3, 3>> numbers;
  std::vector<Vector3> nodes;     // m
  std::vector<int> cell_nodes;    // (degree + 1)^3 per cell, in deal.II's order
  std::vector<int> cell_material; // one per cell
  NodeMatrix stiffness;           // N/m, exactly symmetric
  std::vector<double> mass;       // kg, lumped, positive; the sum is the mass of the solid
  double volume = 0;              // m^3
  // Upper bound of the eigenvalues of mass^-1 stiffness (1/s^2): the largest over cells of a norm of the
  // cell's own (Irons), free of iterations and coarse.
  double cell_bound = 0;
};

// Throws std::invalid_argument where the degree is neither 1 nor 2, a cell has a material id that is not in
// `materials`, a constant is out of range, or a cell is inverted or warped through itself (naming the cell).
ElasticModel make_elastic_model(Grid grid, int degree, std::vector<Material> materials);

// The boundary with every node on it as a vertex, so that loads on vertices are loads on nodes: each face of
// a cell of degree 2 is split in four at its nodes.
NodeSurface node_surface(const ElasticModel &model);

// Nodes on boundary faces of this tag, ascending.
std::vector<int> nodes_on(const ElasticModel &model, int tag);

// Nodal loads (N) that do the work of a force per volume (N/m^3, of the reference place).
std::vector<Vector3> body_load(const ElasticModel &model,
                               const std::function<Vector3(const Vector3 &)> &density);

// Stress xx, yy, zz, yz, zx, xy (Pa), tension positive.
using Stress = std::array<double, 6>;
double von_mises(const Stress &stress); // Pa

// Of a displacement given at the nodes (m). Taken where it is most accurate, at the Gauss points of the order
// below (Barlow 1976), and carried from there to the cell's middle or nodes.
std::vector<Stress> cell_stress(const ElasticModel &model, const std::vector<Vector3> &displacement);
// One per entry of cell_nodes: the mean over all cells of the same material that share the node.
std::vector<Stress> nodal_stress(const ElasticModel &model, const std::vector<Vector3> &displacement);

// The indentation of a mesh under a force on one place of its surface. It has no limit as the mesh is refined
// and depends on where in a face the force acts; a contact that knows it can take it out of its own spring.
//
// Where the body goes on far and wide, as that of a half space with this mesh: what the body as a whole gives
// way, being thin, narrow or fixed, is none of it. One per face of the surface, the same on both sides of an
// edge. Each vertex with the cells around it is solved for, fixed at what lies beyond; the rest, some tenth
// of the whole, is beyond_the_patch (1 - nu^2) / E times the mean of 1 / r over what holds it. Measured:
// within 3 % of a half space for cubes of degree 1 or 2 and nu up to 0.4, 11 % for cells half as thick as
// wide. Vertices that `fixed` holds in any component have none.
std::vector<FaceCompliance> face_compliance(const ElasticModel &model, const NodeSurface &surface,
                                            const Fixed &fixed);

} // namespace platen::fem
