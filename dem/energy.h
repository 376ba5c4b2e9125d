// Energy balance of a run: stored, lost and supplied energy, all in J.
#pragma once

namespace platen::dem {

struct EnergyLedger {
  double kinetic = 0;  // particles and bodies
  double bonds = 0;    // elastic, in bonds
  double contacts = 0; // elastic, in grain and platen contacts
  double bodies = 0;   // elastic, in deformable bodies
  double damping = 0;  // lost to local and viscous damping, and to a dissipative scheme
  double friction = 0; // lost to sliding and rolling, grains and platens
  double fracture = 0; // lost when bonds break or lose strength
  double plastic = 0;  // lost when bonds yield
  double boundary = 0; // work of platens, servo and weight
  // Part of the residual: work of loads on platens without inertia beyond what the platens store, of either
  // sign.
  double unbalanced = 0;

  EnergyLedger &operator+=(const EnergyLedger &b) {
    kinetic += b.kinetic, bonds += b.bonds, contacts += b.contacts, bodies += b.bodies;
    damping += b.damping, friction += b.friction, fracture += b.fracture, plastic += b.plastic;
    boundary += b.boundary, unbalanced += b.unbalanced;
    return *this;
  }
  double stored() const { return kinetic + bonds + contacts + bodies; }
  double lost() const { return damping + friction + fracture + plastic; }
  // Zero when the balance closes.
  double residual() const { return stored() + lost() - boundary; }
};

} // namespace platen::dem
