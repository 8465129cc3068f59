#include "core/motion/resolved_size.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/compile/taylor/expansion.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr unsigned order_from_rest = 12;
constexpr double longest = 900;           ///< time, as an exponent of two, and shortest
constexpr double resolved_anyway = 1e-3;  ///< absolute tolerances are so much of relative ones

/// log2 of what coefficients grow by from order to order; minus infinity where there are not two.
double growth_at_rest(std::span<const double> series) {
  const auto is_usable = [&](std::size_t k) { return series[k] != 0 && std::isfinite(series[k]); };
  std::size_t later = series.size() - 1;
  while (later > 0 && !is_usable(later)) --later;
  std::size_t earlier = later / 2;
  while (earlier < later && !is_usable(earlier)) ++earlier;
  if (earlier == later) return -infinity;
  return (std::ilogb(series[later]) - std::ilogb(series[earlier])) / static_cast<double>(later - earlier);
}

double size_from_rest(const Dynamics& dynamics, const SimulationRequest& request) {
  const std::vector<double> y = request.y_start;
  std::vector<double> c(y.size() * (order_from_rest + 1));
  TaylorExpansion expansion(dynamics.accelerations(), request.parameters);
  if (expansion.expand(request.t_start, y, order_from_rest, c) != Evaluation::ok) return 0;
  const auto row = [&](std::size_t i) {
    return std::span(c).subspan(i * (order_from_rest + 1), order_from_rest + 1);
  };
  double fastest = -longest;
  for (std::size_t i = 0; i < y.size(); ++i) fastest = std::max(fastest, growth_at_rest(row(i)));
  const int exponent = static_cast<int>(std::min(fastest, longest));
  const double time = std::min(std::ldexp(1.0, -exponent), request.t_end - request.t_start);
  double largest = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    double power = 1;
    for (const double x : row(i)) {
      if (std::isfinite(x)) largest = std::max(largest, power * std::abs(x));
      power *= time;
    }
  }
  return largest;
}

}  // namespace

double small_size_from_rest(const Dynamics& dynamics, const SimulationRequest& request) {
  const bool is_at_rest = std::ranges::all_of(request.y_start, [](double x) { return x == 0; });
  if (!is_at_rest || dynamics.kinks() != nullptr) return infinity;
  const double size = size_from_rest(dynamics, request);
  return size > 0 && size < resolved_anyway ? std::max(size, least_size) : infinity;
}

}  // namespace qdot
