#include "core/motion/bounce.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace qdot {
namespace {

constexpr double rounding_of_kick = 64 * std::numeric_limits<double>::epsilon();
constexpr double step_of_way = 1e-7;  ///< of the largest coordinate

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// The velocities that `after` has and y has not.
std::vector<double> change_of_velocities(const std::vector<double>& y, const std::vector<double>& after) {
  std::vector<double> change;
  for (std::size_t i = y.size() / 2; i < y.size(); ++i) change.push_back(after[i] - y[i]);
  return change;
}

double largest_of(std::span<const double> numbers) {
  double largest = 0;
  for (const double x : numbers) largest = std::max(largest, std::abs(x));
  return largest > 0 ? largest : 1;
}

/// sum_i dg/dq_i k_i
double slope_along(const Watch& watch, double t, const std::vector<double>& y, std::span<const double> k) {
  const double step = step_of_way * largest_of(std::span(y).first(k.size())) / largest_of(k);
  const auto value = [&](double factor) {
    std::vector<double> moved = y;
    for (std::size_t i = 0; i < k.size(); ++i) moved[i] += factor * k[i];
    return watch.value(t, moved);
  };
  return (value(step) - value(-step)) / (2 * step);
}

}  // namespace

std::vector<Watch> watches_of_impacts(const ComputedMotion& motion) {
  std::vector<Watch> found =
      watches(motion.dynamics, {.parameters = motion.request.parameters, .on_invalid = OnInvalid::go_on});
  std::erase_if(found, [](const Watch& watch) { return watch.kind != Watch::Kind::impact; });
  return found;
}

Bounce::Bounce(const ComputedMotion& motion, const ParsedImpact& impact, const Watch& watch)
    : watch_(watch),
      map_(impact_map(motion.dynamics.model(), impact)),
      components_(motion.dynamics.columns(map_.components)),
      workspace_(components_->bind(motion.request.parameters)) {}

std::vector<double> Bounce::kick(double t, const std::vector<double>& y) {
  return change_of_velocities(y, map(t, y));
}

bool Bounce::leaves_nothing(double t, const std::vector<double>& y, const SectionRecord& before) {
  const std::vector<double> now = kick(t, y), first = change_of_velocities(before.before, before.after);
  return std::sqrt(product(now, now)) <= rounding_of_kick * std::sqrt(product(first, first));
}

std::vector<double> Bounce::change(double t, const std::vector<double>& y, const SectionRecord& before) {
  const std::vector<double> after = map(t, y), now = change_of_velocities(y, after);
  const bool turns = product(now, kick(t, after)) < 0;
  const bool falls = product(now, change_of_velocities(before.before, before.after)) > 0;
  return turns && falls ? now : std::vector<double>(now.size());
}

/// What the impact takes from a velocity more of one coordinate lies on it: of the one that tells most.
std::vector<double> Bounce::way(double t, const std::vector<double>& y) {
  const std::size_t n = y.size() / 2;
  const double speed = largest_of(std::span(y).last(n));
  const std::vector<double> own = kick(t, y);
  std::vector<double> way(n), most(n);
  double slope = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> faster = y;
    faster[n + i] += speed;
    const std::vector<double> pushed = kick(t, faster);
    for (std::size_t j = 0; j < n; ++j) way[j] = pushed[j] - own[j];
    const double now = slope_along(watch_, t, y, way);
    if (!(std::abs(now) > std::abs(slope))) continue;
    slope = now;
    most = way;
  }
  for (double& k : most) k = slope != 0 ? k / slope : 0;
  return most;
}

std::vector<double> Bounce::map(double t, std::vector<double> y) {
  std::vector<double> values(map_.places.size());
  if (components_->evaluate(t, y, workspace_, values) == Evaluation::ok) map_.assign(values, y);
  return y;
}

}  // namespace qdot
