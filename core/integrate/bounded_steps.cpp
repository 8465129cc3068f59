#include "core/integrate/bounded_steps.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constants.hpp"
#include "core/numerics/rough_powers.hpp"
#include "core/numerics/whole_power.hpp"

namespace qdot {
namespace {

/// Of a bounded step, times its length, in units of the tolerance. They are 1 to 100, as it happens: the
/// worst step of a reference has to be better than a lucky one of the run that it measures. Where bounds hold
/// its steps short, and not last terms, they may be so rough that the motion's own defect is as small as
/// that.
constexpr double allowed_defect = 100, allowed_of_reference = 10, allowed_where_held = 4;
constexpr int most_bounds = 120;           ///< tried for one step
constexpr double least_of_wanted = 1e-12;  ///< a step that much shorter is not bounded
constexpr double least_share = 0.5, grown_share = 1.03;

}  // namespace

bool find_hidden(double h, std::span<const double> series, unsigned order, std::span<const double> defect,
                 std::span<double> hidden) {
  const double power = whole_power(h, order - 2);
  bool hides = false;
  for (std::size_t i = 0; i < defect.size(); ++i) {
    const auto size = [&](unsigned k) { return std::abs(series[i * (order + 1) + k]); };
    const double last = power * std::max({size(order - 2), h * size(order - 1), h * h * size(order)});
    hidden[i] = hidden_behind(last, h * defect[i]);
    hides = hides || hidden[i] > 0;
  }
  return hides;
}

BoundedSteps::BoundedSteps(const RightHandSide& system, const RunRequest& request, std::size_t n,
                           unsigned order)
    : system_(system),
      request_(request),
      order_(order),
      allowed_(n),
      defect_(n),
      hidden_(n),
      off_so_far_(n) {}

BoundedSteps::Bound BoundedSteps::find(double t, double h, std::span<const double> series,
                                       std::span<const double> weights) {
  if (!system_.defect) return {h, false};
  bool is_held = share_ < 1;
  allow(is_held, weights);
  double good = h * share_, bad = infinity;
  share_ = std::min(1.0, grown_share * share_);
  for (int i = 0; i < most_bounds; ++i) {
    double ratio = excess(good);
    if (ratio <= 1) break;
    if (request_.is_reference && !is_held) {
      is_held = true;
      allow(is_held, weights);
      ratio *= allowed_of_reference / allowed_where_held;
    }
    bad = good;
    good = std::max(good / 2, 0.93 * good * rough_exp2(-rough_log2(std::min(ratio, 1e300)) / order_));
    if (good < least_of_wanted * h || t + good == t) return {h, false};
    share_ = std::max(least_share, good / h);
  }
  if (bad <= 4 * h && good <= h / 4) good = lengthened(good, bad);
  if (request_.is_reference) look_closely(good, series);
  if (request_.originals != nullptr && system_.rounding) {
    rounding_.resize(weights.size() / 2);
    system_.rounding(rounding_);
  }
  return {good, true};
}

void BoundedSteps::allow(bool is_held, std::span<const double> weights) {
  const double allowed = !request_.is_reference ? allowed_defect
                         : is_held              ? allowed_where_held
                                                : allowed_of_reference;
  for (std::size_t i = 0; i < weights.size(); ++i) allowed_[i] = allowed * weights[i];
}

/// Where the bound tells of something hidden it may be a rough one: then the one with the closest ranges is
/// taken, too, which mostly is less.
void BoundedSteps::look_closely(double h, std::span<const double> series) {
  hides_ = find_hidden(h, series);
  if (!hides_) return;
  const std::vector<double> rough = defect_;
  bound_closely(h);
  for (std::size_t i = 0; i < rough.size(); ++i) defect_[i] = std::min(defect_[i], rough[i]);
}

/// After much shortening: between a length that does and one that does not.
double BoundedSteps::lengthened(double good, double bad) {
  for (int i = 0; i < 2; ++i) {
    const double middle = (good + bad) / 2;
    (excess(middle) <= 1 ? good : bad) = middle;
  }
  (void)excess(good);
  return good;
}

/// It moves on with the velocities. What the step may be off by anyway is much less, and only summed.
void BoundedSteps::add_unseen(double h, std::span<const double> series) {
  const std::size_t n = defect_.size() / 2;
  off_before_ = off_so_far_;
  hidden_before_ = hidden_so_far_;
  const bool hides = hides_ && find_hidden(h, series);  // by the closest bound
  if (hides) hidden_so_far_.resize(defect_.size());
  for (std::size_t i = 0; i < hidden_so_far_.size(); ++i) hidden_so_far_[i] += hidden_[i];
  for (std::size_t i = 0; i < n && !hidden_so_far_.empty(); ++i) {
    hidden_so_far_[i] += h * hidden_so_far_[n + i];
  }
  unseen_.resize(defect_.size());
  for (std::size_t i = 0; i < unseen_.size(); ++i) {
    off_so_far_[i] += h * defect_[i];
    unseen_[i] = off_so_far_[i] + (hidden_so_far_.empty() ? 0 : hidden_so_far_[i]);
  }
}

void BoundedSteps::shorten(double h, std::span<const double> series) {
  bound_closely(h);
  if (!std::ranges::all_of(defect_, [](double d) { return std::isfinite(d); })) return;
  off_so_far_ = off_before_;
  hidden_so_far_ = hidden_before_;
  hides_ = find_hidden(h, series);
  add_unseen(h, series);
}

}  // namespace qdot
