// A discrete linear elastic solid: nodes, stiffness, lumped mass. Small strain, hexahedra of degree 1 or 2 on
// trilinear cells. Degree 2 does not lock in bending or near incompressibility, so it suits thin sheets and
// rubber. Cells of a material that yields keep the volume in mean (degree 1) or linearly, so that neither
// degree locks when it flows.
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
  int degree = 1;
  std::vector<Material> materials; // by material id of the cells
  // Node numbers: one per node of dealii::FE_Q(degree). They keep deal.II's grid alive.
  std::shared_ptr<const dealii::DoFHandler<3, 3>> numbers;
  std::vector<Vector3> nodes;     // m
  std::vector<int> cell_nodes;    // (degree + 1)^3 per cell, in deal.II's order
  std::vector<int> cell_material; // one per cell
  NodeMatrix stiffness;           // N/m, exactly symmetric
  std::vector<double> mass;       // kg, lumped, positive; the sum is the mass of the solid
  double volume = 0;              // m^3
  // Upper bound of the eigenvalues of mass^-1 stiffness (1/s^2): the largest over cells of a norm of the
  // cell's own matrix (Irons). It needs no iterations and is coarse.
  double cell_bound = 0;
};

// Throws std::invalid_argument where the degree is neither 1 nor 2, a cell has a material id that is not in
// `materials`, a constant is out of range, or a cell is inverted or warped through itself (naming the cell).
ElasticModel make_elastic_model(const Grid &grid, int degree, std::vector<Material> materials);

// The boundary, with each boundary node as a vertex, so that loads on vertices are loads on nodes: each face
// of a cell of degree 2 is split into four at its nodes.
NodeSurface node_surface(const ElasticModel &model);

// Nodes on boundary faces of this tag, ascending.
std::vector<int> nodes_on(const ElasticModel &model, int tag);

// Nodal loads (N) that do the same work as a force per volume (N/m^3, at the reference position).
std::vector<Vector3> body_load(const ElasticModel &model,
                               const std::function<Vector3(const Vector3 &)> &density);

// Stress xx, yy, zz, yz, zx, xy (Pa), tension positive.
using Stress = std::array<double, 6>;
double von_mises(const Stress &stress); // Pa

// Stress for displacements at the nodes (m). It is computed at the Gauss points of the next lower order,
// where it is most accurate (Barlow 1976), then averaged over the cell or extrapolated to its nodes.
// `plastic`: YieldingCells::stresses of a solid that yields, to be taken off. Its nodes have the mean of the
// cell, which is on the yield surface or within as those of the points are.
std::vector<Stress> cell_stress(const ElasticModel &model, const std::vector<Vector3> &displacement,
                                const std::vector<Stress> &plastic = {});
// One entry per entry of cell_nodes: the mean over all cells of the same material that share the node.
std::vector<Stress> nodal_stress(const ElasticModel &model, const std::vector<Vector3> &displacement,
                                 const std::vector<Stress> &plastic = {});

// The indentation of a mesh under a point force on its surface. It diverges as the mesh is refined and
// depends on the position of the force in a face; a contact can subtract it from its own compliance.
//
// The compliance is that of a half space with this mesh: it excludes the global deformation of a thin, narrow
// or fixed body. One entry per face of the surface, equal on both sides of an edge. For each vertex, the
// nodes of the cells around it are solved for with all other nodes fixed; the rest, about a tenth of the
// total, is beyond_the_patch (1 - nu^2) / E times the mean of 1 / r over the fixed neighbours. Measured:
// within 3 % of a half space for cubes of degree 1 or 2 and nu up to 0.4, 11 % for cells half as thick as
// wide. Vertices with any component in `fixed` have zero compliance.
std::vector<FaceCompliance> face_compliance(const ElasticModel &model, const NodeSurface &surface,
                                            const Fixed &fixed);

} // namespace platen::fem
