#include "core/integrate/shown_scale.hpp"

#include <cmath>

namespace qdot {
namespace {

constexpr double tried_apart = 256;
constexpr double farther = 2.59375;  ///< not a whole number: whole last digits may be whole times as many
constexpr double nearly = 0x1p-10;

bool is_linear(double here, double near, double far) {
  const double rise = far - here;
  return rise != 0 && std::abs(rise - farther * (near - here)) <= nearly * std::abs(rise);
}

}  // namespace

double ShownScale::find(double t, std::span<const double> y, std::span<const double> e, double least,
                        double most) {
  if (least * tried_apart > most || !take_accelerations(t, y, e, 0, here_)) return least;
  double best = least;
  std::size_t most_shown = 0;
  for (double factor = least; factor <= most && most_shown < here_.size(); factor *= tried_apart) {
    const std::size_t now = shown(t, y, e, factor);
    if (now > most_shown) best = factor;
    most_shown = std::max(most_shown, now);
  }
  return best;
}

/// How many accelerations.
std::size_t ShownScale::shown(double t, std::span<const double> y, std::span<const double> e, double factor) {
  if (!take_accelerations(t, y, e, factor, near_) || !take_accelerations(t, y, e, farther * factor, far_))
    return 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < here_.size(); ++i) count += is_linear(here_[i], near_[i], far_[i]) ? 1 : 0;
  return count;
}

bool ShownScale::take_accelerations(double t, std::span<const double> y, std::span<const double> e,
                                    double factor, std::vector<double>& a) {
  const std::size_t n = y.size() / 2;
  beside_.resize(y.size());
  c_.resize(2 * y.size());
  for (std::size_t i = 0; i < y.size(); ++i) beside_[i] = y[i] - factor * e[i];
  if (system_.expansion(t, beside_, 1, c_) != Evaluation::ok) return false;
  a.resize(n);
  for (std::size_t i = 0; i < n; ++i) a[i] = c_[2 * (n + i) + 1];
  return true;
}

}  // namespace qdot
