#include "core/motion/kink_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace qdot {
namespace {

constexpr std::size_t most_at_once = 4;  ///< kinks, whose combinations are tried
constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();
constexpr double far = 1e-6;  ///< of the numbers that make it up: no rounding error of u
constexpr double some_instants = 16;
constexpr double same_rates = 1e-9;  ///< of two ways that are one
constexpr double full_side = 1 + 1e-12;

double norm(std::span<const double> gradient) {
  double sum = 0;
  for (const double x : gradient) sum += x * x;
  return sum;
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// y -= u gradient / |gradient|^2; one component of it exactly.
void move_by(double u, std::span<const double> gradient, std::span<double> y) {
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (gradient[i] != 0) y[i] -= u * gradient[i] / norm(gradient);
  }
}

}  // namespace

KinkModes::KinkModes(const Dynamics& dynamics, std::span<const double> parameters, double resolution)
    : motions_(dynamics, parameters, resolution) {}

/// The sides of those that are not active; what stands in a kink's u are sides of kinks before it.
Sides KinkModes::completed(Sides sides, double t, std::span<const double> y) {
  const std::size_t row = 2 + y.size();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (std::ranges::find(active_, k) != active_.end()) continue;
    if (typed_sides_[k] != 0) {
      sides[k] = typed_sides_[k];
      continue;
    }
    sides[k] = motions_.geometry(sides, t, y)[k * row] < 0 ? -1 : 1;
  }
  return sides;
}

Sides KinkModes::sides_at(double t, std::span<const double> y) {
  active_.clear();
  typed_sides_.assign(motions_.kinks(), 0);
  return completed(Sides(motions_.kinks(), 1), t, y);
}

std::optional<KinkModes::Way> KinkModes::way_on(double t, std::span<const double> y,
                                                const std::vector<bool>& met) {
  Sides sides = sides_at(t, y);
  const auto& typed = begun_ = std::exchange(typed_, std::nullopt);
  const std::vector<double> places = motions_.geometry(sides, t, y);
  const std::size_t row = 2 + y.size();
  std::vector<double> sizes;
  bool needs_digits = false;
  for (std::size_t k = 0; k < motions_.kinks(); ++k) {
    const std::span<const double> of_kink(places.data() + k * row, row);
    double size = std::abs(of_kink[1] * t);
    for (std::size_t i = 0; i < y.size(); ++i) size += std::abs(of_kink[2 + i] * y[i]);
    sizes.push_back(size);
    if (typed) typed_sides_[k] = motions_.argument_sign(k, sides, *typed);
    if (typed_sides_[k] != 0) sides[k] = typed_sides_[k];
    const double zero = met[k] ? std::max(far * size, far) : round_off * size;
    const bool is_at_zero = std::abs(of_kink[0]) <= zero || (met[k] && passes_now(sides, k, t, y));
    if (!is_at_zero && motions_.is_told(sides, k, t, y)) continue;
    if (typed_sides_[k] == 0) active_.push_back(k);
    needs_digits = needs_digits || typed_sides_[k] != 0;
  }
  Way way{sides, std::vector<unsigned>(sides.size()), sizes, {}, needs_digits};
  if (active_.empty()) return way;
  if (active_.size() > most_at_once) return std::nullopt;
  motions_.look_from(t, y);
  const std::optional<Sides> only = only_way();
  if (!only) return std::nullopt;
  way.sides = *only;
  for (const std::size_t k : active_) {
    const std::optional<Lead> first = way.sides[k] == 0 ? std::nullopt : lead(way.sides, k);
    const bool leaves = first && first->sign != 0;
    if (leaves) way.contact[k] = first->power;
    const bool is_slow = !leaves || first->power > 1;
    if (is_slow && motions_.is_gradient_told(way.sides, k)) way.begins.push_back(k);
  }
  return way;
}

/// Within what rounds the time: of a fast motion u is not small there.
bool KinkModes::passes_now(const Sides& sides, std::size_t kink, double t, std::span<const double> y) {
  motions_.look_from(t, y);
  const SidedMotions::Series& series = motions_.series(sides);
  if (!series) return false;
  const std::vector<double>& u = (*series)[kink];
  return std::abs(u[0]) <= some_instants * motions_.resolution() * std::abs(u[1]);
}

std::vector<double> KinkModes::doubt_of_begin(const Way& way) {
  std::vector<double> off;
  for (const std::size_t k : active_) {
    if (way.sides[k] != 0 && !motions_.is_slope_told(way.sides, k))
      add_doubt(way.sides, k, motions_.told_after(way.sides, k, begun_), off);
  }
  return off;
}

std::vector<double> KinkModes::doubt_behind(const Sides& sides, std::size_t kink, double hidden, double t,
                                            std::span<const double> y) {
  motions_.look_from(t, y);
  std::vector<double> off;
  add_doubt(sides, kink, motions_.time_elsewhere(sides, kink, hidden), off);
  return off;
}

/// What the forces of the kink's other side make in that time, where it is more than an instant.
void KinkModes::add_doubt(const Sides& sides, std::size_t kink, double late, std::vector<double>& off) {
  Sides others = sides;
  others[kink] = -others[kink];
  if (!(late > motions_.resolution()) || !motions_.series(sides) || !motions_.series(others)) return;
  const std::size_t n = motions_.y().size() / 2;
  off.resize(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const double of_velocity = late * std::abs(motions_.rate(sides, n + i) - motions_.rate(others, n + i));
    off[n + i] += of_velocity;
    off[i] += late * of_velocity;
  }
}

void KinkModes::settle(const Way& way, double t, std::vector<double>& y) {
  for (const std::size_t k : way.begins) put_on(k, way.sides, t, y);
}

/// All combinations for the active kinks.
std::optional<Sides> KinkModes::only_way() {
  std::vector<Sides> found;
  std::size_t count = 1;
  for (std::size_t i = 0; i < active_.size(); ++i) count *= 3;
  for (std::size_t number = 0; number < count; ++number) {
    Sides sides(motions_.kinks(), 1);
    for (std::size_t i = 0, rest = number; i < active_.size(); ++i, rest /= 3) {
      sides[active_[i]] = 1 - static_cast<int>(rest % 3);
    }
    sides = completed(sides, motions_.t(), motions_.y());
    const Verdict verdict = judge(sides);
    if (verdict == Verdict::yes) found.insert(found.begin(), sides);
    if (verdict == Verdict::neutral) found.push_back(sides);
  }
  if (found.empty()) return std::nullopt;
  const bool is_one = std::ranges::all_of(found, [&](const Sides& s) { return is_same_motion(found[0], s); });
  return is_one ? std::optional(found.front()) : std::nullopt;
}

KinkModes::Verdict KinkModes::judge(const Sides& sides) {
  if (!motions_.series(sides)) return Verdict::no;
  Verdict verdict = Verdict::yes;
  for (const std::size_t k : active_) {
    if (sides[k] == 0) {
      if (!(std::abs(motions_.equivalent_side(sides, k)) <= full_side) || !attracts(sides, k))
        return Verdict::no;
      continue;
    }
    const std::optional<Lead> first = lead(sides, k);
    if (!first || first->sign == -sides[k]) return Verdict::no;
    if (first->sign == 0) verdict = Verdict::neutral;
  }
  return verdict;
}

bool KinkModes::attracts(Sides sides, std::size_t kink) {
  sides[kink] = 1;
  const std::optional<Lead> above = lead(sides, kink);
  sides[kink] = -1;
  const std::optional<Lead> below = lead(sides, kink);
  return above && below && above->sign < 0 && below->sign > 0;
}

/// The coefficient that rules when time first can be told apart.
std::optional<KinkModes::Lead> KinkModes::lead(const Sides& sides, std::size_t kink) {
  if (!motions_.series(sides)) return std::nullopt;
  const std::vector<double> told = motions_.told_series(sides, kink);
  Lead result;
  double largest = 0, power = motions_.resolution();
  for (unsigned k = 1; k <= SidedMotions::order; ++k, power *= motions_.resolution()) {
    const double c = told[k], size = std::abs(c) * power;
    if (std::isnan(c)) return std::nullopt;
    if (size > largest) {
      largest = size;
      result = {c > 0 ? 1 : -1, k};
    }
  }
  return result;
}

bool KinkModes::is_same_motion(const Sides& one, const Sides& other) {
  const std::vector<double>&a = motions_.rows(one), &b = motions_.rows(other);
  for (std::size_t i = 2; i < a.size(); ++i) {
    if (i % (SidedMotions::order + 1) < 2) continue;
    if (std::abs(a[i] - b[i]) > same_rates * std::max(std::abs(a[i]), std::abs(b[i]))) return false;
  }
  return true;
}

/// u = 0, without what is rounded inside of it, and where no velocity stands in u, u' = 0.
void KinkModes::put_on(std::size_t kink, const Sides& sides, double t, std::vector<double>& y) {
  const std::size_t n = y.size() / 2, row = 2 + 2 * n;
  for (int i = 0; i < 2; ++i) {
    const std::vector<double> places = motions_.geometry(sides, t, y);
    const std::span<const double> of_kink(places.data() + kink * row, row);
    const auto by_q = of_kink.subspan(2, n), by_v = of_kink.subspan(2 + n, n);
    const std::span<double> q(y.data(), n), v(y.data() + n, n);
    double size = std::abs(of_kink[1] * t);
    for (std::size_t k = 0; k < 2 * n; ++k) size += std::abs(of_kink[2 + k] * y[k]);
    const double u =
        std::abs(of_kink[0]) > round_off * size ? motions_.exact_argument(kink, sides, t, y) : of_kink[0];
    if (norm(by_v) > 0) {
      move_by(u, by_v, v);
    } else if (norm(by_q) > 0) {
      move_by(u, by_q, q);
      move_by(of_kink[1] + dot(by_q, v), by_q, v);
    }
  }
}

}  // namespace qdot
