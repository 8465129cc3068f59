#include "core/closed/rough_period.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
  for (int k = -200; k <= 200; ++k) add(k / 10.0 + 1e-3);
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

double turn(const SquaredSpeed& e, int parts) {
  double sum = 0;
  for (int i = 0; i < parts; ++i) sum += 1 / std::sqrt(e.at(2 * pi * i / parts));
  return 2 * pi / parts * sum;
}

/// Undecided where the integral does not settle.
bool agree(double first, double finer, double period) {
  if (!(std::abs(first - finer) <= 0.1 * rough * std::abs(finer))) return true;
  return std::abs(finer - period) <= rough * std::abs(finer);
}

bool agree(const SquaredSpeed& e, double from, double to, double period) {
  return agree(way_between(e, from, to, pieces), way_between(e, from, to, 2 * pieces), period);
}

}  // namespace

bool may_swing_with(const SquaredSpeed& e, double period) {
  const std::vector<double> places = looked_at(e);
  bool is_there = false;
  for (std::size_t first = 0; first < places.size(); ++first) {
    std::size_t next = first;
    while (next < places.size() && moves(e.at(places[next]))) ++next;
    if (next == first) continue;
    is_there = true;
    const double from = first > 0 ? end_between(e, places[first], places[first - 1]) : e.below;
    const double to = next < places.size() ? end_between(e, places[next - 1], places[next]) : e.above;
    if (std::isfinite(from) && std::isfinite(to) && agree(e, from, to, period)) return true;
    first = next;
  }
  return !is_there;
}

bool may_turn_with(const SquaredSpeed& e, double period) {
  for (int i = 0; i < pieces; ++i) {
    if (!moves(e.at(2 * pi * i / pieces))) return true;
  }
  return agree(turn(e, pieces), turn(e, 2 * pieces), period);
}

}  // namespace qdot
