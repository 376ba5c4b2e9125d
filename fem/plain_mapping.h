// Trilinear cells for deal.II's integration, for .cc files of fem/ only.
#pragma once

#include <deal.II/fe/mapping_q.h>

#include <memory>

namespace platen::fem {

// With one thread, and only then, FEValues takes over the Jacobians of a cell before that has the same shape:
// integrals would differ in their last bits by the number of threads. A mapping that may move vertices is
// never taken as the same.
class PlainMapping : public dealii::MappingQ<3> {
public:
  PlainMapping() : dealii::MappingQ<3>(1) {}
  std::unique_ptr<dealii::Mapping<3>> clone() const override { return std::make_unique<PlainMapping>(); }
  bool preserves_vertex_locations() const override { return false; }
};

} // namespace platen::fem
