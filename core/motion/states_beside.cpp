#include "core/motion/states_beside.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace qdot {
namespace {

constexpr double short_beside = 1e-6;  ///< the time that has passed: errors do not grow in it
constexpr double most_growth = 1;      ///< by the second order, of what is there by the first

Interval within(double middle, double radius) { return {middle - radius, middle + radius}; }

}  // namespace

StatesBeside::StatesBeside(const Dynamics& dynamics, Workspace& workspace, double t_start, double t,
                           std::span<const double> y, std::vector<double> errors)
    : dynamics_(dynamics),
      workspace_(workspace),
      t_start_(t_start),
      t_(t),
      y_(y),
      errors_(std::move(errors)),
      accelerations_(accelerations_at(t, y)) {}

std::vector<double> StatesBeside::accelerations_at(double t, std::span<const double> y) {
  std::vector<double> result(y.size() / 2);
  if (dynamics_.accelerations().evaluate(t, y, workspace_, result) != Evaluation::ok) {
    std::ranges::fill(result, std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

std::vector<double> StatesBeside::after(double tau) {
  const std::size_t n = accelerations_.size();
  std::vector<double> moved(y_.begin(), y_.end());
  const auto move = [&](double length, const std::vector<double>& rates, std::span<const double> velocities) {
    for (std::size_t i = 0; i < n; ++i) {
      moved[i] = y_[i] + length * velocities[i];
      moved[n + i] = y_[n + i] + length * rates[i];
    }
  };
  move(tau / 2, accelerations_, y_.subspan(n));
  const std::vector<double> middle = moved;
  move(tau, accelerations_at(t_ + tau / 2, middle), std::span(middle).subspan(n));
  return moved;
}

std::optional<std::vector<double>> StatesBeside::errors_after(double tau) {
  const std::size_t n = accelerations_.size();
  std::vector<double> errors = errors_;
  const double length = std::abs(tau);
  const bool is_short = length <= short_beside * (t_ - t_start_);
  for (std::size_t i = 0; i < n; ++i) {
    const double moved = length * errors_[n + i], apart = is_short ? 0 : length * accelerations_off()[i];
    if (!(length * apart <= most_growth * (errors_[i] + moved))) return std::nullopt;
    errors[i] += moved + length * apart / 2;
    errors[n + i] += apart;
  }
  return errors;
}

const std::vector<double>& StatesBeside::accelerations_off() {
  if (!accelerations_off_.empty()) return accelerations_off_;
  std::vector<double> moved(y_.begin(), y_.end());
  accelerations_off_.resize(accelerations_.size());
  for (std::size_t k = 0; k < moved.size(); ++k) {
    moved[k] = y_[k] + errors_[k];
    const std::vector<double> beyond = accelerations_at(t_, moved);
    moved[k] = y_[k] - errors_[k];
    const std::vector<double> before = accelerations_at(t_, moved);
    moved[k] = y_[k];
    for (std::size_t i = 0; i < beyond.size(); ++i) {
      const double change = (beyond[i] - before[i]) / 2;
      const bool is_damping = k == beyond.size() + i && change < 0;
      if (!is_damping) accelerations_off_[i] += std::abs(change);
    }
  }
  return accelerations_off_;
}

std::optional<std::vector<Interval>> StatesBeside::box_after(double tau) {
  const auto errors = errors_after(tau);
  if (!errors) return std::nullopt;
  const std::size_t n = accelerations_.size();
  std::vector<double> ahead(y_.begin(), y_.end());
  for (std::size_t k = 0; k < 2 * n; ++k) ahead[k] += tau * rate(k);
  const std::vector<double> then = accelerations_at(t_ + tau, ahead);
  std::vector<Interval> box(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const double change = then[i] - accelerations_[i];
    const double q = ahead[i] + tau * tau * (accelerations_[i] / 2 + change / 6);
    const double v = ahead[n + i] + tau * change / 2;
    box[i] = within(q, (*errors)[i] + tau * tau * std::abs(change) / 6);
    box[n + i] = within(v, (*errors)[n + i] + std::abs(tau * change) / 2);
  }
  return box;
}

std::optional<StatesBeside::Around> StatesBeside::around(double tau) {
  const auto errors = errors_after(tau);
  if (!errors) return std::nullopt;
  const std::size_t n = accelerations_.size();
  Around all{{y_.begin(), y_.end()}, std::vector<Interval>(2 * n)};
  for (std::size_t i = 0; i < n; ++i) all.rates[n + i] = accelerations_[i];
  for (const double length : {-tau, tau}) {
    const std::vector<double> there = after(length), a = accelerations_at(t_ + length, there);
    for (std::size_t k = 0; k < 2 * n; ++k) all.y[k] = hull(all.y[k], there[k]);
    for (std::size_t i = 0; i < n; ++i) all.rates[n + i] = hull(all.rates[n + i], a[i]);
  }
  for (std::size_t k = 0; k < 2 * n; ++k) all.y[k] = all.y[k] + within(0, (*errors)[k]);
  for (std::size_t i = 0; i < n; ++i) {
    all.rates[i] = all.y[n + i];
    all.rates[n + i] = all.rates[n + i] + within(0, accelerations_off()[i]);
  }
  return all;
}

}  // namespace qdot
