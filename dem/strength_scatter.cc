#include "dem/strength_scatter.h"

#include <cmath>
#include <stdexcept>

#include "base/random.h"
#include "dem/bonds.h"

namespace platen::dem {
namespace {

// Keeps strengths apart from the packing, which draws from the same seed.
constexpr std::uint64_t stream = 0x5ca77e7ed57e9675ULL;

} // namespace

std::vector<double> weibull_factors(std::size_t count, const StrengthScatter &scatter) {
  const double m = scatter.weibull_modulus;
  if (!(m > 0 && std::isfinite(m))) throw std::invalid_argument("the Weibull modulus must be positive");
  const double scale = 1 / std::tgamma(1 + 1 / m);
  Random random(scatter.seed ^ stream);
  std::vector<double> factors(count);
  for (double &s : factors) {
    const double survival = 1 - random.uniform(); // above 0, and 1 once in 2^53: no strength at all
    s = scale * std::pow(-std::log(survival), 1 / m);
    if (!(s > 0)) s = std::numeric_limits<double>::min();
  }
  return factors;
}

void scatter_strengths(Bonds &bonds, const StrengthScatter &scatter) {
  bonds.add_strength_factor();
  const std::vector<double> factors = weibull_factors(bonds.records.size(), scatter);
  for (std::size_t k = 0; k < bonds.size(); ++k)
    (*bonds.strength_factor)[k] *= factors[static_cast<std::size_t>(bonds.record[k])];
}

} // namespace platen::dem
