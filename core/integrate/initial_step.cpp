#include "core/integrate/initial_step.hpp"

#include <sleef.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace qdot {
namespace {

struct ErrorNorm {
  std::span<const double> y;
  Tolerances tolerances;

  double operator()(std::span<const double> v) const {
    double norm = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
      norm = std::max(norm, std::abs(v[i]) / (tolerances.atol + tolerances.rtol * std::abs(y[i])));
    return norm;
  }
};

/// |y''| by a forward difference over h, which shrinks while f has no value there;
/// empty when it never has one.
std::optional<double> second_derivative(Evaluator& evaluator, double t, std::span<const double> f, double& h,
                                        const ErrorNorm& norm) {
  constexpr int tries = 20;
  std::vector<double> moved(f.size());
  std::vector<double> change(f.size());
  for (int i = 0; i < tries; ++i, h *= 0.1) {
    for (std::size_t k = 0; k < f.size(); ++k) moved[k] = norm.y[k] + h * f[k];
    const Answer answer = evaluator.derivative(t + h, moved, change);
    if (answer == answer_stop) return std::nullopt;
    if (answer == answer_retry) continue;
    for (std::size_t k = 0; k < f.size(); ++k) change[k] -= f[k];
    return norm(change) / h;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> initial_step(Evaluator& evaluator, double t, std::span<const double> y, double t_end,
                                   const Tolerances& tolerances, int order) {
  const double span = t_end - t;
  const double shortest = std::min(span, 16 * std::numeric_limits<double>::epsilon() * std::abs(t));
  const ErrorNorm norm{y, tolerances};

  std::vector<double> f(y.size());
  if (evaluator.derivative(t, y, f) != answer_ok) return std::nullopt;
  const double d0 = norm(y);
  const double d1 = norm(f);
  const bool at_rest = d0 < 1e-5 || d1 < 1e-5;
  double h0 = std::clamp(at_rest ? 1e-6 * span : 0.01 * (d0 / d1), shortest, span);

  const auto d2 = second_derivative(evaluator, t, f, h0, norm);
  if (!d2) return std::nullopt;
  const double d = std::max(d1, *d2);
  const double h1 = d < 1e-15 ? 100 * h0 : Sleef_cinz_powd1_u10purec(0.01 / d, 1.0 / (order + 1));
  // A sub-ulp or vanishing proposal (overflow above) falls back to the explicit Euler step.
  const double h = std::min(100 * h0, h1 > 0 ? h1 : h0);
  return std::clamp(h, shortest, span);
}

}  // namespace qdot
