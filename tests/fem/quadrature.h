// Loads of a face and integrals over an elastic model, by rules that integrate what varies within cells.
#pragma once

#include <functional>
#include <vector>

#include "fem/elastic_model.h"

namespace platen::fem {

// Nodal loads (N) that do the work of a traction (Pa) at a place with an outward normal, on the faces of a
// tag.
std::vector<Vector3> face_load(const ElasticModel &model, int tag,
                               const std::function<Vector3(const Vector3 &, const Vector3 &)> &traction);

// Integral over the reference volume of f(place, value of a field given at the nodes).
double integral(const ElasticModel &model, const std::vector<Vector3> &field,
                const std::function<double(const Vector3 &, const Vector3 &)> &f);

} // namespace platen::fem
