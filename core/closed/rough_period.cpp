#include "core/closed/rough_period.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/numerics/constants.hpp"
#include "core/numerics/function.hpp"

namespace qdot {
namespace {

constexpr double rough = 1e-3;  ///< of a period
constexpr int pieces = 80;      ///< of a way that is looked at, and of a turn

/// Small and large places on both sides of 0, and close ones between -20 and 20.
std::vector<double> places_to_look_at() {
  std::vector<double> places{0};
  for (int k = -40; k <= 40; ++k) {
    const double x = power(10.0, k / 10.0);
    places.push_back(x);
    places.push_back(-x);
  }
  for (int k = -1000; k <= 1000; ++k) places.push_back(k / 50.0 + 1e-3);
  std::ranges::sort(places);
  return places;
}

std::vector<double> looked_at(const SquaredSpeed& e) {
  static const std::vector<double> all = places_to_look_at();
  std::vector<double> places;
  std::ranges::copy_if(all, std::back_inserter(places), [&](double x) { return x > e.below && x < e.above; });
  return places;
}

bool moves(double squared_speed) { return squared_speed > 0 && std::isfinite(squared_speed); }

/// Where e becomes 0 between a place that is reached and one that is not; no number at a pole, or where e
/// ends to have values. `size`: of e on the way, so that rounding next to an end is none.
double end_between(const SquaredSpeed& e, double reached, double beyond, double size) {
  constexpr int halvings = 200;
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

/// Where e is largest (sign 1) or smallest (-1) within a step of x.
double extreme_near(const SquaredSpeed& e, double x, double step, double sign) {
  constexpr int halvings = 60;
  double low = x - step, high = x + step;
  for (int i = 0; i < halvings; ++i) {
    const double third = (high - low) / 3;
    if (sign * e.at(low + third) < sign * e.at(high - third))
      low += third;
    else
      high -= third;
  }
  return (low + high) / 2;
}

/// Whether e grows without bound where it is largest: no motion passes a pole.
bool has_pole(const SquaredSpeed& e, double from, double to) {
  constexpr double without_bound = 1e6;
  const double step = (to - from) / pieces;
  double place = from + step, largest = 0;
  for (int i = 1; i < pieces; ++i) {
    const double x = from + i * step;
    if (!(e.at(x) <= largest)) std::tie(place, largest) = std::pair(x, e.at(x));
  }
  return !(e.at(extreme_near(e, place, step, 1)) < without_bound * largest);
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
  const int parts = e.start ? pieces : 2 * pieces;  // of all motions, few are looked at
  return compared(way_between(e, from, to, parts), way_between(e, from, to, 2 * parts), period);
}

/// Or at an end.
bool is_between(double x, double low, double high) {
  const double slack = 1e-6 * (1 + std::abs(x));
  return low - slack <= x && x <= high + slack;
}

}  // namespace

namespace {

/// Of the motion that has e > 0 at the places from `first` to before `next`.
Likeness compared_within(const SquaredSpeed& e, const std::vector<double>& places, std::size_t first,
                         std::size_t next, double period) {
  double size = 0;
  for (std::size_t i = first; i < next; ++i) size = std::max(size, e.at(places[i]));
  const double from = first > 0 ? end_between(e, places[first], places[first - 1], size) : e.below;
  const double to = next < places.size() ? end_between(e, places[next - 1], places[next], size) : e.above;
  const double low = std::isfinite(from) ? from : places[first];
  const double high = std::isfinite(to) ? to : places[next - 1];
  if (e.start && !is_between(*e.start, low, high)) return Likeness::unknown;
  return compared(e, from, to, period);
}

bool may_swing_from_start(const SquaredSpeed& e, const std::vector<double>& places, double period) {
  const auto start = std::ranges::lower_bound(places, *e.start);
  auto first = static_cast<std::size_t>(start - places.begin()), next = first;
  while (first > 0 && moves(e.at(places[first - 1]))) --first;
  while (next < places.size() && moves(e.at(places[next]))) ++next;
  return first == next || compared_within(e, places, first, next, period) != Likeness::other;
}

}  // namespace

bool may_swing_with(const SquaredSpeed& e, double period) {
  const std::vector<double> places = looked_at(e);
  if (e.start) return may_swing_from_start(e, places, period);
  bool is_another = false;
  for (std::size_t first = 0; first < places.size(); ++first) {
    std::size_t next = first;
    while (next < places.size() && moves(e.at(places[next]))) ++next;
    if (next == first) continue;
    const Likeness verdict = compared_within(e, places, first, next, period);
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

bool may_come(const SquaredSpeed& e, double from, double to) {
  constexpr double near = 1e-9;
  if (std::abs(to - from) <= near * std::abs(from)) return true;
  const double step = (to - from) / pieces;
  std::vector<double> seen;
  for (int i = 1; i < pieces; ++i) {
    seen.push_back(e.at(from + i * step));
    if (!moves(seen.back())) return false;
  }
  for (std::size_t i = 1; i + 1 < seen.size(); ++i) {
    const bool is_low = seen[i] < seen[i - 1] && seen[i] <= seen[i + 1];
    const double x = from + static_cast<double>(i + 1) * step;
    if (is_low && !moves(e.at(extreme_near(e, x, step, -1)))) return false;
  }
  return !has_pole(e, from, to);
}

Rooms rooms_between(const SquaredSpeed& e, double from, double to) {
  constexpr double margin = 0.2;
  Rooms least;
  double largest = 0;
  for (int i = 1; i < pieces; ++i) {
    const double u = static_cast<double>(i) / pieces, room = e.at(from + u * (to - from)) / (u * (1 - u));
    least.on_the_way = std::min(least.on_the_way, room);
    if (u > margin && u < 1 - margin) least.in_the_middle = std::min(least.in_the_middle, room);
    largest = std::max(largest, room);
  }
  return largest > 0 ? Rooms{least.on_the_way / largest, least.in_the_middle / largest} : Rooms{};
}

}  // namespace qdot
