#include "core/closed/rough_period.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/numerics/constants.hpp"
#include "core/numerics/function.hpp"

namespace qdot {
namespace {

constexpr double rough = 1e-3;  ///< of a period
constexpr int pieces = 200;     ///< of an integral

/// Small and large places on both sides of 0, and close ones between -20 and 20.
std::vector<double> looked_at(const SquaredSpeed& e) {
  std::vector<double> places;
  const auto add = [&](double x) {
    if (x > e.below && x < e.above) places.push_back(x);
  };
  for (int k = -40; k <= 40; ++k) {
    const double x = power(10.0, k / 10.0);
    add(x);
    add(-x);
  }
  add(0);
  for (int k = -1000; k <= 1000; ++k) add(k / 50.0 + 1e-3);
  std::ranges::sort(places);
  return places;
}

bool moves(double squared_speed) { return squared_speed > 0 && std::isfinite(squared_speed); }

/// Where e becomes 0 between a place that is reached and one that is not; no number at a pole, or where e
/// ends to have values.
double end_between(const SquaredSpeed& e, double reached, double beyond) {
  constexpr int halvings = 200;
  const double size = e.at(reached);
  for (int i = 0; i < halvings; ++i) {
    const double middle = reached + (beyond - reached) / 2;
    if (middle == reached || middle == beyond) break;
    (moves(e.at(middle)) ? reached : beyond) = middle;
  }
  return std::abs(e.at(reached)) < rough * size ? reached : std::numeric_limits<double>::quiet_NaN();
}

double way_between(const SquaredSpeed& e, double from, double to, int parts) {
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double u = pi * ((i + 0.5) / parts - 0.5);
    sum += half * evaluate(Function::cos, u) / std::sqrt(e.at(middle + half * evaluate(Function::sin, u)));
  }
  return 2 * pi / parts * sum;
}

/// Whether e grows without bound where it is largest: no motion passes a pole.
bool has_pole(const SquaredSpeed& e, double from, double to) {
  constexpr int halvings = 60;
  constexpr double without_bound = 1e6;
  const double step = (to - from) / pieces;
  double place = from + step, largest = 0;
  for (int i = 1; i < pieces; ++i) {
    const double x = from + i * step;
    if (!(e.at(x) <= largest)) std::tie(place, largest) = std::pair(x, e.at(x));
  }
  double low = place - step, high = place + step;
  for (int i = 0; i < halvings; ++i) {
    const double third = (high - low) / 3;
    if (e.at(low + third) < e.at(high - third))
      low += third;
    else
      high -= third;
  }
  return !(e.at((low + high) / 2) < without_bound * largest);
}

double turn(const SquaredSpeed& e, int parts) {
  double sum = 0;
  for (int i = 0; i < parts; ++i) sum += 1 / std::sqrt(e.at(2 * pi * i / parts));
  return 2 * pi / parts * sum;
}

enum class Likeness { same, other, unknown };

/// Unknown where the integral does not settle, or between the ends something hides at which nothing moves.
Likeness compared(double first, double finer, double period) {
  if (!(std::abs(first - finer) <= 0.1 * rough * std::abs(finer))) return Likeness::unknown;
  return std::abs(finer - period) <= rough * std::abs(finer) ? Likeness::same : Likeness::other;
}

Likeness compared(const SquaredSpeed& e, double from, double to, double period) {
  if (!std::isfinite(from) || !std::isfinite(to) || has_pole(e, from, to)) return Likeness::other;
  return compared(way_between(e, from, to, pieces), way_between(e, from, to, 2 * pieces), period);
}

/// Or at an end.
bool is_between(double x, double low, double high) {
  const double slack = 1e-6 * (1 + std::abs(x));
  return low - slack <= x && x <= high + slack;
}

}  // namespace

bool may_swing_with(const SquaredSpeed& e, double period) {
  const std::vector<double> places = looked_at(e);
  bool is_another = false;
  for (std::size_t first = 0; first < places.size(); ++first) {
    std::size_t next = first;
    while (next < places.size() && moves(e.at(places[next]))) ++next;
    if (next == first) continue;
    const double from = first > 0 ? end_between(e, places[first], places[first - 1]) : e.below;
    const double to = next < places.size() ? end_between(e, places[next - 1], places[next]) : e.above;
    const double low = std::isfinite(from) ? from : places[first];
    const double high = std::isfinite(to) ? to : places[next - 1];
    if (e.start && !is_between(*e.start, low, high)) {
      first = next;
      continue;
    }
    const Likeness verdict = compared(e, from, to, period);
    if (verdict == Likeness::same) return true;
    is_another = is_another || verdict == Likeness::other;
    first = next;
  }
  return !is_another;
}

bool may_turn_with(const SquaredSpeed& e, double period) {
  for (int i = 0; i < pieces; ++i) {
    if (!moves(e.at(2 * pi * i / pieces))) return true;
  }
  return compared(turn(e, pieces), turn(e, 2 * pieces), period) != Likeness::other;
}

}  // namespace qdot
