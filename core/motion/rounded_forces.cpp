#include "core/motion/rounded_forces.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/motion/extended_pieces.hpp"
#include "core/motion/typed_start.hpp"

namespace qdot {
namespace {

constexpr double of_sides = 0.1;  ///< of a force: on a kink doubles and more digits may take another side
constexpr double of_a_step = 0x1p-53;   ///< half a last place: a step's sum is rounded to nearest
constexpr double some_tolerances = 10;  ///< of a step, in all of them
constexpr std::size_t rows_tried = 8;   ///< each costs an evaluation in double-doubles

/// Calls take(t, y) for some rows.
template <class Take>
void at_some_rows(const ComputedMotion& motion, const Take& take) {
  const std::size_t width = motion.width(), rows = motion.simulation.rows;
  for (std::size_t row = 0; row < rows; row += 1 + (rows - 1) / rows_tried)
    take(motion.grid.t[row], std::span(motion.simulation.states).subspan(row * width, width));
}

/// c of each coordinate, the least; none counts as 0.
std::vector<double> damping(const ComputedMotion& motion) {
  const std::size_t width = motion.width(), n = width / 2;
  std::vector<double> least(n, infinity), jacobian(width * width);
  const CompiledFunction& function = motion.dynamics.jacobian();
  Workspace workspace = function.bind(motion.request.parameters);
  at_some_rows(motion, [&](double t, std::span<const double> y) {
    const bool is_known = function.evaluate(t, y, workspace, jacobian) == Evaluation::ok;
    for (std::size_t i = 0; i < n; ++i)
      least[i] = std::min(least[i], is_known ? std::max(0.0, -jacobian[(n + i) * width + n + i]) : 0);
  });
  return least;
}

/// What all steps of a motion make of each column, if each rounds it the same way. Steps of another method
/// have nothing in common with those of a check.
std::vector<double> rounding_of_steps(const ComputedMotion& motion, std::vector<double> rounding) {
  if (motion.simulation.method != Method::bdf) return std::vector<double>(motion.width());
  for (double& x : rounding) x *= of_a_step * static_cast<double>(motion.simulation.steps);
  return rounding;
}

/// L_q / L_v of each coordinate: for so long it moves one way.
std::vector<double> own_times(std::span<const double> largest) {
  std::vector<double> times(largest.size() / 2, infinity);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double speed = largest[times.size() + i];
    if (speed > 0) times[i] = largest[i] / speed;
  }
  return times;
}

}  // namespace

std::vector<double> rounding_of_forces(const ComputedMotion& motion) {
  const std::size_t n = motion.width() / 2;
  std::vector<double> rounding(n), rounded(n);
  const CompiledFunction& function = motion.dynamics.accelerations();
  Workspace workspace = function.bind(motion.request.parameters);
  const bool has_kinks = motion.dynamics.kinks() != nullptr;
  ExtendedFunction exact(function, double_doubles(motion.request.parameters));
  at_some_rows(motion, [&](double t, std::span<const double> y) {
    if (function.evaluate(t, y, workspace, rounded) != Evaluation::ok) return;
    const auto right = exact(t, std::vector<DoubleDouble>(y.begin(), y.end()));
    for (std::size_t i = 0; i < n; ++i) {
      const double off = std::abs((right[i] - rounded[i]).value());
      const bool is_other_side = has_kinks && off > of_sides * std::abs(rounded[i]);
      if (!is_other_side) rounding[i] = std::max(rounding[i], off);
    }
  });
  return rounding;
}

std::vector<double> rounding_at_rest(const ComputedMotion& motion) {
  constexpr double some_times = 64;  // solving for accelerations rounds, too, and so do several computations
  const std::vector<double> off = rounding_of_forces(motion);
  const auto& coordinates = motion.dynamics.model().scene.coordinates;
  const std::size_t n = off.size();
  const double duration = motion.request.t_end - motion.request.t_start;
  std::vector<double> left(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (coordinates[i].unit == coordinates[j].unit)
        left[n + i] = std::max(left[n + i], some_times * off[j] * duration);
    }
    left[i] = left[n + i] * duration;
  }
  return left;
}

void add_what_is_in_common(const ComputedMotion& motion, const Sizes& sizes, const Tolerances& tolerances,
                           Simulation& check) {
  if (check.method != Method::bdf || check.rows == 0) return;
  const std::size_t width = motion.width(), n = width / 2;
  const std::vector<double> off = rounding_of_forces(motion), c = damping(motion),
                            of_steps = rounding_of_steps(motion, sizes.of_kind),
                            tau = own_times(sizes.of_columns);
  const double duration = motion.simulation.t - motion.request.t_start;
  check.unseen.resize(check.rows * width);
  for (std::size_t row = 0; row < check.rows; ++row) {
    const double t = motion.grid.t[row] - motion.request.t_start;
    if (t == 0) continue;
    double* const unseen = check.unseen.data() + row * width;
    for (std::size_t i = 0; i < n; ++i) {
      const double lasts = c[i] * t > 1 ? 1 / c[i] : t;
      const double of_force = off[i] * lasts, of_velocity = of_steps[n + i] * (lasts / duration);
      unseen[n + i] += of_force + of_velocity;
      unseen[i] += of_force * t + of_velocity * std::min(t, tau[i]) + of_steps[i];
    }
    for (std::size_t k = 0; k < width; ++k)
      unseen[k] += some_tolerances * (tolerances.rtol * sizes.of_columns[k] + tolerances.atol);
  }
}

}  // namespace qdot
