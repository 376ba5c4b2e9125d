#include "tests/dem/broken_specimens.h"

#include "dem/packing/advancing_front.h"

namespace platen::dem::examples {
namespace {

const Specimen &packed() {
  static const Specimen specimen = advancing_front(
      cylinder(Cylinder::width * radius, Cylinder::length * radius), uniform_radii_of_spread(radius, .25), 5);
  return specimen;
}

// Closer than touching alone, so that a sphere has six bonds and more.
BondLayout layout() {
  BondLayout l = bonded().bond_layout;
  l.gap.value = .05;
  return l;
}

} // namespace

Cylinder::Cylinder(const BondParameters &of_bonds)
    : shape(packed().shape), particles(packed(), 2400, true), bonds(particles, layout(), of_bonds) {}

void Cylinder::cut_rows(const std::function<int(std::size_t row)> &label) {
  break_rows_where(bonds, particles, [&](std::size_t k) {
    const int one = label(bonds.first[k]), other = label(bonds.second[k]);
    return one != other || one == crumbs;
  });
  bonds.compact();
}

void Cylinder::cut(const std::function<int(const Vector3 &centre)> &label) {
  cut_rows([&](std::size_t row) { return label(particles.reference_position[row]); });
}

} // namespace platen::dem::examples
