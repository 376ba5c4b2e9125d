#include "fem/elastic_model.h"

#include <algorithm>
#include <cmath>

namespace platen::fem {
namespace {

// For a half space, from the difference between it and fixed patches (see the header).
constexpr double beyond_the_patch = 0.55;
// A pivot below this fraction of its diagonal: the patch is not fixed.
constexpr double loose = 1e-10;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

std::vector<Vector3> vertex_normals(const NodeSurface &s) {
  std::vector<Vector3> normal(s.node.size(), Vector3{});
  for (std::size_t f = 0; f < s.surface.faces.size(); ++f) {
    const Vector3 area = face_area_vector(s.surface, f);
    for (const int v : s.surface.faces[f])
      normal[index(v)] = normal[index(v)] + area;
  }
  for (Vector3 &n : normal)
    if (norm(n) > 0) n = (1 / norm(n)) * n;
  return normal;
}

// Solves A x = b by Cholesky's method in place, row by row. False where A is not positive definite.
bool solve(std::vector<double> &a, std::vector<double> &b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    double *row = &a[i * n];
    const double whole = row[i];
    for (std::size_t j = 0; j <= i; ++j) {
      const double *other = &a[j * n];
      double sum = row[j];
      for (std::size_t k = 0; k < j; ++k)
        sum -= row[k] * other[k];
      if (i == j && !(sum > loose * whole)) return false;
      row[j] = i == j ? std::sqrt(sum) : sum / other[j];
    }
    for (std::size_t k = 0; k < i; ++k)
      b[i] -= row[k] * b[k];
    b[i] /= row[i];
  }
  for (std::size_t i = n; i-- > 0;) {
    b[i] /= a[i * n + i];
    for (std::size_t k = 0; k < i; ++k)
      b[k] -= a[i * n + k] * b[i];
  }
  return true;
}

// The patch around one node after another.
class Patch {
public:
  Patch(const ElasticModel &model, const Fixed &fixed) : model_(model), fixed_(fixed) {
    const std::size_t cells = model.cell_material.size();
    per_cell_ = model.cell_nodes.size() / cells;
    cells_of_.resize(model.nodes.size());
    for (std::size_t c = 0; c < cells; ++c)
      for (std::size_t k = 0; k < per_cell_; ++k)
        cells_of_[index(model.cell_nodes[per_cell_ * c + k])].push_back(c);
    place_.assign(model.nodes.size(), -1);
  }

  bool holds(std::size_t node) const { return fixed_[node][0] || fixed_[node][1] || fixed_[node][2]; }

  // Applies a unit force to a node and solves for the patch.
  void push(int node, const Vector3 &direction) {
    for (const int other : nodes_)
      place_[index(other)] = -1;
    nodes_.clear();
    answer_.clear();
    beyond_ = 0;
    if (holds(index(node))) return;
    for (const std::size_t c : cells_of_[index(node)])
      for (std::size_t k = 0; k < per_cell_; ++k)
        if (const int other = model_.cell_nodes[per_cell_ * c + k]; !holds(index(other)))
          nodes_.push_back(other);
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      place_[index(nodes_[k])] = static_cast<int>(k);
    assemble();
    answer_.assign(3 * nodes_.size(), 0.0);
    for (std::size_t k = 0; k < 3; ++k)
      answer_[3 * index(place_[index(node)]) + k] = direction[k];
    if (!solve(matrix_, answer_)) answer_.clear();
    find_beyond(node);
  }

  // m/N: displacement of another node along a direction.
  double moves(int node, const Vector3 &direction, const Vector3 &pushed) const {
    const int k = place_[index(node)];
    if (k < 0 || answer_.empty()) return 0;
    const double *u = &answer_[3 * index(k)];
    return dot(Vector3{u[0], u[1], u[2]}, direction) + beyond_ * dot(direction, pushed);
  }

private:
  void assemble() {
    const std::size_t n = 3 * nodes_.size();
    matrix_.assign(n * n, 0.0);
    border_.clear();
    const NodeMatrix &k = model_.stiffness;
    for (std::size_t row = 0; row < nodes_.size(); ++row)
      for (std::size_t e = k.begin[index(nodes_[row])]; e < k.begin[index(nodes_[row]) + 1]; ++e) {
        const int column = place_[index(k.column[e])];
        if (column < 0) border_.push_back(k.column[e]);
        for (std::size_t i = 0; i < 9 && column >= 0; ++i)
          matrix_[(3 * row + i % 3) * n + 3 * index(column) + i / 3] = k.at(e)[i];
      }
    std::sort(border_.begin(), border_.end());
    border_.erase(std::unique(border_.begin(), border_.end()), border_.end());
  }

  // Nodes fixed by the machine do not move; the rest of the border is compliant.
  void find_beyond(int node) {
    if (border_.empty()) return;
    double sum = 0;
    for (const int other : border_)
      if (!holds(index(other))) sum += 1 / norm(model_.nodes[index(other)] - model_.nodes[index(node)]);
    const Material &m = model_.materials[index(model_.cell_material[cells_of_[index(node)].front()])];
    beyond_ = beyond_the_patch * (1 - m.poisson_ratio * m.poisson_ratio) / m.young_modulus * sum /
              static_cast<double>(border_.size());
  }

  const ElasticModel &model_;
  const Fixed &fixed_;
  std::size_t per_cell_ = 0;
  std::vector<std::vector<std::size_t>> cells_of_; // each node
  std::vector<int> place_;                         // of each node in the patch, or -1
  std::vector<int> nodes_, border_;                // free nodes of the patch, and its fixed neighbours
  std::vector<double> matrix_, answer_;
  double beyond_ = 0; // m/N
};

} // namespace

std::vector<FaceCompliance> face_compliance(const ElasticModel &model, const NodeSurface &surface,
                                            const Fixed &fixed) {
  const std::vector<Vector3> normal = vertex_normals(surface);
  const auto &faces = surface.surface.faces;
  const std::vector<std::vector<int>> faces_of = faces_of_vertices(surface.surface);
  std::vector<FaceCompliance> compliance(faces.size(), FaceCompliance{});
  Patch patch(model, fixed);
  for (std::size_t v = 0; v < surface.node.size(); ++v) {
    patch.push(surface.node[v], normal[v]);
    for (const int f : faces_of[v])
      for (std::size_t i = 0; i < 4; ++i) {
        const std::array<int, 4> &corners = faces[index(f)];
        if (index(corners[i]) != v) continue;
        for (std::size_t j = 0; j < 4; ++j) {
          // Each pair occurs in both orders; what lies beyond differs a little.
          const std::size_t w = index(corners[j]);
          const double half = 0.5 * patch.moves(surface.node[w], normal[w], normal[v]);
          compliance[index(f)][i][j] += half;
          compliance[index(f)][j][i] += half;
        }
      }
  }
  return compliance;
}

} // namespace platen::fem
