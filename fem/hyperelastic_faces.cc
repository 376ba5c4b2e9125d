// Functions of HyperelasticSolid for faces and single cells: pressure, volumes, inversion, stiffness.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "fem/hyperelastic_solid.h"
#include "fem/node_matrix.h"

namespace platen::fem {

FaceCorners HyperelasticSolid::face_places(const BoundaryFace &face,
                                           const std::vector<Vector3> &displacement) const {
  FaceCorners place;
  for (std::size_t k = 0; k < 4; ++k)
    place[k] = mesh_.nodes[index(face.nodes[k])] + displacement[index(face.nodes[k])];
  return place;
}

void HyperelasticSolid::add_pressure_forces() {
  std::fill(pressed_.begin(), pressed_.end(), Vector3{});
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    if (face_pressure_[f] == 0) continue;
    const FaceCorners areas = corner_areas(face_places(mesh_.faces[f], displacement_));
    for (std::size_t k = 0; k < 4; ++k) {
      Vector3 &sum = pressed_[index(mesh_.faces[f].nodes[k])];
      sum = sum - face_pressure_[f] * areas[k];
    }
  }
}

double HyperelasticSolid::pressure_work_to(const std::vector<Vector3> &displacement,
                                           const std::vector<double> &pressures) const {
  double work = 0;
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
    if (pressures[f] != 0)
      work -= pressures[f] * swept_volume(face_places(mesh_.faces[f], displacement_),
                                          face_places(mesh_.faces[f], displacement));
  return work;
}

// By the divergence theorem: faces as bilinear patches (exact, flat or warped), then each rim as a fan of
// triangles about the mean of its nodes.
double HyperelasticSolid::enclosed_volume(int tag) const {
  std::set<std::pair<int, int>> edges; // edges passed in one direction only
  double volume = 0;
  Vector3 origin{}; // a near origin loses fewer digits
  bool found = false;
  for (const BoundaryFace &face : mesh_.faces) {
    if (face.tag != tag) continue;
    const FaceCorners place = face_places(face, displacement_);
    if (!found) origin = place[0], found = true;
    const Vector3 middle = 0.25 * ((place[0] + place[1]) + (place[2] + place[3])) - origin;
    volume += dot(middle, cross(place[2] - place[0], place[3] - place[1])) / 6;
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = face.nodes[k], b = face.nodes[(k + 1) % 4];
      if (edges.erase({b, a}) == 0) edges.insert({a, b});
    }
  }
  if (!found) throw std::invalid_argument("solid: no face has the tag " + std::to_string(tag));
  const std::map<int, int> next(edges.begin(), edges.end());
  std::set<int> done;
  for (const auto &start : next) {
    std::vector<Vector3> ring;
    Vector3 middle{};
    for (int n = start.first; done.insert(n).second; n = next.at(n)) {
      ring.push_back(node_place(n) - origin);
      middle = middle + ring.back();
    }
    if (ring.empty()) continue;
    middle = (1.0 / static_cast<double>(ring.size())) * middle;
    for (std::size_t k = 0; k < ring.size(); ++k)
      volume += dot(middle, cross(ring[(k + 1) % ring.size()], ring[k])) / 6;
  }
  return std::abs(volume);
}

HyperelasticSolid::Worst HyperelasticSolid::first_inverted(const std::vector<Vector3> &displacement) const {
  struct First {
    Worst worst;
    void operator+=(const First &other) {
      if (worst.cell < 0) worst = other.worst;
    }
  };
  const auto check = [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      const Corners own = mesh_.gather(c, displacement);
      Corners place;
      for (std::size_t a = 0; a < 8; ++a)
        place[a] = mesh_.nodes[index(mesh_.cell_nodes[c][a])] + own[a];
      const double ratio = smallest_volume_ratio(mesh_.cells[c], own, place);
      if (is_inverted(ratio)) return First{{static_cast<int>(c), ratio}};
    }
    return First{};
  };
  return ordered_sum<First>(mesh_.cells.size(), check, cell_grain).worst;
}

Vector3 HyperelasticSolid::cell_middle(int cell, const std::vector<Vector3> &displacement) const {
  Vector3 middle{};
  for (const int n : mesh_.cell_nodes[index(cell)])
    middle = middle + 0.125 * (mesh_.nodes[index(n)] + displacement[index(n)]);
  return middle;
}

std::string HyperelasticSolid::words_of_loads() const {
  std::map<int, double> pressures;
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
    if (face_pressure_[f] != 0) pressures[mesh_.faces[f].tag] = face_pressure_[f];
  std::ostringstream text;
  for (const auto &[tag, pressure] : pressures)
    text << "pressure " << pressure << " Pa on side " << tag << ", ";
  const Vector3 force = total_force();
  text << "contact force (" << force[0] << ", " << force[1] << ", " << force[2] << ") N";
  return text.str();
}

void HyperelasticSolid::check(const std::vector<Vector3> &displacement) const {
  const Worst worst = first_inverted(displacement);
  if (worst.cell < 0) return;
  const Vector3 at = cell_middle(worst.cell, displacement);
  std::ostringstream text;
  text << "solid: cell " << worst.cell << " at (" << at[0] << ", " << at[1] << ", " << at[2]
       << ") m would turn inside out: volume ratio " << worst.volume_ratio << ", at least " << inverted_share
       << " is needed; " << words_of_loads();
  throw InvertedElement(text.str(), worst.cell, at, worst.volume_ratio);
}

CellStiffness HyperelasticSolid::total_stiffness(std::size_t cell) const {
  CellStiffness k = cell_stiffness(material_.law, mesh_.cells[cell], mesh_.gather(cell, displacement_),
                                   plastic_ ? &after_[cell] : nullptr);
  if (material_.fibres)
    add_fibres(*material_.fibres, fibre_cells_[cell], mesh_.cells[cell], mesh_.gather(cell, displacement_),
               k);
  for (std::size_t f = first_face_[cell]; f < first_face_[cell + 1]; ++f) {
    if (face_pressure_[f] == 0) continue;
    const BoundaryFace &face = mesh_.faces[f];
    const std::array<double, 144> gradient = corner_area_gradient(face_places(face, displacement_));
    for (std::size_t m = 0; m < 12; ++m)
      for (std::size_t n = 0; n < 12; ++n)
        k[24 * (3 * index(face.corners[m / 3]) + m % 3) + 3 * index(face.corners[n / 3]) + n % 3] +=
            face_pressure_[f] * gradient[12 * m + n];
  }
  return k;
}

// One block for each pair of nodes that share a cell.
void HyperelasticSolid::lay_out_stiffness() {
  std::vector<int> neighbours;
  for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
    neighbours.clear();
    for (std::size_t k = mesh_.first_corner[n]; k < mesh_.first_corner[n + 1]; ++k)
      for (const int other : mesh_.cell_nodes[mesh_.corner[k] / 8])
        neighbours.push_back(other);
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    stiffness_.column.insert(stiffness_.column.end(), neighbours.begin(), neighbours.end());
    stiffness_.begin.push_back(stiffness_.column.size());
  }
}

// The symmetric part: only at its rims is the stiffness of the pressure not symmetric.
void HyperelasticSolid::assemble(const std::vector<CellStiffness> &cells, NodeMatrix &rows) const {
  rows.clear_blocks();
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = 0; b < 8; ++b) {
        double *block = rows.find(index(mesh_.cell_nodes[c][a]), mesh_.cell_nodes[c][b]);
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t m = 3 * a + i, n = 3 * b + j;
            block[i + 3 * j] += 0.5 * (cells[c][24 * m + n] + cells[c][24 * n + m]);
          }
      }
}

// Bound: the largest eigenvalue of one cell, with the cell's own part of the masses (Irons, Treharne 1971;
// each pressed face belongs to one cell). Neighbours that share nodes rarely oscillate all at once.
double HyperelasticSolid::stable_step() const {
  struct Largest {
    double value = 0;
    void operator+=(const Largest &other) { value = std::max(value, other.value); }
  };
  std::vector<CellStiffness> cells(mesh_.cells.size());
  const auto check = [&](std::size_t first, std::size_t last) {
    Largest largest;
    for (std::size_t c = first; c < last; ++c) {
      cells[c] = total_stiffness(c);
      largest += {eigenvalue_bound(cells[c], mesh_.cells[c].node_volume) / material_.density};
    }
    return largest;
  };
  const double bound = ordered_sum<Largest>(mesh_.cells.size(), check, cell_grain).value;
  if (!(bound > 0)) return std::numeric_limits<double>::infinity();
  NodeMatrix rows = stiffness_;
  assemble(cells, rows);
  Fixed fixed(prescribed_.size());
  for (std::size_t n = 0; n < prescribed_.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k)
      fixed[n][k] = is_prescribed(n, k);
  return 2 / std::sqrt(largest_eigenvalue(rows, mass_, fixed, bound));
}

} // namespace platen::fem
