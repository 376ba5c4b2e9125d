// Bonds that somebody names, and flaws: who is bonded, how strong, and how stiff a lattice with a cut is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "dem/equilibrium.h"
#include "tests/dem/examples.h"

namespace platen::dem::bond_choice_test {
namespace {

using namespace examples;
using Form = Flaw::Form;

constexpr int across = 4, along = 8;

// Ids along z of the lattice: across * across * level + place.
std::vector<GivenBond> columns() {
  std::vector<GivenBond> bonds;
  for (int k = 0; k < across * across * (along - 1); ++k)
    bonds.push_back({k + across * across, k});
  return bonds;
}

Flaw flat(Form form, double z) {
  Flaw flaw;
  flaw.form = form;
  flaw.centre = {0, 0, z};
  return flaw;
}

ModelSettings with_flaw(const Flaw &flaw) {
  ModelSettings settings = bonded();
  settings.bond_choice.flaws = {flaw};
  return settings;
}

std::size_t cut_by(const Flaw &flaw, const Specimen &lattice) {
  const Model whole(lattice, bonded()), cut(lattice, with_flaw(flaw));
  EXPECT_EQ(cut.bonds->in_flaw.at(0), whole.bonds->size() - cut.bonds->size());
  EXPECT_EQ(cut.bonds->strength_factor, nullptr);
  return cut.bonds->in_flaw.at(0);
}

TEST(bond_choice, given_pairs_are_all_the_bonds_whatever_their_distance) {
  const Specimen apart = cubic(3, 3, 3, 2.9); // no pair is in reach
  EXPECT_EQ(Model(apart, bonded()).bonds->size(), 0u);
  ModelSettings settings = bonded();
  settings.bond_choice.given = {{26, 25, 0.5}, {0, 1}, {4, 13, 3}};
  const Model model(apart, settings);
  const Bonds &bonds = *model.bonds;
  ASSERT_EQ(bonds.size(), 3u);
  ASSERT_NE(bonds.strength_factor, nullptr);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(bonds.first[k], bonds.second[k]);
    if (k > 0) {
      EXPECT_LE(bonds.first[k - 1], bonds.first[k]);
    }
    const int sum = model.particles.id[bonds.first[k]] + model.particles.id[bonds.second[k]];
    EXPECT_EQ((*bonds.strength_factor)[k], sum == 51 ? 0.5 : sum == 1 ? 1.0 : 3.0) << sum;
    EXPECT_NEAR(bonds.rest_length[k], 2.9 * radius, 1e-15);
  }
  const std::vector<std::vector<GivenBond>> wrong{{{0, 27}}, {{-1, 3}}, {{2, 2}}, {{0, 1}, {1, 0}}};
  for (const std::vector<GivenBond> &given : wrong) {
    settings.bond_choice.given = given;
    EXPECT_THROW(Model(apart, settings), std::invalid_argument);
  }
}

TEST(bond_choice, all_pairs_in_reach_by_name_are_the_same_bonds_to_the_bit) {
  const Specimen specimen = packed_box(12, 12, 12);
  const Model near(specimen, bonded());
  ModelSettings settings = bonded();
  settings.bond_choice.given.emplace();
  const auto &id = near.particles.id;
  for (std::size_t k = 0; k < near.bonds->size(); ++k)
    settings.bond_choice.given->push_back({id[near.bonds->second[k]], id[near.bonds->first[k]]});
  std::shuffle(settings.bond_choice.given->begin(), settings.bond_choice.given->end(), std::mt19937(3));
  const Model named(specimen, settings);
  ASSERT_EQ(named.bonds->size(), near.bonds->size());
  EXPECT_EQ(named.bonds->strength_factor, nullptr);
  for (std::size_t k = 0; k < near.bonds->size(); ++k) {
    EXPECT_EQ(named.bonds->first[k], near.bonds->first[k]);
    EXPECT_EQ(named.bonds->second[k], near.bonds->second[k]);
    EXPECT_EQ(named.bonds->normal_stiffness[k], near.bonds->normal_stiffness[k]);
    EXPECT_EQ(named.bonds->rest_length[k], near.bonds->rest_length[k]);
  }
}

// Bonds of a lattice through a flat flaw are upright ones; their places are known.
TEST(bond_choice, a_flaw_cuts_the_bonds_within_it_and_no_others) {
  const Specimen lattice = cubic(6, 6, 6);
  const double cell = 2 * radius, middle = 6 * radius;
  EXPECT_EQ(cut_by(flat(Form::plane, middle), lattice), 36u);
  EXPECT_EQ(cut_by(flat(Form::plane, 13 * radius), lattice), 0u);
  Flaw disc = flat(Form::disc, middle); // centres are at odd radii from the axis
  for (const auto &[size, count] : {std::pair(1.3, 0u), {1.5, 4u}, {3.3, 12u}, {4.3, 16u}, {5.2, 24u}}) {
    disc.radius = size * radius;
    EXPECT_EQ(cut_by(disc, lattice), count) << size;
  }
  // From the side the middle plane is that of another disc.
  disc.radius = 1.5 * radius, disc.normal = {1, 0, 0}, disc.centre = {2 * radius, 0, middle};
  EXPECT_EQ(cut_by(disc, lattice), 4u);
  Flaw flat_sheet = flat(Form::rectangle, middle);
  flat_sheet.width = 4.5 * cell, flat_sheet.breadth = 2.5 * cell; // x, y
  EXPECT_EQ(cut_by(flat_sheet, lattice), 4u * 2);
  flat_sheet.centre.x = -2 * cell; // half out
  EXPECT_EQ(cut_by(flat_sheet, lattice), 3u * 2);
  Flaw upright = flat(Form::rectangle, middle); // its horizontal is y
  upright.normal = {-1, 0, 0}, upright.width = 4.5 * cell, upright.breadth = 2.5 * cell;
  EXPECT_EQ(cut_by(upright, lattice), 4u * 2);
  upright.centre.z = middle + 3 * cell;
  EXPECT_EQ(cut_by(upright, lattice), 4u * 2 - 4);
  upright.centre = {0, 2 * cell, middle};
  EXPECT_EQ(cut_by(upright, lattice), 3u * 2);
  // Through each of the 6 levels pass 5 bonds along x and 5 along y.
  Flaw slanted = flat(Form::plane, middle);
  slanted.normal = {std::sqrt(.5), std::sqrt(.5), 0}, slanted.centre = {0.1 * radius, 0, 0};
  EXPECT_EQ(cut_by(slanted, lattice), 6u * 10);
  // Of these, 4 within 2 radii of the middle, on 2 levels.
  slanted.form = Form::rectangle, slanted.width = 4 * radius, slanted.breadth = 5 * radius;
  slanted.centre.z = middle;
  EXPECT_EQ(cut_by(slanted, lattice), 2u * 4);
}

TEST(bond_choice, factors_of_flaws_and_given_bonds_multiply) {
  ModelSettings settings = bonded();
  settings.bond_choice.given = columns();
  for (GivenBond &bond : *settings.bond_choice.given)
    bond.strength_factor = 0.7;
  Flaw plane = flat(Form::plane, along * radius), disc = flat(Form::disc, along * radius);
  plane.strength_factor = 0.5, disc.strength_factor = 3, disc.radius = 1.5 * radius;
  settings.bond_choice.flaws = {plane, disc};
  const Model model(cubic(across, across, along), settings);
  const Bonds &bonds = *model.bonds;
  EXPECT_EQ(bonds.size(), columns().size());
  EXPECT_EQ(bonds.in_flaw, (std::vector<std::size_t>{16, 4}));
  ASSERT_NE(bonds.strength_factor, nullptr);
  const auto &factor = *bonds.strength_factor;
  const auto with = [&](double value) {
    return std::count_if(factor.begin(), factor.end(),
                         [=](double f) { return std::abs(f / value - 1) < 1e-12; });
  };
  EXPECT_EQ(with(0.7 * 0.5 * 3), 4);
  EXPECT_EQ(with(0.7 * 0.5), 12);
  EXPECT_EQ(with(0.7), static_cast<long>(columns().size()) - 16);
}

// Columns of along - 1 springs in series, side by side: a cut through half of them takes half of the
// stiffness, and a weak plane nothing. To the tolerance of the solve.
TEST(bond_choice, half_of_a_lattice_cut_has_half_of_its_stiffness) {
  Flaw half = flat(Form::rectangle, along * radius);
  half.centre.x = -across * radius; // reaches to the middle, x = 0
  half.width = 2 * across * radius, half.breadth = 3 * across * radius;
  const auto force_over_spring = [&](double strength_factor) {
    ModelSettings settings = bonded();
    settings.bond_choice.given = columns();
    half.strength_factor = strength_factor;
    settings.bond_choice.flaws = {half};
    const Model model(cubic(across, across, along), settings);
    const Particles &p = model.particles;
    const double moved = 1e-6 * radius;
    StaticCase load;
    const auto level = [&](int row) { return p.id[row] / (across * across); };
    for (int i = 0; i < static_cast<int>(p.size()); ++i)
      if (level(i) == 0 || level(i) == along - 1)
        load.prescribed.push_back({i, {0, 0, level(i) == 0 ? 0 : moved}, {}});
    const StaticState state = solve_static(p, *model.bonds, load, {1e-12, 20000});
    double stretched = 0; // m, of all springs below the top
    for (std::size_t k = 0; k < model.bonds->size(); ++k) {
      const int i = model.bonds->first[k], j = model.bonds->second[k];
      if (level(i) + level(j) == 2 * along - 3)
        stretched += std::abs(state.displacement[static_cast<std::size_t>(i)].z -
                              state.displacement[static_cast<std::size_t>(j)].z);
    }
    return stretched / moved;
  };
  const double whole = 1.0 * across * across / (along - 1);
  EXPECT_NEAR(force_over_spring(0) / (0.5 * whole), 1, 1e-9);
  EXPECT_NEAR(force_over_spring(0.3) / whole, 1, 1e-9);
}

} // namespace
} // namespace platen::dem::bond_choice_test
