#include "core/steady/equilibrium_enclosure.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"

namespace qdot {
namespace {

using Balls = std::vector<Ball>;
using Forces = TapeEvaluator<Ball>;

/// Of a coordinate's size.
constexpr double nearly_zero = 1e-6;
constexpr double point_like = 1e-14;  ///< so wide is what is known
constexpr double shortest_reach = 0x1p-100;
constexpr int passes = 3;
/// At a zero of order m Newton's step is an m-th part of the way that is left.
constexpr double highest_order = 8;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// C g, nothing for coordinates that stay.
Balls correction(const NearlyEquilibrium& near, const Balls& x, Forces& forces) {
  Balls g(x.size()), result(x.size());
  forces(x, g);
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size() && !near.free[i]; ++j)
      result[i] = result[i] + Ball(near.inverse(index(i), index(j))) * g[j];
  }
  return result;
}

/// Gives the points x radii r that fulfil Krawczyk's condition with |C g| = `left`,
/// and says whether it could.
bool contract(const Statics& statics, std::span<const Ball> constants, const NearlyEquilibrium& near,
              const std::vector<double>& left, Balls& x) {
  constexpr int attempts = 4;
  const std::size_t n = x.size();
  TapeEvaluator<Ball> stiffness(statics.stiffness, constants);
  std::vector<double> reach = left;
  Balls trial = x;
  Balls k(n * n);
  for (int attempt = 0; attempt < attempts; ++attempt) {
    for (std::size_t i = 0; i < n; ++i)
      if (!near.free[i]) trial[i].radius = 2 * reach[i] + 0x1p-100 * std::abs(x[i].middle.high) + 1e-290;
    stiffness(trial, k);
    bool inside = true;
    for (std::size_t i = 0; i < n; ++i) {
      reach[i] = left[i];
      for (std::size_t j = 0; j < n && !near.free[i]; ++j) {
        Ball rest = i == j ? 1 : 0;
        for (std::size_t l = 0; l < n; ++l)
          rest = rest - Ball(near.inverse(index(i), index(l))) * k[l * n + j];
        reach[i] += rest.magnitude() * trial[j].radius;
      }
      inside = inside && (near.free[i] || reach[i] * (1 + 1e-10) <= trial[i].radius);
    }
    if (!inside) continue;
    x = trial;
    return true;
  }
  return false;
}

bool without_forces(const Balls& x, Forces& forces) {
  Balls g(x.size());
  forces(x, g);
  return std::ranges::all_of(g, [](const Ball& force) { return force.is_finite() && force.contains_zero(); });
}

bool has_no_force(const Balls& x, std::size_t i, double shift, Forces& forces) {
  Balls there = x;
  there[i] = there[i] + Ball(shift);
  return without_forces(there, forces);
}

/// How far a coordinate may be moved without a force that is seen beside what the forces are rounded by, up
/// to its size.
double hidden_reach(const Balls& x, std::size_t i, double size, Forces& forces) {
  double reach = shortest_reach * size;
  while (reach < size && (has_no_force(x, i, reach, forces) || has_no_force(x, i, -reach, forces)))
    reach *= 2;
  return reach;
}

/// Whether doubles have found no force that depends on the coordinate, where rounding may hide one.
bool is_hidden(const NearlyEquilibrium& near, const Balls& x, std::size_t i, Forces& forces) {
  if (near.free[i] || !near.inverse.row(index(i)).isZero(0)) return false;
  Balls g(x.size());
  forces(x, g);
  return std::ranges::any_of(g, [](const Ball& force) { return force.radius > 0; });
}

/// K does not decide here. A coordinate that is nearly zero may be zero exactly.
std::optional<Equilibrium> degenerate(Balls x, const std::vector<double>& left, const NearlyEquilibrium& near,
                                      Forces& forces) {
  Balls rounded = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::abs(x[i].middle.high) < nearly_zero * near.sizes[i]) rounded[i] = 0;
  }
  const bool are_rounded = without_forces(rounded, forces);
  if (are_rounded) x = rounded;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool hidden = is_hidden(near, x, i, forces);
    const double width = hidden ? hidden_reach(x, i, near.sizes[i], forces) : highest_order * left[i];
    const bool is_known = are_rounded && !hidden && (x[i].value() == 0 || width < point_like * near.sizes[i]);
    if (!is_known) x[i].radius = width;
  }
  return are_rounded || without_forces(x, forces) ? std::optional(Equilibrium{x, false}) : std::nullopt;
}

}  // namespace

std::optional<Equilibrium> enclosed_equilibrium(const Statics& statics, std::span<const Ball> constants,
                                                const NearlyEquilibrium& near) {
  Forces forces(statics.forces, constants);
  Balls x(near.x.begin(), near.x.end());
  for (int pass = 0; pass < passes; ++pass) {
    const Balls step = correction(near, x, forces);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = Ball((x[i] - step[i]).middle, 0);
  }
  std::vector<double> left;
  for (const Ball& step : correction(near, x, forces)) left.push_back(step.magnitude());
  if (!contract(statics, constants, near, left, x)) return degenerate(x, left, near, forces);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!near.free[i] && x[i].contains_zero()) x[i] = Ball(DoubleDouble{}, x[i].magnitude());
  }
  return without_forces(x, forces) ? std::optional(Equilibrium{x, true}) : std::nullopt;
}

}  // namespace qdot
