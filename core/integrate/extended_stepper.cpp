#include "core/integrate/extended_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/work.hpp"
#include "core/integrate/bounded_steps.hpp"
#include "core/integrate/evaluator.hpp"
#include "core/numerics/function.hpp"

namespace qdot {
namespace {

constexpr int attempts_at_a_step = 60;  ///< each half as long
constexpr double largest_end_defect =
    1e3;                                 ///< of the equation at the end of a step, in units of the tolerance
constexpr double allowed_to_hide = 100;  ///< times the step's length, in units of the tolerance
constexpr double rounding_of_doubles = 0x1p-52;
constexpr double rounding_of_states = 0x1p-105;  ///< of double-doubles, where they are typed and summed
constexpr double small = 0.005;  ///< in the largest term: so little of what a motion in doubles lost is lost
constexpr int most_shortenings =
    9;  ///< to an eighth: where low coefficients are zero no step is short enough
constexpr double shortening = 0.8;
constexpr double fast_fall = 0.1;  ///< by half the length
/// A coefficient beyond it is multiplied by a power of the step next to where doubles end.
constexpr double largest_coefficient = 1e250;
constexpr unsigned lowest_order = 12;
constexpr double infinity_of_steps = std::numeric_limits<double>::infinity();

}  // namespace

ExtendedStepper::ExtendedStepper(const ExtendedSystem& system, const ExtendedRunRequest& request)
    : system_(system),
      request_(request),
      order_(request.order),
      t_previous_(request.t_start),
      t_(request.t_start),
      y_(request.y_start),
      attempt_(y_.size()),
      slopes_(y_.size()),
      coefficients_{std::vector<DoubleDouble>(y_.size() * (order_ + 1)), order_},
      next_(coefficients_),
      beyond_(coefficients_),
      place_(y_.size()),
      allowed_(y_.size()),
      defect_(y_.size()),
      hidden_(y_.size()),
      bounded_(static_cast<bool>(system.hidden)) {
  if (system.in_doubles.expansion && system.first_in_doubles < order_)
    rounded_series_.emplace(system.in_doubles, system.first_in_doubles);
}

std::optional<Ending> ExtendedStepper::step() {
  trouble_.reset();
  if (steps_ == 0) {
    if (const auto spent = spent_limit()) return spent;
    if (const auto failed = expand(t_, y_, order_, next_)) return failed;
  }
  const DoubleDouble left = request_.t_end - t_;
  const bool rounding_is_followed = static_cast<bool>(system_.in_doubles.expansion);
  if (!rounding_is_followed) in_double_doubles_.clear();
  double h = step_size();
  if (bounded_) {
    const double whole = std::min(h, left.high);
    double part = bounded_part(whole);
    bounded_ = part > 0;
    if (part > 0) find_hidden(part);
    if (part > 0 && rounding_is_followed) {
      part = exact_part(part);
      const double told = told_part(part);
      bounded_ = !system_.rounding || shows_forces();
      if (rounded_series_ && bounded_ && !rounded_series_->tells(part)) return Ending::undetermined;
      part = told;
    }
    if (part > 0 && part < whole) h = part;
  }
  for (int i = 0; i < attempts_at_a_step; ++i, h = std::min(h, left.high) / 2) {
    const DoubleDouble t = h < left.high ? t_ + DoubleDouble(h) : request_.t_end;
    if (!is_before(t_, t)) break;
    if (const auto spent = spent_limit()) return spent;
    if (try_step(t)) return std::nullopt;
    const bool may_be_rounding = i == 0 && bounded_ && !rounding_is_followed;
    if (may_be_rounding && bound_rounding() && try_step(t)) return std::nullopt;
  }
  if (trouble_) return trouble_;
  return std::isnan(h) ? Ending::nonfinite : Ending::blow_up;
}

void ExtendedStepper::interpolate(const DoubleDouble& t, std::span<DoubleDouble> y_out) const {
  if (t.high == t_.high && t.low == t_.low) {
    std::ranges::copy(y_, y_out.begin());
    return;
  }
  sum_rows(rows_of(coefficients_), ExtendedSum::value, t - t_previous_, y_out);
  for (std::size_t i = 0; i < y_.size(); ++i) y_out[i] = row(coefficients_, i)[0] + y_out[i];
}

MotionPiece ExtendedStepper::polynomials() {
  const unsigned order = std::min(coefficients_.order, system_.highest_in_doubles);
  rows_.resize(y_.size() * (order + 1));
  double* to = rows_.data();
  for (std::size_t i = 0; i < y_.size(); ++i) {
    const DoubleDouble* c = row(coefficients_, i).data();
    for (unsigned k = 0; k <= order; ++k) *to++ = c[k].high;
  }
  return {t_previous_.high, last_step_, rows_, order, {}, {}};
}

std::span<const double> ExtendedStepper::truncated() {
  truncated_.resize(y_.size());
  take_powers(last_step_);
  for (std::size_t i = 0; i < y_.size(); ++i) {
    const auto c = row(coefficients_, i);
    const auto term = [&](std::size_t k) { return powers_[k] * std::abs(c[k].high); };
    truncated_[i] = 2 * std::max(term(coefficients_.order), term(coefficients_.order - 1));
  }
  return truncated_;
}

std::span<const double> ExtendedStepper::rounded() {
  const std::size_t n = y_.size() / 2;
  rounded_.resize(y_.size());
  take_powers(last_step_);
  for (std::size_t i = 0; i < n; ++i) {
    const auto c = row(coefficients_, i);
    const auto [first, others] = largest_terms(c);
    const double share = others <= first ? others / std::max(first, std::numeric_limits<double>::min()) : 1;
    rounded_[i] = share * rounding_of_doubles * std::abs(c[0].high);
    if (rounded_series_) rounded_[i] = std::max(rounded_[i], rounded_series_->off(i, last_step_));
    rounded_[n + i] = rounded_[i] * system_.first_in_doubles / last_step_;
    if (in_doubles_.empty()) continue;
    const double most_of_share =
        2 * coefficients_.order * others / last_step_;  // all that it moves the velocity by
    const double of_share = share > small ? std::min(share * in_doubles_[i] * last_step_, most_of_share) : 0;
    const double of_velocity = in_double_doubles_[i] * last_step_ + of_share;
    rounded_[n + i] += of_velocity;
    rounded_[i] += of_velocity * last_step_ / 2;
  }
  for (std::size_t i = 0; i < y_.size(); ++i)
    rounded_[i] += rounding_of_states * std::abs(row(coefficients_, i)[0].high);
  return rounded_;
}

std::optional<Ending> ExtendedStepper::spent_limit() const {
  const Limits& limits = request_.limits;
  if (steps_ >= limits.max_steps || evaluations_ + order_ > limits.max_evaluations) return Ending::step_limit;
  check_interruption();
  return std::nullopt;
}

std::optional<Ending> ExtendedStepper::unusable_state(std::span<const DoubleDouble> y) const {
  std::optional<Ending> wrong;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (std::isnan(y[i].high) || std::isnan(y[i].low)) return Ending::nonfinite;
    if (std::abs(y[i].high) > unit_of(i) * request_.limits.max_magnitude) wrong = Ending::blow_up;
  }
  return wrong;
}

std::optional<Ending> ExtendedStepper::expand(const DoubleDouble& t, std::span<const DoubleDouble> y,
                                              unsigned order, Series& series) {
  if (const auto wrong = unusable_state(y)) return trouble_ = wrong;
  for (series.order = order;; series.order = series.order * 3 / 4) {
    evaluations_ += series.order;
    const auto c = std::span(series.c).first(y.size() * (series.order + 1));
    if (const auto trouble = trouble_of(system_.expansion(t, y, series.order, c))) return trouble_ = trouble;
    if (series.order * 3 / 4 < lowest_order || is_in_range(series)) return std::nullopt;
  }
}

/// Beside what is narrow coefficients grow by its width at each order, up to where doubles end.
bool ExtendedStepper::is_in_range(const Series& series) const {
  for (std::size_t i = 0; i < y_.size(); ++i) {
    if (!(std::abs(row(series, i)[series.order].high) <= largest_coefficient)) return false;
  }
  return true;
}

double ExtendedStepper::weight(std::size_t i) const {
  const double reach = std::abs(y_[i].high) + last_step_ * std::abs(row(next_, i)[1].high);
  return unit_of(i) * request_.tolerances.atol + request_.tolerances.rtol * reach;
}

/// By the last two coefficients that are finite in all components, and by what the first coefficients in
/// doubles round away: where a series converges everywhere, steps are so long that these count.
double ExtendedStepper::step_size() {
  const auto all_finite = [&](unsigned k) {
    for (std::size_t i = 0; i < y_.size(); ++i) {
      if (!is_finite(row(next_, i)[k])) return false;
    }
    return true;
  };
  unsigned highest = next_.order;
  while (highest > 1 && !all_finite(highest)) --highest;
  double exponent = log_of_step_by(highest);
  if (highest > 2) exponent = std::min(exponent, log_of_step_by(highest - 1));
  for (unsigned k = system_.first_in_doubles; k < highest && k < system_.first_in_doubles + 2; ++k) {
    exponent = std::min(exponent, log_of_step_by(k, rounding_of_doubles));
  }
  if (!std::isfinite(exponent)) return exponent;
  double h = evaluate(Function::exp, exponent);
  for (int i = 0; i < most_shortenings && !doubles_are_small(h); ++i) h *= shortening;
  return h;
}

/// Whether no coefficient in doubles counts beside those that are none: where these are what two large
/// numbers left of each other, such as sin near pi, they have lost as much as all of a motion in doubles has.
bool ExtendedStepper::doubles_are_small(double h) {
  take_powers(h);
  for (std::size_t i = 0; i < y_.size(); ++i) {
    const Terms terms = largest_terms(row(next_, i));
    if (terms.in_doubles > small * terms.first) return false;
  }
  return true;
}

/// powers_: h^k, each the one before times h.
void ExtendedStepper::take_powers(double h) {
  double power = 1;
  for (double& x : powers_) {
    x = power;
    power *= h;
  }
}

/// |c_k| h^k, k >= 1, of the coefficients in double-doubles and of those in doubles.
ExtendedStepper::Terms ExtendedStepper::largest_terms(std::span<const DoubleDouble> c) const {
  const unsigned end = static_cast<unsigned>(c.size());
  const unsigned first_in_doubles = std::min(system_.first_in_doubles, end);
  const auto largest_between = [&](unsigned k, unsigned to) {
    double largest = 0;
    for (; k < to; ++k) {
      const double term = powers_[k] * std::abs(c[k].high);
      largest = term > largest ? term : largest;
    }
    return largest;
  };
  return {largest_between(1, first_in_doubles), largest_between(first_in_doubles, end)};
}

/// The logarithm of the least over the components of (w / |part c_k|)^(1/k); infinite where all c_k are 0.
double ExtendedStepper::log_of_step_by(unsigned k, double part) const {
  double largest = 0;
  for (std::size_t i = 0; i < y_.size(); ++i) {
    largest = std::max(largest, part * std::abs(row(next_, i)[k].high) / weight(i));
  }
  if (largest > 0 && std::isfinite(largest)) return -evaluate(Function::log, largest) / k;
  double least = infinity_of_steps;
  for (std::size_t i = 0; i < y_.size(); ++i) {
    const double c = part * std::abs(row(next_, i)[k].high);
    if (c > 0) least = std::min(least, (evaluate(Function::log, weight(i)) - evaluate(Function::log, c)) / k);
  }
  return least;
}

/// Of the next series. Where steps are held short by other things than their last coefficients, such as a
/// bound, fewer do; where this series has fewer, it is hardly in range yet.
unsigned ExtendedStepper::order_after(double h) const {
  constexpr double held = 0.9;
  const unsigned lower = std::min(request_.lower_order, order_);
  if (lower == 0) return order_;
  if (next_.order < lower) return lower;
  const double exponent = std::min(log_of_step_by(lower), log_of_step_by(lower - 1));
  return evaluate(Function::log, h / held) < exponent ? lower : order_;
}

double ExtendedStepper::bounded_part(double h) {
  constexpr double least_part = 1e-12;
  constexpr int most_looks = 120;
  for (std::size_t i = 0; i < y_.size(); ++i) {
    place_[i] = y_[i].high;
    allowed_[i] = allowed_to_hide * weight(i);
  }
  const unsigned order = system_.order_of_hidden > 0 ? system_.order_of_hidden : next_.order;
  double part = h;
  for (int i = 0; i < most_looks && part > least_part * h; ++i) {
    const double ratio = system_.hidden(t_.high, place_, part, allowed_, defect_);
    if (ratio <= 1) return part;
    const double logarithm = evaluate(Function::log, std::min(ratio, 1e300));
    const double shorter = evaluate(Function::exp, -logarithm / order);
    part *= std::max(0.5, 0.93 * shorter);
  }
  return 0;
}

/// hidden_, by the closest bound where a rough one tells of something.
void ExtendedStepper::find_hidden(double h) {
  const unsigned of_bound = system_.order_of_hidden > 0 ? system_.order_of_hidden : next_.order;
  const unsigned last = std::min(next_.order, of_bound);
  take_powers(h);
  const auto hides = [&] {
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const auto c = row(next_, i);
      double term = 0;
      for (unsigned k = last - 2; k <= last; ++k) term = std::max(term, powers_[k] * std::abs(c[k].high));
      hidden_[i] = hidden_behind(term, h * defect_[i]);
    }
    return std::ranges::any_of(hidden_, [](double x) { return x > 0; });
  };
  if (!hides()) return;
  const std::vector<double> by_rough_bound = hidden_;
  (void)system_.hidden(t_.high, place_, h, {}, defect_);
  (void)hides();
  for (std::size_t i = 0; i < hidden_.size(); ++i) hidden_[i] = std::min(hidden_[i], by_rough_bound[i]);
}

/// Up to that, a length over which rounding of the forces is as small as what a step may hide: where terms
/// are much larger than their sum, as behind a pulse, it falls much faster than the length.
double ExtendedStepper::exact_part(double h) {
  const std::size_t n = y_.size() / 2;
  const auto rounded_over = [&](double length) {
    if (!bound_rounding()) return 0.0;
    double most = 0;
    for (std::size_t i = 0; i < n; ++i)
      most = std::max(most, in_double_doubles_[i] * length / allowed_[n + i]);
    return most;
  };
  const auto look_over = [&](double length) {
    (void)system_.hidden(t_.high, place_, length, allowed_, defect_);
    return rounded_over(length);
  };
  double part = h, rounded = rounded_over(h);
  while (rounded > 1 && std::isfinite(rounded)) {
    const double of_half = look_over(part / 2);
    if (!(of_half < fast_fall * rounded)) {
      (void)look_over(part);
      break;
    }
    part /= 2;
    rounded = of_half;
  }
  return part;
}

/// Up to that, a length over which rounding to doubles makes little of the high terms.
double ExtendedStepper::told_part(double h) {
  if (!rounded_series_ || in_doubles_.empty()) return h;
  rounded_series_->take(t_.high, next_.c, next_.order, in_doubles_, h);
  return rounded_series_->told_part(h);
}

/// Of the step that is to be taken. Whether there is a bound.
bool ExtendedStepper::bound_rounding() {
  if (!system_.rounding) return false;
  in_doubles_.resize(y_.size() / 2);
  in_double_doubles_.resize(y_.size() / 2);
  system_.rounding(in_doubles_, in_double_doubles_);
  return true;
}

/// Where rounding of series in doubles has no bound, their remainder says nothing of the forces.
bool ExtendedStepper::shows_forces() const {
  return std::ranges::all_of(in_doubles_, [](double e) { return std::isfinite(e); });
}

bool ExtendedStepper::try_step(const DoubleDouble& t) {
  const DoubleDouble h = t - t_;
  sum_rows(rows_of(next_), ExtendedSum::value, h, attempt_);
  for (std::size_t i = 0; i < y_.size(); ++i) attempt_[i] = y_[i] + attempt_[i];
  if (expand(t, attempt_, order_after(h.high), beyond_) || !holds_until(h)) return false;
  t_previous_ = std::exchange(t_, t);
  last_step_ = h.high;
  y_.swap(attempt_);
  std::swap(coefficients_, next_);
  std::swap(next_, beyond_);
  ++steps_;
  return true;
}

/// But for what the accelerations are rounded by: no shorter step would obey them better.
bool ExtendedStepper::holds_until(const DoubleDouble& h) {
  sum_rows(rows_of(next_), ExtendedSum::slope, h, slopes_);
  const std::size_t n = y_.size() - in_double_doubles_.size();
  for (std::size_t i = 0; i < y_.size(); ++i) {
    const DoubleDouble rate = row(beyond_, i)[1];
    const double defect = std::abs((slopes_[i] - rate).high);
    double round_off = system_.round_off * (std::abs(rate.high) + std::abs(row(next_, i)[1].high));
    if (i >= n) round_off += 2 * in_double_doubles_[i - n];
    if (!(h.high * defect <= largest_end_defect * weight(i) + h.high * round_off)) return false;
  }
  return true;
}

}  // namespace qdot
