// VTU files of bodies: their grids with fields; the stresses of rubber for these files.
#include <deal.II/base/data_out_base.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1_eulerian.h>
#include <deal.II/fe/mapping_q_eulerian.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <list>
#include <ostream>
#include <stdexcept>
#include <string>

#include "fem/elastic_solid.h"
#include "fem/hyperelastic_solid.h"
#include "fem/rigid_body.h"

namespace platen::fem {
namespace {

using dealii::DataComponentInterpretation::DataComponentInterpretation;
using Parts = std::vector<DataComponentInterpretation>;

// Fills a finite-element vector: value(entry of cell_nodes, component).
template <class Value>
void fill(const dealii::DoFHandler<3> &numbers, dealii::Vector<double> &field, const Value &value) {
  const dealii::FiniteElement<3> &element = numbers.get_fe();
  const std::size_t nodes = element.n_dofs_per_cell() / element.n_components();
  std::vector<dealii::types::global_dof_index> ids(element.n_dofs_per_cell());
  field.reinit(numbers.n_dofs());
  for (const auto &cell : numbers.active_cell_iterators()) {
    cell->get_dof_indices(ids);
    for (unsigned int k = 0; k < ids.size(); ++k) {
      const auto [component, node] = element.system_to_component_index(k);
      field(ids[k]) = value(nodes * cell->active_cell_index() + node, component);
    }
  }
}

// From row and column of a tensor to its index among xx, yy, zz, yz, zx, xy.
constexpr std::array<std::size_t, 9> voigt = {0, 5, 4, 5, 1, 3, 4, 3, 2};

struct VertexField {
  std::string name;
  std::size_t parts = 1;      // 1: scalar, 3: vector, 9: tensor, row by row
  std::vector<double> values; // `parts` for each vertex of the grid
};

struct CellField {
  std::string name;
  std::vector<double> values; // one per cell
};

VertexField field(const char *name, const std::vector<double> &values) {
  return {name, 1, values};
}
// A field of vectors (3) or tensors (9), one per vertex.
template <std::size_t parts, class Value>
VertexField field(const char *name, const std::vector<Value> &of) {
  VertexField f{name, parts, {}};
  for (const Value &value : of)
    for (std::size_t k = 0; k < parts; ++k)
      f.values.push_back(value[k]);
  return f;
}

// Contact tractions and slip at each node of a body, zero off its surface.
struct ContactFields {
  std::vector<double> pressure, slip; // Pa, m
  std::vector<Vector3> shear;         // Pa
};

// `node`: node of each vertex of the surface. `slip` is one value per vertex, or empty.
ContactFields contact_fields(const std::string &who, const LoadedSurface &body, const std::vector<int> &node,
                             std::size_t nodes, const std::vector<double> &slip) {
  if (!slip.empty() && slip.size() != node.size())
    throw std::invalid_argument(who + ": slip must have one value per surface vertex");
  ContactFields fields{std::vector<double>(nodes), std::vector<double>(nodes), std::vector<Vector3>(nodes)};
  const std::vector<LoadedSurface::Traction> tractions = body.contact_tractions();
  for (std::size_t v = 0; v < node.size(); ++v) {
    const auto n = static_cast<std::size_t>(node[v]);
    fields.pressure[n] = tractions[v].pressure;
    fields.shear[n] = tractions[v].shear;
    if (!slip.empty()) fields.slip[n] = slip[v];
  }
  return fields;
}

DataComponentInterpretation kind_of(std::size_t parts) {
  return parts == 9   ? dealii::DataComponentInterpretation::component_is_part_of_tensor
         : parts == 3 ? dealii::DataComponentInterpretation::component_is_part_of_vector
                      : dealii::DataComponentInterpretation::component_is_scalar;
}

// A field in deal.II's numbering.
struct Numbered {
  dealii::FESystem<3> element;
  dealii::DoFHandler<3> handler;
  dealii::Vector<double> values;

  Numbered(const dealii::Triangulation<3> &grid, const VertexField &field)
      : element(dealii::FE_Q<3>(1), static_cast<unsigned int>(field.parts)), handler(grid) {
    handler.distribute_dofs(element);
    values.reinit(handler.n_dofs());
    for (const auto &cell : handler.active_cell_iterators())
      for (const unsigned int corner : cell->vertex_indices())
        for (unsigned int k = 0; k < field.parts; ++k)
          values(cell->vertex_dof_index(corner, k)) =
              field.values[field.parts * cell->vertex_index(corner) + k];
  }
};

// Binary, zlib; the same state gives the same file.
void write(std::ostream &stream, dealii::DataOut<3> &out, bool higher_order = false) {
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.print_date_and_time = false;
  flags.write_higher_order_cells = higher_order;
  out.set_flags(flags);
  out.write_vtu(stream);
}

// A grid of linear cells. The first of `fields` is the displacement (m), which moves the vertices.
void write_picture(std::ostream &stream, const Grid &grid, const std::vector<VertexField> &fields,
                   const std::vector<CellField> &cells = {}) {
  dealii::DataOut<3> out;
  out.attach_triangulation(*grid);
  std::list<Numbered> numbered; // a list, so that addresses do not change
  for (const VertexField &field : fields) {
    const Numbered &n = numbered.emplace_back(*grid, field);
    out.add_data_vector(n.handler, n.values, std::vector<std::string>(field.parts, field.name),
                        Parts(field.parts, kind_of(field.parts)));
  }
  std::list<dealii::Vector<double>> of_cells;
  for (const CellField &field : cells)
    out.add_data_vector(of_cells.emplace_back(field.values.begin(), field.values.end()), field.name,
                        dealii::DataOut<3>::type_cell_data);
  out.build_patches(dealii::MappingQ1Eulerian<3>(numbered.front().handler, numbered.front().values));
  write(stream, out);
}

} // namespace

void ElasticSolid::write_vtu(std::ostream &stream, const std::vector<double> &slip) const {
  const std::vector<Vector3> u = deformation();
  const ContactFields contact = contact_fields("elastic solid", *this, node_of_, u.size(), slip);
  const std::vector<Stress> stress = nodal_stress(model_, u);
  std::vector<Vector3> displacement(u.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    displacement[i] = carried(i) + to_space(u[i]);
  const auto node = [&](std::size_t entry) { return static_cast<std::size_t>(model_.cell_nodes[entry]); };

  const auto degree = static_cast<unsigned int>(model_.degree);
  const dealii::FE_Q<3> smooth(degree);
  // The nodes of each cell are separate, in the order of the smooth element: stress jumps between materials.
  const dealii::FESystem<3> vector(smooth, 3);
  dealii::DoFHandler<3> scalars(*model_.grid), vectors(*model_.grid), tensors(*model_.grid),
      jumps(*model_.grid);
  scalars.distribute_dofs(smooth), vectors.distribute_dofs(vector);
  const dealii::FE_DGQ<3> own(degree);
  const dealii::FESystem<3> own_tensor(own, 9);
  jumps.distribute_dofs(own), tensors.distribute_dofs(own_tensor);
  // deal.II numbers the nodes of FE_DGQ in rows and those of FE_Q by corners, edges, faces, inside.
  std::vector<unsigned int> by_rows(own.n_dofs_per_cell());
  for (unsigned int a = 0; a < by_rows.size(); ++a)
    for (unsigned int b = 0; b < by_rows.size(); ++b)
      if (own.unit_support_point(a).distance(smooth.unit_support_point(b)) < 0.1) by_rows[a] = b;
  const auto stress_at = [&](std::size_t entry) -> const Stress & {
    return stress[entry - entry % by_rows.size() + by_rows[entry % by_rows.size()]];
  };

  dealii::Vector<double> moves, shears, pressures, slips, tensor, mises;
  fill(vectors, moves, [&](std::size_t k, unsigned int c) { return displacement[node(k)][c]; });
  fill(vectors, shears, [&](std::size_t k, unsigned int c) { return contact.shear[node(k)][c]; });
  fill(scalars, pressures, [&](std::size_t k, unsigned int) { return contact.pressure[node(k)]; });
  fill(scalars, slips, [&](std::size_t k, unsigned int) { return contact.slip[node(k)]; });
  fill(tensors, tensor, [&](std::size_t k, unsigned int c) { return stress_at(k)[voigt[c]]; });
  fill(jumps, mises, [&](std::size_t k, unsigned int) { return von_mises(stress_at(k)); });

  dealii::DataOut<3> out;
  const Parts arrow(3, dealii::DataComponentInterpretation::component_is_part_of_vector);
  const Parts square(9, dealii::DataComponentInterpretation::component_is_part_of_tensor);
  out.add_data_vector(vectors, moves, std::vector<std::string>(3, "displacement"), arrow);
  out.add_data_vector(vectors, shears, std::vector<std::string>(3, "contact_shear"), arrow);
  out.add_data_vector(scalars, pressures, "contact_pressure");
  out.add_data_vector(scalars, slips, "slip");
  out.add_data_vector(tensors, tensor, std::vector<std::string>(9, "stress"), square);
  out.add_data_vector(jumps, mises, "von_mises");
  const dealii::MappingQEulerian<3, dealii::Vector<double>> mapping(degree, vectors, moves);
  out.build_patches(mapping, degree, dealii::DataOut<3>::curved_inner_cells);
  write(stream, out, degree > 1);
}

void RigidBody::write_vtu(std::ostream &stream, const std::vector<double> &slip) const {
  const std::vector<dealii::Point<3>> &places = grid_->get_vertices();
  std::vector<Vector3> displacement;
  for (const dealii::Point<3> &p : places)
    displacement.push_back(current_position({p[0], p[1], p[2]}) - Vector3{p[0], p[1], p[2]});
  const ContactFields contact = contact_fields("body", *this, grid_vertex_, places.size(), slip);
  write_picture(stream, grid_,
                {field<3>("displacement", displacement), field<3>("contact_shear", contact.shear),
                 field("contact_pressure", contact.pressure), field("slip", contact.slip)});
}

std::vector<CellStress> HyperelasticSolid::cell_stresses() const {
  std::vector<CellStress> stresses(mesh_.cells.size());
  for (std::size_t c = 0; c < stresses.size(); ++c)
    stresses[c] = cell_stress(material_.law, mesh_.cells[c], mesh_.gather(c, displacement_));
  return stresses;
}

std::vector<Tensor> HyperelasticSolid::node_stresses() const {
  const std::vector<CellStress> cells = cell_stresses();
  std::vector<Tensor> nodes(mesh_.nodes.size(), Tensor{});
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    double weights = 0;
    for (std::size_t k = mesh_.first_corner[n]; k < mesh_.first_corner[n + 1]; ++k) {
      const std::size_t c = mesh_.corner[k] / 8;
      const double weight = mesh_.cells[c].volume * cells[c].volume_ratio;
      weights += weight;
      for (std::size_t m = 0; m < 9; ++m)
        nodes[n][m] += weight * cells[c].cauchy[m];
    }
    for (double &s : nodes[n])
      s /= weights;
  }
  return nodes;
}

void HyperelasticSolid::write_vtu(std::ostream &stream, const std::vector<double> &slip) const {
  const ContactFields contact = contact_fields("solid", *this, surface_node_, mesh_.nodes.size(), slip);
  const std::vector<Tensor> stress = node_stresses();
  std::vector<double> mises, pressure;
  for (const Tensor &s : stress) {
    mises.push_back(von_mises({s[0], s[4], s[8], s[1], s[5], s[2]}));
    pressure.push_back(-(s[0] + s[4] + s[8]) / 3);
  }
  CellField ratio{"J", {}};
  for (const CellStress &cell : cell_stresses())
    ratio.values.push_back(cell.volume_ratio);
  write_picture(
      stream, grid_,
      {field<3>("displacement", displacement_), field<9>("stress", stress),
       field<3>("contact_shear", contact.shear), field("von_mises", mises), field("pressure", pressure),
       field("contact_pressure", contact.pressure), field("slip", contact.slip)},
      {ratio});
}

} // namespace platen::fem
