#include "apps/scene/readers.h"

#include <algorithm>
#include <vector>

namespace platen::apps {
namespace {

using Apps = std::vector<AppKind>;

const Apps all{AppKind::pack,      AppKind::bonds,     AppKind::bar,  AppKind::compress,
               AppKind::brazilian, AppKind::calibrate, AppKind::study};

Apps but(const Apps &apps, const Apps &not_these) {
  Apps left;
  std::copy_if(apps.begin(), apps.end(), std::back_inserter(left), [&](AppKind app) {
    return std::find(not_these.begin(), not_these.end(), app) == not_these.end();
  });
  return left;
}

struct Reader {
  std::string path; // of an entry, or of a section with all that is in it
  Apps apps;
};

// The longest path that holds an entry decides.
const std::vector<Reader> &readers() {
  using K = AppKind;
  const Apps packed = but(all, {K::bonds}), bonded = but(all, {K::pack}), crushing{K::compress, K::study},
             loading{K::compress, K::brazilian, K::calibrate, K::study},
             written{K::compress, K::brazilian, K::study}, in_cells{K::compress, K::calibrate, K::study};
  static const std::vector<Reader> table{{"Scene", all},
                                         {"Scene/Seed", packed},
                                         {"Scene/Quality", bonded},
                                         {"Specimen", packed},
                                         {"Specimen/Sphere radius", all},
                                         {"Specimen/Ends", but(packed, {K::bar})},
                                         {"Specimen/End layer", but(packed, {K::bar})},
                                         {"Specimen/Seat", loading},
                                         {"Specimen/Section", in_cells},
                                         {"Specimen/Cache", but(bonded, {K::bonds})},
                                         {"Material/Density", all},
                                         {"Material/Density of", packed},
                                         {"Material/Young modulus", bonded},
                                         {"Material/Poisson ratio", bonded},
                                         {"Effects", bonded},
                                         {"Effects/Bond", all}, // phases need it
                                         {"Effects/Energy ledger", but(bonded, {K::calibrate})},
                                         {"Effects/Crack log", written},
                                         {"Bond", bonded},
                                         {"Bond/Gap", but(bonded, {K::bonds})},
                                         {"Bond/Strength scatter", but(bonded, {K::bonds})},
                                         {"Bond/Weibull modulus", but(bonded, {K::bonds})},
                                         {"Bond/Calibrated radius", loading},
                                         {"Bond/Calibrated width", loading},
                                         {"Bond/Calibrated packing", but(bonded, {K::bonds})},
                                         {"Bond/Calibrated figures", written},
                                         {"Bond/Modulus exponent", loading},
                                         {"Bond/Strength exponent", loading},
                                         {"Phases", but(bonded, {K::bonds})},
                                         {"Phases/By", packed},
                                         {"Phases/Radius above", packed},
                                         {"Phases/File", packed},
                                         {"Contact", bonded},
                                         {"Platens", loading},
                                         {"Platens/Sides", crushing},
                                         {"Platens/Edge gap", crushing},
                                         {"Platens/Span", crushing},
                                         {"Platens/Left", crushing},
                                         {"Platens/Right", crushing},
                                         {"Platens/Front", crushing},
                                         {"Platens/Back", crushing},
                                         {"Platens/Top/Seat", crushing},
                                         {"Platens/Machine stiffness", written},
                                         {"Platens/Machine mass", written},
                                         {"Platens/Machine damping", written},
                                         {"Sleeve", in_cells},
                                         {"Loading", loading},
                                         {"Loading/Start strain", crushing},
                                         {"Loading/Wave crossings", crushing},
                                         {"Loading/Test", crushing},
                                         {"Loading/Wall stiffness", crushing},
                                         {"Loading/Pressure path", crushing},
                                         {"Loading/Confinement", in_cells},
                                         {"Loading/Confining pressure", in_cells},
                                         {"Loading/Confining ramp", in_cells},
                                         {"Loading/Confinement area", in_cells},
                                         {"Loading/Stage", crushing},
                                         {"Integration", bonded},
                                         {"Output", written},
                                         {"Output/Every", {K::compress, K::brazilian, K::study, K::bar}},
                                         {"Checkpoint", written},
                                         {"Expect", all},
                                         {"Pair test", {K::bonds}},
                                         {"Calibrate", {K::calibrate}},
                                         {"Bar test", {K::bar}},
                                         {"Study", {K::study}}};
  return table;
}

// "Loading/Stage" holds "Loading/Stage 3/Ramp" too.
bool holds(const std::string &part, const std::string &path) {
  if (path.rfind(part, 0) != 0) return false;
  const bool ends = path.size() == part.size() || path[part.size()] == '/';
  return ends || (part == "Loading/Stage" && path[part.size()] == ' ');
}

} // namespace

bool reads(AppKind app, const std::string &path) {
  const Reader *longest = nullptr;
  for (const Reader &one : readers())
    if (holds(one.path, path) && (longest == nullptr || one.path.size() > longest->path.size()))
      longest = &one;
  return longest != nullptr &&
         std::find(longest->apps.begin(), longest->apps.end(), app) != longest->apps.end();
}

} // namespace platen::apps
