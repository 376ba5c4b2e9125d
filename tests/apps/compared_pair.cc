#include "apps/compared_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "apps/bonds/bond_rig.h"
#include "apps/bonds/load_path.h"
#include "apps/bonds/run_bonds.h"
#include "apps/programs.h"
#include "base/shortest_text.h"

namespace platen::apps::testing {
namespace {

// How much of a moment counts towards failure.
double beta_of(const dem::BondLaw &law) {
  if (const auto *yielding = std::get_if<dem::YieldingParallelBond>(&law))
    return yielding->parameters.moment_contribution;
  return std::get<dem::ElastoDamagePlastic>(law).parameters.moment_contribution;
}

// One of both closed forms, by the displacement that the path of a scene names.
class ClosedForm {
public:
  ClosedForm(const Scene &scene, const dem::Bonds &bonds)
      : test_(pair_test_of(scene)),
        radius_(scene.specimen.sphere_radius),
        section_(section_of(bonds)),
        forces_(section_, test_.path == PairPath::combined, test_.slip_ratio) {
    const MomentAxis axis = test_.path == PairPath::bending ? MomentAxis::across : MomentAxis::along;
    if (turns(scene))
      moment_.emplace(moment_section(section_, axis, beta_of(bonds.law), bonds.bond_radius[0]));
    if (slides()) closed_ = -section_.closing_at(test_.pressure);
    if (closed_ != 0) forces_.go({closed_, 0, 0});
  }
  // Displacements on the way there at which lines bend.
  std::vector<double> kinks(double to) const {
    std::vector<double> places = moment_ ? moment_->kinks(to / radius_) : forces_.kinks(place(to));
    for (double &share : places)
      share = at_ + share * (to - at_);
    return places;
  }
  void go(double to) {
    moment_ ? moment_->go(to / radius_) : forces_.go(place(to));
    at_ = to;
  }
  ComparedRun::ByHand now() const {
    if (moment_) return {{0, 0, moment_->moment()}, moment_->dissipated()};
    return {forces_.load(), forces_.dissipated()};
  }
  double length() const { return section_.length; }

private:
  bool slides() const { return test_.path == PairPath::shear; }
  CohesivePlace place(double displacement) const {
    if (slides()) return {closed_, displacement, 0};
    return {displacement, test_.path == PairPath::combined ? test_.slip_ratio * displacement : 0, 0};
  }

  const PairTest &test_;
  double radius_, closed_ = 0; // m, of a sphere; opening under pressure
  CohesiveSection section_;
  CohesiveByHand forces_;
  std::optional<MomentByHand> moment_;
  double at_ = 0;
};

} // namespace

ComparedRun compared_run(const std::string &scene_file, std::vector<std::string> overrides) {
  const auto read = [&] {
    return read_scene(std::string(PLATEN_SCENES) + "/" + scene_file, overrides, program("bonds"));
  };
  const Scene scene = read();
  const dem::Model model(touching_spheres(scene), pair_settings(scene));
  ClosedForm ahead(scene, *model.bonds), beside = ahead;
  std::string places;
  double last = 0;
  const auto add = [&](double place) {
    if (place == last) return;
    places += (places.empty() ? "" : ", ") + shortest_text(place);
    last = place;
  };
  for (const double turn : turning_displacements(pair_test_of(scene))) {
    for (const double kink : ahead.kinks(turn))
      add(kink);
    add(turn);
    ahead.go(turn);
  }
  overrides.insert(overrides.end(), {"Pair test/Displacement =", "Pair test/Turns = " + places});
  ComparedRun run{run_bond_tests(read()).at(0), {}, beside.length()};
  for (const BondReading &row : run.rows) {
    beside.go(turns(scene) ? row.rotation * scene.specimen.sphere_radius : row.displacement);
    run.by_hand.push_back(beside.now());
  }
  return run;
}

double ComparedRun::largest_difference() const {
  double scale = 0, off = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const CohesiveLoad &hand = by_hand[k].load;
    const std::array<double, 3> loads{length * hand.normal, length * hand.shear, hand.moment},
        measured{length * rows[k].normal, length * rows[k].shear, rows[k].moment};
    for (std::size_t c = 0; c < loads.size(); ++c) {
      scale = std::max(scale, std::abs(loads[c]));
      off = std::max(off, std::abs(measured[c] - loads[c]));
    }
  }
  return off / scale;
}

} // namespace platen::apps::testing
