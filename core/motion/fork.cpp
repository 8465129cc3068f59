#include "core/motion/fork.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double rounding_of_numbers = 8 * std::numeric_limits<double>::epsilon();
constexpr double seen = 64 * std::numeric_limits<double>::epsilon();  ///< of those that make up g
constexpr double step_of_difference = 1e-7;                           ///< relative
constexpr double small_beside_errors =
    0.1;                               ///< of the errors of velocities: what a jump of forces adds to them
constexpr double still_turns = 0.5;    ///< as much as before the event
constexpr double doubt_of_others = 4;  ///< times that of the nearest one: the same errors move them more
constexpr double clearly = 0.25;       ///< of what g was moved by: so far before the event it begins
constexpr double first_share = 1e-12;  ///< of the span: how early it is looked for at first
constexpr double earlier = 1.5;
constexpr double share_of_step = 1e-6;
constexpr double part_before_condition = 1e-3;  ///< of the section

}  // namespace

Fork::Fork(const ComputedMotion& motion, const ApproachAsTold& approach)
    : motion_(motion),
      approach_(approach.approach),
      place_(approach_.place),
      stated_(approach.stated),
      beside_(approach.told.beside),
      y_(state_at(0)),
      errors_(approach.told.errors),
      t_(place_.t),
      value_(value(t_, y_)) {
  const std::vector<double> then = state_at(place_.instant() - place_.t);
  for (std::size_t k = 0; k < y_.size(); ++k) {
    errors_[k] += rounding_of_numbers * std::max(std::abs(y_[k]), std::abs(then[k]));
    errors_[k] += time_round_off(t_) * std::abs(place_.rows[k * (Approach::order + 1) + 1]);
  }
  take_slopes();
  take_doubt();
  if (place_.is_condition) move_to_event();
}

bool Fork::is_open() const {
  if (approach_.of_event && !place_.is_condition && !approach_.of_event(t_, within_errors()).contains(0))
    return false;
  if (place_.is_hidden) return true;
  // Of a condition that is switched off by a parameter.
  const bool is_exactly_zero = value_ == 0 && doubt_ < std::numeric_limits<double>::min();
  if (place_.is_condition && is_exactly_zero) return false;
  return !(-side_of_way() * value_ > (place_.others ? doubt_of_others * doubt_ : doubt_));
}

bool Fork::is_negligible() const {
  if (!approach_.is_kink || approach_.stays) return false;
  const CompiledFunction& accelerations = motion_.dynamics.accelerations();
  const std::size_t n = y_.size() / 2;
  Workspace workspace = accelerations.bind(motion_.request.parameters);
  std::vector<double> here(n), beyond(n);
  const auto take = [&](std::span<const double> y, std::span<double> found) {
    return accelerations.evaluate(t_, y, workspace, found) == Evaluation::ok;
  };
  if (!take(moved(y_, doubt_), here) || !take(moved(y_, -doubt_), beyond)) return false;
  const double early = place_.t - begin();
  const double turn = turned_by(early), turn_beyond = turn + place_.sign * pull(here, beyond) * early * early;
  if (!(turn_beyond > still_turns * turn)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(std::abs(beyond[i] - here[i]) * 2 * early <= small_beside_errors * stated_[n + i])) return false;
  }
  return true;
}

double Fork::begin() const {
  if (place_.is_condition) return place_.t - part_before_condition * (place_.t - approach_.begun);
  const double least = clearly * std::abs(wanted_value());
  double early =
      std::max(first_share * (motion_.request.t_end - motion_.request.t_start), time_round_off(place_.t));
  if (place_.met) early = std::max(early, place_.t - *place_.met);
  for (; place_.t - early > approach_.begun; early *= earlier) {
    if (place_.sign * value(place_.t - early, on_way(state_at(-early))) > least) return place_.t - early;
  }
  return approach_.begun;
}

std::optional<std::vector<double>> Fork::start(double t) const {
  std::vector<double> y = on_way(state_at(t - place_.t));
  const ConstraintSurface* surface = motion_.dynamics.constraint_surface();
  if (surface != nullptr && !ConstrainedStates(*surface, motion_.request.parameters).project(t, y))
    return std::nullopt;
  const bool is_before = place_.sign * value(t, y) > 0;
  return is_before || approach_.is_kink || place_.is_condition ? std::optional(std::move(y)) : std::nullopt;
}

std::vector<double> Fork::at_place() const {
  std::vector<double> y = y_;
  const std::size_t n = y.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    if (slopes_[i] != 0) y[n + i] -= place_.sign * std::copysign(errors_[n + i], slopes_[i]);
  }
  return y;
}

double Fork::value(double t, std::span<const double> y) const {
  return approach_.enclosure(t, std::vector<Interval>(y.begin(), y.end())).middle();
}

/// Of the motion that the approach stands for.
std::vector<double> Fork::state_at(double s) const {
  std::vector<double> y = place_.state_at(s);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] += beside_[k];
  return y;
}

/// g'' s^2 of the motion before the event, which is what turns it back.
double Fork::turned_by(double s) const {
  const auto value_at = [&](double later) { return value(place_.t + later, state_at(later)); };
  return place_.sign * (value_at(s) + value_at(-s) - 2 * value_);
}

/// By how much g'' is another one beyond the event; not a number where velocities stand in g.
double Fork::pull(std::span<const double> here, std::span<const double> beyond) const {
  const std::size_t n = here.size();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (slopes_[n + i] * (beyond[i] - here[i]) != 0) return std::numeric_limits<double>::quiet_NaN();
    sum += slopes_[i] * (beyond[i] - here[i]);
  }
  return sum;
}

/// Over steps in which rounding does not matter.
void Fork::take_slopes() {
  std::vector<double> beside = y_;
  for (std::size_t k = 0; k < y_.size(); ++k) {
    double step = std::max(errors_[k], step_of_difference * std::abs(y_[k]));
    if (step == 0) step = step_of_difference;
    beside[k] = y_[k] + step;
    const double above = value(t_, beside);
    beside[k] = y_[k] - step;
    slopes_.push_back((above - value(t_, beside)) / (2 * step));
    beside[k] = y_[k];
    size_ += std::abs(slopes_[k] * y_[k]);
    rises_.push_back(slopes_[k] * errors_[k]);
    rise_ += std::abs(rises_[k]);
  }
}

std::vector<Interval> Fork::within_errors() const {
  std::vector<Interval> box;
  for (std::size_t k = 0; k < y_.size(); ++k) box.emplace_back(y_[k] - errors_[k], y_[k] + errors_[k]);
  return box;
}

void Fork::take_doubt() {
  const Interval values = approach_.enclosure(t_, within_errors());
  doubt_ = std::max(values.upper - value_, value_ - values.lower);
  is_bounded_ = std::isfinite(doubt_);
  if (!is_bounded_) doubt_ = 2 * rise_;
}

/// A condition counts when the event happens, which is as uncertain as its g is.
void Fork::move_to_event() {
  const double tau = share_of_step * place_.h;
  const auto rise = [&](const auto& of) {
    const std::vector<double> before = state_at(-tau), after = state_at(tau);
    return (of(t_ + tau, after).middle() - of(t_ - tau, before).middle()) / (2 * tau);
  };
  const auto enclosed = [&](const auto& of) {
    return [&of](double t, std::span<const double> y) {
      return of(t, std::vector<Interval>(y.begin(), y.end()));
    };
  };
  const double slope = rise(enclosed(approach_.of_event));
  const Interval later = approach_.of_event(t_, within_errors()) / Interval(-slope);
  const double middle = later.middle(), along = std::abs(rise(enclosed(approach_.enclosure)));
  t_ += middle;
  y_ = state_at(middle);
  value_ = value(t_, y_);
  doubt_ += along * later.radius();
}

/// The sign of g where the other way turns: past the event where it was missed.
int Fork::side_of_way() const { return place_.met ? place_.sign : -place_.sign; }

/// As far from zero as it may be, or as rounding leaves it to be seen.
double Fork::wanted_value() const {
  return side_of_way() * std::max({doubt_, seen * size_, side_of_way() * value_});
}

std::vector<double> Fork::on_way(std::vector<double> y) const { return moved(std::move(y), wanted_value()); }

/// To where g would be that at its turn.
std::vector<double> Fork::moved(std::vector<double> y, double g) const {
  if (!(rise_ > 0)) return y;
  const double lambda = (g - value_) / rise_;
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (rises_[k] != 0) y[k] += std::copysign(lambda * errors_[k], lambda * rises_[k]);
  }
  return y;
}

}  // namespace qdot
