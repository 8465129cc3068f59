#include "core/closed/rough_period.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
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

std::span<const double> looked_at(const SquaredSpeed& e) {
  static const std::vector<double> all = places_to_look_at();
  const auto first = std::ranges::upper_bound(all, e.below);
  return {first, std::max(first, std::ranges::lower_bound(all, e.above))};
}

bool moves(double squared_speed) { return squared_speed > 0 && std::isfinite(squared_speed); }

/// The last place that is reached before one that is not.
double end_between(const SquaredSpeed& e, double reached, double beyond) {
  constexpr int halvings = 200;
  for (int i = 0; i < halvings; ++i) {
    const double middle = reached + (beyond - reached) / 2;
    if (middle == reached || middle == beyond) break;
    (moves(e.at(middle)) ? reached : beyond) = middle;
  }
  return reached;
}

/// Whether e becomes 0 there, and no pole is there or an end of its values. `size`: of e on the way, so that
/// rounding next to an end is none.
bool turns_at(const SquaredSpeed& e, double end, double size) { return std::abs(e.at(end)) < rough * size; }

/// Sines and cosines of pi ((i + 1/2)/n - 1/2).
struct Angles {
  explicit Angles(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const double u = pi * ((static_cast<double>(i) + 0.5) / static_cast<double>(n) - 0.5);
      sines.push_back(evaluate(Function::sin, u));
      cosines.push_back(evaluate(Function::cos, u));
    }
  }
  std::vector<double> sines, cosines;
};

/// The period by more and more places, each time three times as many: those there were are among them.
class WayBetween {
 public:
  WayBetween(const SquaredSpeed& e, double from, double to)
      : e_(e), middle_((from + to) / 2), half_((to - from) / 2) {
    for (std::size_t i = 0; i < parts_; ++i) add(i);
  }

  void refine() {
    parts_ *= 3;
    for (std::size_t i = 0; i < parts_; ++i)
      if (i % 3 != 1) add(i);
  }
  [[nodiscard]] std::size_t parts() const { return parts_; }
  [[nodiscard]] double value() const { return 2 * pi / static_cast<double>(parts_) * sum_; }

  static constexpr std::size_t most = 729;

 private:
  void add(std::size_t i) {
    static const Angles angles(most);
    const std::size_t each = most / parts_, k = i * each + each / 2;
    sum_ += half_ * angles.cosines[k] / std::sqrt(e_.at(middle_ + half_ * angles.sines[k]));
  }

  const SquaredSpeed& e_;
  double middle_, half_, sum_{};
  std::size_t parts_{27};
};

/// e at the places that part a way into equal pieces.
struct Way {
  double from{}, step{};
  std::vector<double> seen;

  [[nodiscard]] double place(std::size_t i) const { return from + static_cast<double>(i + 1) * step; }
};

/// To the first place where `goes_on` does not hold of e.
template <class GoesOn>
Way looked_along(const SquaredSpeed& e, double from, double to, GoesOn goes_on) {
  Way way{from, (to - from) / pieces, {}};
  way.seen.reserve(pieces);
  for (std::size_t i = 0; i + 1 < pieces; i += 2) {
    for (const double each : e.at_both(way.place(i), way.place(i + 1))) {
      if (way.seen.size() + 1 == pieces) break;
      way.seen.push_back(each);
      if (!goes_on(each)) return way;
    }
  }
  return way;
}

/// e where it is largest (sign 1) or smallest (-1) within a step of x, to some digits: around a pole, or
/// where it falls below zero, it is flat nowhere.
double extreme_near(const SquaredSpeed& e, double x, double step, double sign) {
  constexpr int halvings = 60;
  constexpr double flat = 1e-5;
  double low = x - step, high = x + step;
  for (int i = 0; i < halvings; ++i) {
    const double third = (high - low) / 3;
    const auto [left, right] = e.at_both(low + third, high - third);
    const double least = flat * std::abs(left);
    if (std::abs(left - right) <= least && std::abs(e.at((low + high) / 2) - left) <= least) break;
    if (sign * left < sign * right)
      low += third;
    else
      high -= third;
  }
  return e.at((low + high) / 2);
}

/// Whether e grows without bound where it is largest, next to what it is a step before or after: the largest
/// may be seen at the pole itself.
bool has_pole(const SquaredSpeed& e, const Way& way) {
  constexpr double without_bound = 1e6;
  if (!e.may_have_poles) return false;
  std::size_t top = 0;
  for (std::size_t i = 0; i < way.seen.size(); ++i) {
    if (!(way.seen[i] <= way.seen[top])) top = i;
  }
  double usual = top > 0 ? way.seen[top - 1] : 0;
  if (top + 1 < way.seen.size()) usual = std::max(usual, way.seen[top + 1]);
  return !(extreme_near(e, way.place(top), way.step, 1) < without_bound * usual);
}

bool meets_barrier(const SquaredSpeed& e, double from, double to) {
  return e.meets_barrier && e.meets_barrier(from, to, pieces);
}

bool has_pole(const SquaredSpeed& e, double from, double to) {
  return e.may_have_poles && has_pole(e, looked_along(e, from, to, [](double) { return true; }));
}

double turn(const SquaredSpeed& e, int parts) {
  double sum = 0;
  for (int i = 0; i < parts; ++i) sum += 1 / std::sqrt(e.at(2 * pi * i / parts));
  return 2 * pi / parts * sum;
}

enum class Likeness { same, other, unknown };

bool settles(double first, double finer, double slack) {
  return std::abs(first - finer) <= slack * std::abs(finer);
}

/// Unknown where the integral does not settle, or between the ends something hides at which nothing moves.
Likeness compared(double first, double finer, double period) {
  if (!settles(first, finer, 0.1 * rough)) return Likeness::unknown;
  return std::abs(finer - period) <= rough * std::abs(finer) ? Likeness::same : Likeness::other;
}

/// With fewer places where they tell more digits than are asked for.
Likeness compared(const SquaredSpeed& e, double from, double to, double period) {
  constexpr double sharp = 1e-8;
  if (!std::isfinite(from) || !std::isfinite(to) || has_pole(e, from, to) || meets_barrier(e, from, to))
    return Likeness::other;
  const std::size_t most = WayBetween::most / (e.start ? 3 : 1);  // of all motions, few are looked at
  WayBetween way(e, from, to);
  double first = 0;
  do {
    first = way.value();
    way.refine();
  } while (way.parts() < most && !settles(first, way.value(), sharp));
  return compared(first, way.value(), period);
}

/// Or at an end.
bool is_between(double x, double low, double high) {
  const double slack = 1e-6 * (1 + std::abs(x));
  return low - slack <= x && x <= high + slack;
}

}  // namespace

namespace {

/// Whether e falls to zero between places at which it does not, beside one where it is least: a hill that is
/// narrower than they lie apart.
bool hides_stop(const SquaredSpeed& e, std::span<const double> places) {
  std::vector<double> seen;
  for (const double x : places) seen.push_back(e.at(x));
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    if (seen[i] > seen[i - 1] || seen[i] > seen[i + 1]) continue;
    const double step = std::max(places[i] - places[i - 1], places[i + 1] - places[i]);
    if (!moves(extreme_near(e, places[i], step, -1))) return true;
  }
  return false;
}

/// Of the motion that has e > 0 at the places from `first` to before `next`.
Likeness compared_within(const SquaredSpeed& e, std::span<const double> places, std::size_t first,
                         std::size_t next, double period) {
  double size = 0;
  for (std::size_t i = first; i < next; ++i) size = std::max(size, e.at(places[i]));
  const bool is_open_below = first == 0, is_open_above = next == places.size();
  const double from = is_open_below ? e.below : end_between(e, places[first], places[first - 1]);
  const double to = is_open_above ? e.above : end_between(e, places[next - 1], places[next]);
  const double low = std::isfinite(from) ? from : places[first];
  const double high = std::isfinite(to) ? to : places[next - 1];
  if (e.start && !is_between(*e.start, low, high)) return Likeness::unknown;
  if (hides_stop(e, places.subspan(first, next - first))) return Likeness::unknown;
  size = std::max(size, e.at((low + high) / 2));  // the only place that was looked at may be an end
  if (!(is_open_below || turns_at(e, from, size)) || !(is_open_above || turns_at(e, to, size)))
    return Likeness::other;
  return compared(e, from, to, period);
}

bool may_swing_from_start(const SquaredSpeed& e, std::span<const double> places, double period) {
  const auto start = std::ranges::lower_bound(places, *e.start);
  auto first = static_cast<std::size_t>(start - places.begin()), next = first;
  while (first > 0 && moves(e.at(places[first - 1]))) --first;
  while (next < places.size() && moves(e.at(places[next]))) ++next;
  return first == next || compared_within(e, places, first, next, period) != Likeness::other;
}

}  // namespace

bool may_swing_with(const SquaredSpeed& e, double period) {
  const std::span<const double> places = looked_at(e);
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

namespace {

bool stops_between(const SquaredSpeed& e, const Way& way) {
  for (std::size_t i = 1; i + 1 < way.seen.size(); ++i) {
    const bool is_low = way.seen[i] < way.seen[i - 1] && way.seen[i] <= way.seen[i + 1];
    if (is_low && !moves(extreme_near(e, way.place(i), way.step, -1))) return true;
  }
  return false;
}

Rooms rooms_of(const Way& way) {
  constexpr double margin = 0.2;
  Rooms least;
  double largest = 0;
  for (std::size_t i = 0; i < way.seen.size(); ++i) {
    const double u = static_cast<double>(i + 1) / pieces, room = way.seen[i] / (u * (1 - u));
    least.on_the_way = std::min(least.on_the_way, room);
    if (u > margin && u < 1 - margin) least.in_the_middle = std::min(least.in_the_middle, room);
    largest = std::max(largest, room);
  }
  return {least.on_the_way / largest, least.in_the_middle / largest};
}

}  // namespace

std::optional<Rooms> room_to_come(const SquaredSpeed& e, double from, double to) {
  constexpr double near = 1e-9;
  if (std::abs(to - from) <= near * std::abs(from)) return Rooms{};
  const Way way = looked_along(e, from, to, moves);
  if (!moves(way.seen.back()) || stops_between(e, way) || has_pole(e, way) || meets_barrier(e, from, to))
    return std::nullopt;
  return rooms_of(way);
}

}  // namespace qdot
