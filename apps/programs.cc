#include "apps/programs.h"

#include <stdexcept>

#include "apps/bar/bar_section.h"
#include "apps/bonds/pair_section.h"
#include "apps/calibrate/calibrate_section.h"
#include "apps/study/study_section.h"

namespace platen::apps {
namespace {

using Paths = std::vector<std::string>;

Paths shared() {
  return {"Scene",   "Specimen", "Material", "Effects",     "Bond",   "Phases",     "Contact",
          "Platens", "Sleeve",   "Loading",  "Integration", "Output", "Checkpoint", "Expect"};
}

Paths joined_lists(std::initializer_list<Paths> lists) {
  Paths all;
  for (const Paths &one : lists)
    all.insert(all.end(), one.begin(), one.end());
  return all;
}

// Of tests that are told whole: not of discs, nor of trials.
Paths of_whole_tests() {
  return {"Platens/Sides",         "Platens/Edge gap",       "Platens/Span",         "Platens/Left",
          "Platens/Right",         "Platens/Front",          "Platens/Back",         "Platens/Top/Seat",
          "Loading/Start strain",  "Loading/Wave crossings", "Loading/Test",         "Loading/Wall stiffness",
          "Loading/Pressure path", "Loading/Stage",          "Specimen/Notch depth", "Specimen/Notch width"};
}
Paths of_cells() {
  return {"Specimen/Section",       "Sleeve",
          "Loading/Confinement",    "Loading/Confining pressure",
          "Loading/Confining ramp", "Loading/Confinement area"};
}
Paths of_platens() {
  return {"Scene/Standard",
          "Specimen/Seat",
          "Specimen/Section",
          "Specimen/Notch depth",
          "Specimen/Notch width",
          "Bond/Calibrated radius",
          "Bond/Calibrated width",
          "Bond/Modulus exponent",
          "Bond/Strength exponent",
          "Platens",
          "Sleeve",
          "Loading"};
}
Paths of_runs() {
  return {"Effects/Crack log", "Bond/Calibrated figures", "Output", "Checkpoint"};
}

Program pack() {
  Program p;
  p.name = "platen-pack";
  p.purpose = "Packs spheres into a specimen and judges the packing.";
  p.bonds = false;
  p.reads = {"Scene",        "Specimen",  "Material/Density",    "Material/Density of",
             "Effects/Bond", "Phases/By", "Phases/Radius above", "Phases/File",
             "Expect"};
  p.but = {"Scene/Quality",        "Scene/Standard",     "Specimen/Seat",
           "Specimen/Section",     "Specimen/Cache",     "Specimen/Notch depth",
           "Specimen/Notch width", "Specimen/Bond file", "Specimen/Flaw"};
  return p;
}

Program bonds() {
  Program p = pair_program();
  p.packs = false;
  p.reads = {"Scene", "Specimen/Sphere radius", "Material", "Effects", "Bond", "Contact", "Integration",
             "Expect"};
  p.but = joined_lists({{"Scene/Seed", "Material/Density of", "Bond/Gap", "Bond/Strength scatter",
                         "Bond/Weibull modulus", "Bond/Calibrated packing"},
                        of_platens(),
                        of_runs()});
  return p;
}

Program bar() {
  Program p = bar_program();
  p.caches_packings = true;
  p.reads = joined_lists({shared(), {"Output/Every"}});
  p.but = joined_lists({{"Specimen/Ends", "Specimen/End layer", "Specimen/Export"}, of_platens(), of_runs()});
  return p;
}

Program compress() {
  Program p;
  p.name = "platen-compress";
  p.purpose = "Crushes, pulls by glued ends or bends a specimen of bonded spheres between two platens.";
  p.presses = Presses::specimens;
  p.shares_packings = p.caches_packings = p.on_ranks = true;
  p.reads = shared();
  p.but = {"Specimen/Export"};
  return p;
}

Program brazilian() {
  Program p;
  p.name = "platen-brazilian";
  p.purpose = "Splits a disc of bonded spheres along its diameter between two flat platens or strips.";
  p.presses = Presses::discs;
  p.shares_packings = p.caches_packings = p.on_ranks = true;
  p.reads = shared();
  p.but = joined_lists({{"Specimen/Export"}, of_whole_tests(), of_cells()});
  return p;
}

Program calibrate() {
  Program p = calibrate_program();
  p.presses = Presses::trials;
  p.caches_packings = true;
  p.reads = shared();
  p.but = joined_lists({{"Specimen/Export", "Scene/Standard", "Effects/Energy ledger",
                         "Platens/Machine stiffness", "Platens/Machine mass", "Platens/Machine damping"},
                        of_whole_tests(),
                        of_runs()});
  return p;
}

Program study() {
  Program p = study_program();
  p.presses = Presses::specimens;
  p.caches_packings = p.plans_runs = true;
  p.reads = shared();
  p.but = {"Specimen/Export"};
  return p;
}

} // namespace

const std::vector<Program> &programs() {
  static const std::vector<Program> all = [] {
    std::vector<Program> list{pack(), bonds(), bar(), compress(), brazilian(), calibrate(), study()};
    for (Program &one : list)
      for (const Program &other : list)
        if (!other.section.empty() && other.section != one.section) one.foreign.push_back(other.section);
    return list;
  }();
  return all;
}

const Program &program(const std::string &word) {
  for (const Program &one : programs())
    if (one.name == word || one.name == "platen-" + word) return one;
  throw std::out_of_range("no program " + word);
}

} // namespace platen::apps
