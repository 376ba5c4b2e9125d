#include "dem/heterogeneity.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/portable.h"
#include "base/random.h"
#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {
namespace {

// Makes strengths independent of the packing, which uses the same seed.
constexpr std::uint64_t stream = 0x5ca77e7ed57e9675ULL;

} // namespace

void mark_phases(Particles &p, const Phases &phases) {
  require_in_range(phases);
  std::vector<int> ids = phases.aggregate_ids;
  std::sort(ids.begin(), ids.end());
  if (!ids.empty() && (ids.front() < 0 || ids.back() >= static_cast<int>(p.size())))
    throw std::invalid_argument("phases: there is no particle " +
                                std::to_string(ids.front() < 0 ? ids.front() : ids.back()));
  p.phase = &p.table.add<int>("phase", "1", between(0, 1)); // Phase
  for (std::size_t i = 0; i < p.size(); ++i) {
    const bool aggregate =
        p.radius[i] > phases.radius_above || std::binary_search(ids.begin(), ids.end(), p.id[i]);
    (*p.phase)[i] = static_cast<int>(aggregate ? Phase::aggregate : Phase::matrix);
  }
}

int aggregates_of_pair(const Particles &p, int first, int second) {
  if (p.phase == nullptr) return 0;
  return (*p.phase)[first] + (*p.phase)[second];
}

void apply_phases(Bonds &bonds, const Particles &particles, const Phases &phases) {
  const std::array<PhaseFactors, 3> factors = phases.factors();
  if (phases.scatters()) bonds.add_strength_factor();
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    const PhaseFactors &f = factors[aggregates_of_pair(particles, bonds.first[k], bonds.second[k])];
    bonds.normal_stiffness[k] *= f.modulus;
    if (bonds.strength_factor != nullptr) (*bonds.strength_factor)[k] *= f.strength;
  }
}

std::vector<double> weibull_factors(std::size_t count, const StrengthScatter &scatter) {
  const double m = scatter.weibull_modulus;
  if (!(m > 0 && std::isfinite(m))) throw std::invalid_argument("the Weibull modulus must be positive");
  const double scale = 1 / portable::gamma(1 + 1 / m);
  Random random(scatter.seed ^ stream);
  std::vector<double> factors(count);
  for (double &s : factors) {
    const double survival = 1 - random.uniform(); // above 0; 1 once in 2^53, which gives no strength
    s = scale * portable::pow(-portable::log(survival), 1 / m);
    if (!(s > 0)) s = std::numeric_limits<double>::min();
  }
  return factors;
}

void scatter_strengths(Bonds &bonds, const StrengthScatter &scatter) {
  bonds.add_strength_factor();
  const std::vector<double> factors = weibull_factors(bonds.records.size(), scatter);
  for (std::size_t k = 0; k < bonds.size(); ++k)
    (*bonds.strength_factor)[k] *= factors[bonds.record[k]];
}

} // namespace platen::dem
