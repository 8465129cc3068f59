#include "core/integrate/step_length.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constants.hpp"
#include "core/numerics/pairs.hpp"
#include "core/numerics/rough_powers.hpp"

namespace qdot {
namespace {

/// log2 of (w / |c|)^(1/k); infinite for c = 0.
double log2_of_root(double w, double c, unsigned k) {
  if (c == 0) return infinity;
  return (rough_log2(w) - rough_log2(std::abs(c))) / k;
}

bool is_finite(std::span<const double> series, unsigned order, unsigned k) {
  for (std::size_t i = k; i < series.size(); i += order + 1) {
    if (!std::isfinite(series[i])) return false;
  }
  return true;
}

/// The largest |c_k| / w_i over the components, for k and k + 1.
PairOfDoubles largest_shares(std::span<const double> series, unsigned order, std::span<const double> weights,
                             unsigned k) {
  PairOfDoubles largest{};
  const double* c = series.data() + k;
  for (std::size_t i = 0; i < weights.size(); ++i, c += order + 1)
    largest = larger_or(magnitudes(pair_at(c)) / PairOfDoubles{weights[i], weights[i]}, largest);
  return largest;
}

/// log2 of the least over the components of (w / |c_k|)^(1/k). One root, of the largest |c_k| / w, where
/// that is a number.
double log2_of_length(std::span<const double> series, unsigned order, std::span<const double> weights,
                      unsigned k, double largest) {
  if (std::isfinite(largest)) return largest > 0 ? -rough_log2(largest) / k : infinity;
  const auto c = [&](std::size_t i) { return series[i * (order + 1) + k]; };
  double least = infinity;
  for (std::size_t i = 0; i < weights.size(); ++i) least = std::min(least, log2_of_root(weights[i], c(i), k));
  return least;
}

}  // namespace

double step_length(std::span<const double> series, unsigned order, std::span<const double> weights) {
  unsigned last = order;
  while (last > 1 && !is_finite(series, order, last)) --last;
  const PairOfDoubles largest = largest_shares(series, order, weights, last - 1);
  double exponent = log2_of_length(series, order, weights, last, largest[1]);
  if (last > 2) exponent = std::min(exponent, log2_of_length(series, order, weights, last - 1, largest[0]));
  return std::isfinite(exponent) ? rough_exp2(exponent) : exponent;
}

}  // namespace qdot
