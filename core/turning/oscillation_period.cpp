#include "core/turning/oscillation_period.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

/// Relative. Both rules converge so fast that halving the step squares the error; what two sums differ by is
/// the error of the coarser one.
constexpr double agreement = 3e-8;
constexpr double safety = 100;
constexpr int fewest_nodes = 8;
constexpr int most_nodes = 512;
constexpr double coarsest_step = 0.25;
constexpr double finest_step = 1.0 / 128;
constexpr double last_step = 3.3;  ///< the weights beyond are below 1e-17

const Interval pi_enclosed(std::nextafter(pi, 0), std::nextafter(pi, 4));

enum class End { left, right };
/// An integrand on [0, pi] at a distance from one end, the nearer one.
using Integrand = std::function<Interval(double distance, End end)>;

/// All of what a rounded place may stand for.
Interval around(double x) { return {std::nextafter(x, -infinity), std::nextafter(x, infinity)}; }

/// The finer of two sums with its error, if they agree.
std::optional<Finding> settled(const Interval& coarse, const Interval& fine) {
  const double size = std::abs(fine.middle());
  const double difference = std::abs(fine.middle() - coarse.middle());
  if (!fine.is_finite() || !(difference <= agreement * size + fine.radius())) return std::nullopt;
  const double remainder = std::min(difference, safety * difference * (difference / size));
  return Finding{fine.middle(), fine.radius() + remainder, ""};
}

Finding unknown() {
  return {std::nullopt, 0, "Double precision cannot tell the speed well enough all along the motion."};
}

/// Of a function with period 2 pi that is even about 0 and pi: N = 8, 16, ... intervals, old nodes kept.
std::optional<Finding> trapezoidal(const Integrand& f) {
  Interval sum = (f(0, End::left) + f(0, End::right)) * Interval(0.5);
  Interval coarse = Interval::whole();
  for (int n = 1; n <= most_nodes; n *= 2) {
    for (int k = 1; k < n; k += 2) {  // only what is new
      const bool left = 2 * k <= n;
      sum = sum + f(pi * (left ? k : n - k) / n, left ? End::left : End::right);
    }
    if (!sum.is_finite()) return std::nullopt;
    const Interval fine = sum * pi_enclosed / Interval(n);
    if (n > fewest_nodes) {
      if (const auto found = settled(coarse, fine)) return found;
    }
    coarse = fine;
  }
  return std::nullopt;
}

/// Any function that is analytic inside [0, pi]: phi = pi/(1 + exp(-2 u)), u = pi/2 sinh(t).
std::optional<Finding> double_exponential(const Integrand& f) {
  const auto term = [&](double t) {
    const double u = pi / 2 * evaluate(Function::sinh, std::abs(t));
    const double decay = evaluate(Function::exp, -2 * u);
    const double distance = pi * decay / (1 + decay);
    const double weight = pi * pi * evaluate(Function::cosh, t) * decay / ((1 + decay) * (1 + decay));
    constexpr double roundings = 16 * 0x1p-53;
    const Interval enclosed(weight * (1 - roundings * (1 + 2 * u)), weight * (1 + roundings * (1 + 2 * u)));
    return enclosed * f(distance, t < 0 ? End::left : End::right);
  };
  Interval sum = term(0);
  Interval coarse = Interval::whole();
  for (double h = coarsest_step; h >= finest_step; h /= 2) {
    const double apart = h == coarsest_step ? h : 2 * h;
    for (double t = h; t < last_step; t += apart) sum = sum + term(t) + term(-t);
    if (!sum.is_finite()) return std::nullopt;
    const Interval fine = sum * Interval(h);
    if (const auto found = settled(coarse, fine)) return found;
    coarse = fine;
  }
  return std::nullopt;
}

Interval speed_inverse(EnergyBalance& energy, const Interval& x, const Interval& remaining) {
  return sqrt(energy.inertia(x) / (Interval(2) * remaining));
}

/// The maximum of U over a turn, where the motion is slowest: the best of some places, then Newton on g.
double crest_of(EnergyBalance& energy) {
  constexpr int places = 64;
  constexpr int most_steps = 20;
  double crest = energy.x0();
  double least = infinity;
  for (int k = 0; k < places; ++k) {
    const double x = energy.x0() + 2 * pi * k / places;
    const double remaining = energy.remaining(x).middle();
    if (remaining < least) crest = x;
    least = std::min(least, remaining);
  }
  for (int i = 0; i < most_steps; ++i) {
    const double step = energy.potential_rate(crest).middle() / energy.stiffness(crest).middle();
    if (!(std::abs(step) < 2 * pi / places)) break;
    crest -= step;
    if (std::abs(step) < 1e-15 * (1 + std::abs(crest))) break;
  }
  return crest;
}

/// 1/|x'| at the same distance on both sides of a place, from the divided difference of U there.
Interval inverse_speeds(EnergyBalance& energy, double centre, const Interval& remaining, double distance) {
  Interval sum(0);
  for (const double sign : {-1.0, 1.0}) {
    const Interval x = around(centre + sign * distance);
    const Interval gained = Interval(sign * distance) * energy.potential_slope(centre, x);
    sum = sum + speed_inverse(energy, x, remaining - gained);
  }
  return sum;
}

}  // namespace

Finding libration_period(EnergyBalance& energy, const Interval& a, const Interval& b) {
  const double from = a.middle(), to = b.middle();
  const auto integrand = [&](double distance, End end) {
    const double half = evaluate(Function::sin, distance / 2);
    const double reach = (to - from) * half * half;
    if (end == End::left) {
      const Interval x = distance == 0 ? a : around(from + reach);
      return speed_inverse(energy, x, -energy.potential_slope(a, x) / (b - x));
    }
    const Interval x = distance == 0 ? b : around(to - reach);
    return speed_inverse(energy, x, energy.potential_slope(b, x) / (x - a));
  };
  auto found = trapezoidal(integrand);
  if (!found) found = double_exponential(integrand);
  if (!found) return unknown();
  return {2 * *found->value, 2 * found->error, ""};
}

Finding rotation_period(EnergyBalance& energy) {
  const auto from = [&energy](double centre) {
    return [&energy, centre, remaining = energy.remaining(centre)](double distance, End end) {
      return inverse_speeds(energy, centre, remaining, end == End::left ? distance : pi - distance);
    };
  };
  auto found = trapezoidal(from(energy.x0()));
  if (!found) found = double_exponential(from(crest_of(energy)));
  return found ? *found : unknown();
}

}  // namespace qdot
