// Structs of parameters that describe themselves: what the library refuses, by the name of the member.
#include <gtest/gtest.h>

#include <set>

#include "dem/laws/normal_contact.h"
#include "dem/model.h"
#include "tests/dem/examples.h"

namespace platen::dem::describe_test {
namespace {

using namespace examples;

std::string refusal(const BondParameters &parameters) {
  try {
    bond_law(parameters);
  } catch (const BadParameter &e) {
    return e.what();
  }
  return "";
}

TEST(describe, a_law_refuses_a_number_out_of_range_by_its_member) {
  ParallelBond::Parameters bond;
  EXPECT_EQ(refusal(bond), "");
  bond.stiffness_ratio = -1;
  EXPECT_EQ(refusal(bond), "ParallelBond: stiffness_ratio = -1 is out of range. Allowed: 0 ... 5.");
  bond.stiffness_ratio = 5;
  EXPECT_EQ(refusal(bond), "");
  bond.friction_angle = right_angle;
  EXPECT_NE(refusal(bond).find("ParallelBond: friction_angle"), std::string::npos);
  CohesiveBeam::Parameters beam;
  beam.poisson_ratio = 0.5;
  EXPECT_EQ(refusal(beam),
            "CohesiveBeam: poisson_ratio = 0.5 is out of range. Allowed: above -1 ... below 0.5.");
  ElastoDamagePlastic::Parameters interface;
  interface.compression_limits = {1e6, -1};
  EXPECT_NE(refusal(interface).find("compression_limits = -1 is out of range. Allowed: > 0 Pa."),
            std::string::npos);
}

TEST(describe, branches_of_compression_are_three_and_bend_down) {
  ElastoDamagePlastic::Parameters p;
  p.compression_limits = {1e6, 2e6};
  EXPECT_EQ(refusal(p),
            "ElastoDamagePlastic: compression_slopes has 0 numbers. Allowed: as many as limits, 2.");
  p.compression_slopes = {3, 2};
  EXPECT_NE(refusal(p).find("compression_slopes descends"), std::string::npos);
  p.compression_slopes = {2, 3};
  EXPECT_EQ(refusal(p), "");
  const ElastoDamagePlastic law(p);
  EXPECT_EQ(law.compression.branches[2].limit, 2e6); // the last one goes on
  EXPECT_EQ(law.compression.branches[2].slope, 3);
  p.compression_limits = p.compression_slopes = {1e6, 2e6, 3e6, 4e6};
  EXPECT_NE(refusal(p).find("compression_limits has 4 stresses. Allowed: up to 3."), std::string::npos);
}

TEST(describe, a_model_refuses_what_its_settings_cannot_be) {
  const auto refused = [](const ModelSettings &settings) -> std::string {
    try {
      Model(row(1, {1, 0, 0}), settings);
    } catch (const BadParameter &e) {
      return e.owner + " " + e.member;
    }
    return "";
  };
  EXPECT_EQ(refused(bonded()), "");
  ModelSettings damped = bonded(), bare = bonded(), given = bonded(), touching = breakable();
  damped.local_damping = 1;
  EXPECT_EQ(refused(damped), "ModelSettings local_damping");
  bare.bond_layout.modulus = std::nan("");
  EXPECT_EQ(refused(bare), "BondLayout modulus");
  given.bond_layout.radius_rule = RadiusRule::given;
  EXPECT_EQ(refused(given), "BondLayout radius");
  touching.contact->restitution = 0;
  EXPECT_EQ(refused(touching), "ContactSettings restitution");
}

TEST(describe, a_strength_of_zero_is_never_reached) {
  Model model(row(1, {1, 0, 0}), bonded());
  Particles &p = model.particles;
  p.position[row_of(p, 1)].x += 0.5 * radius;
  EXPECT_EQ(model.bonds->response(0, p).tension_ratio, 0);
  model.compute_forces(0);
  EXPECT_EQ(model.intact_bonds(), 1u);
}

TEST(describe, every_choice_of_a_contact_has_its_own_law) {
  std::set<std::string> words;
  for (const auto &[word, law] : NormalContacts::words()) {
    EXPECT_TRUE(words.insert(word).second);
    EXPECT_EQ(dem::word(law), word);
  }
  // A name that is not in the list is not taken for another law.
  EXPECT_THROW(dem::word(static_cast<NormalContact>(words.size())), std::logic_error);
  ContactSettings s;
  BondLayout layout;
  layout.modulus = 1e9;
  const double linear = s.coefficient(1e-3, 1e-3, layout);
  s.normal = NormalContact::hertz;
  EXPECT_NE(s.coefficient(1e-3, 1e-3, layout), linear);
}

} // namespace
} // namespace platen::dem::describe_test
