#include "core/turning/enclosed_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_looks = 2000;
/// A least value is known well enough within this much of the largest one seen.
constexpr double fine_enough = 0x1p-40;
constexpr double quarter_turn = 0x1.921fb54442d19p-1;  ///< just above pi/4

template <class T>
T fixed(const Interval& value);
template <>
Interval fixed<Interval>(const Interval& value) {
  return value;
}
template <>
Curvature fixed<Curvature>(const Interval& value) {
  return Curvature::constant(value);
}

bool solves_equations(const CompiledFunction& function) {
  return std::ranges::any_of(function.instructions(),
                             [](const Instruction& i) { return i.operation == Operation::solve; });
}

/// a x = b by elimination without pivots: a is near a positive definite matrix. The solution to b.
template <class T>
void solve(std::vector<T>& a, std::vector<T>& b) {
  const std::size_t n = b.size();
  const auto minus = [](const T& x, const T& y) { return x + fixed<T>(-1) * y; };
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const T factor = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k; j < n; ++j) a[i * n + j] = minus(a[i * n + j], factor * a[k * n + j]);
      b[i] = minus(b[i], factor * b[k]);
    }
  }
  for (std::size_t k = 0; k < n; ++k) b[k] = b[k] / a[k * n + k];
}

}  // namespace

/// The functions in one arithmetic, at x and x'.
template <class T>
class EnclosedMotion::Values {
 public:
  Values(const CompiledFunction& values, const CompiledFunction& momentum_function,
         const Reduction& reduction, const Reals& parameters, std::span<const Ball> momenta, const Reals& y0)
      : reduction_(reduction), out_(values.outputs()) {
    std::vector<T> constants;
    for (const Interval& c : parameters.as<Interval>()) constants.push_back(fixed<T>(c));
    values_.emplace(values, constants);
    if (!momenta.empty()) rates_.emplace(momentum_function, constants);
    for (const Ball& p : momenta) momenta_.push_back(fixed<T>(p.interval()));
    for (const Interval& y : y0.as<Interval>()) y_.push_back(fixed<T>(y));
  }

  T at(const T& x, const T& x_dot, std::size_t index) {
    const std::size_t n = y_.size() / 2;
    y_[reduction_.kept[0]] = x;
    y_[n + reduction_.kept[0]] = x_dot;
    if (rates_) solve_rates();
    (*values_)(y_, out_);
    return out_[index];
  }

 private:
  void solve_rates() {
    const std::size_t n = y_.size() / 2, count = momenta_.size();
    const auto momenta_at = [&](std::size_t one) {
      for (std::size_t k = 0; k < count; ++k) y_[n + reduction_.ignored[k]] = fixed<T>(k == one ? 1 : 0);
      std::vector<T> p(count);
      (*rates_)(y_, p);
      return p;
    };
    const std::vector<T> base = momenta_at(count);
    std::vector<T> matrix(count * count), rest;
    for (std::size_t k = 0; k < count; ++k) {
      const std::vector<T> column = momenta_at(k);
      for (std::size_t i = 0; i < count; ++i) matrix[i * count + k] = column[i] + fixed<T>(-1) * base[i];
    }
    for (std::size_t i = 0; i < count; ++i) rest.push_back(momenta_[i] + fixed<T>(-1) * base[i]);
    solve(matrix, rest);
    for (std::size_t k = 0; k < count; ++k) y_[n + reduction_.ignored[k]] = rest[k];
  }

  const Reduction& reduction_;
  std::optional<TapeEvaluator<T>> values_, rates_;
  std::vector<T> momenta_, y_, out_;
};

/// A value all over a piece, and at one place of it.
struct EnclosedMotion::Seen {
  Piece piece;
  Interval over, there;
  double x{}, x_dot{};
};

EnclosedMotion::EnclosedMotion(EnergyBalance& energy, const PeriodicWay& way, const CompiledFunction& values,
                               const Dynamics& dynamics, const Reduction& reduction, const Reals& parameters,
                               std::span<const Ball> momenta, const Reals& y0)
    : energy_(energy), way_(way) {
  const auto momentum_function = dynamics.columns(momentum_columns(dynamics.model(), reduction.ignored));
  if (solves_equations(values) || solves_equations(*momentum_function)) return;
  plain_ = std::make_unique<Values<Interval>>(values, *momentum_function, reduction, parameters, momenta, y0);
  curved_ =
      std::make_unique<Values<Curvature>>(values, *momentum_function, reduction, parameters, momenta, y0);
  momentum_function_ = momentum_function;
}

EnclosedMotion::~EnclosedMotion() = default;

std::vector<EnclosedMotion::Piece> EnclosedMotion::whole_way() const {
  if (!way_.turns_back) return {{hull(way_.from, way_.to), false, way_.direction}};
  const Interval half(0, quarter_turn);
  return {{half, false, 1}, {half, false, -1}, {half, true, 1}, {half, true, -1}};
}

std::vector<EnclosedMotion::Piece> EnclosedMotion::halves(const Piece& piece) {
  const double middle = piece.s.middle();
  if (!(piece.s.lower < middle && middle < piece.s.upper)) return {};
  Piece left = piece, right = piece;
  left.s.upper = right.s.lower = middle;
  return {left, right};
}

/// To second order where the velocity is smooth; else by F = -(x - a) U[a, x] with a the end.
EnclosedMotion::Seen EnclosedMotion::look(const Piece& piece, std::size_t index) {
  const auto velocity = [&](const Interval& squared) {
    const Interval real(std::max(0.0, squared.lower), std::max(0.0, squared.upper));
    return Interval(piece.direction) * sqrt(real);
  };
  const Interval end = piece.from_far_end ? way_.to : way_.from;
  const Interval span = piece.from_far_end ? way_.from - way_.to : way_.to - way_.from;
  const auto place = [&](const Interval& s) {
    if (!way_.turns_back) return s;
    return intersection(end + span * square(sin(s)), hull(way_.from, way_.to));
  };
  const auto plain_at = [&](const Interval& s) {
    const Interval x = place(s);
    const Interval remaining = energy_.remaining(x);
    const Interval from_end = -(span * square(sin(s))) * energy_.potential_slope(end, x);
    const Interval known = way_.turns_back ? intersection(remaining, from_end) : remaining;
    const Interval x_dot = velocity(Interval(2) * (is_empty(known) ? remaining : known) / energy_.inertia(x));
    return std::pair(x, x_dot);
  };
  const Interval somewhere(piece.s.lower == 0 && way_.turns_back ? 0 : piece.s.middle());
  const auto [x, x_dot] = plain_at(somewhere);
  Seen seen{piece, Interval::whole(), plain_->at(x, x_dot, index), x.middle(), x_dot.middle()};
  const Curvature s = Curvature::variable(somewhere, piece.s);
  Curvature path = s;
  if (way_.turns_back) {
    path = Curvature::constant(end) + Curvature::constant(span) * square(qdot::sin(s));
    path.over[0] = intersection(path.over[0], hull(way_.from, way_.to));
  }
  const CurvedEnergy energy = energy_.along(path);
  if (energy.remaining.over[0].lower > 0) {
    const Curvature rate =
        Curvature::literal(piece.direction) * sqrt(Curvature::literal(2) * energy.remaining / energy.inertia);
    seen.over = curved_->at(path, rate, index).over[0];
  }
  if (!seen.over.is_finite()) {
    const auto [wide_x, wide_rate] = plain_at(piece.s);
    seen.over = plain_->at(wide_x, wide_rate, index);
  }
  return seen;
}

std::optional<LeastValue> EnclosedMotion::least(std::size_t index) {
  if (!plain_) return std::nullopt;
  const auto later = [](const Seen& a, const Seen& b) { return a.over.lower > b.over.lower; };
  std::vector<Seen> open;
  std::optional<Seen> best;
  double scale = 0;
  const auto add_all = [&](const std::vector<Piece>& pieces) {
    for (const Piece& piece : pieces) {
      Seen seen = look(piece, index);
      if (std::isfinite(seen.there.magnitude())) scale = std::max(scale, seen.there.magnitude());
      if (!best || seen.there.upper < best->there.upper) best = seen;
      open.push_back(std::move(seen));
      std::ranges::push_heap(open, later);
    }
  };
  add_all(whole_way());
  for (std::size_t looks = 0; looks < most_looks; ++looks) {
    const Seen first = open.front();
    if (best->there.upper - first.over.lower <= fine_enough * scale) break;
    const std::vector<Piece> parts = halves(first.piece);
    if (parts.empty()) break;
    std::ranges::pop_heap(open, later);
    open.pop_back();
    add_all(parts);
  }
  const Interval range(open.front().over.lower, best->there.upper);
  if (!range.is_finite()) return std::nullopt;
  return LeastValue{best->there.middle(), range, best->x, best->x_dot};
}

Vanishes EnclosedMotion::vanishes(std::size_t index) {
  if (!plain_) return Vanishes::undecided;
  std::vector<Piece> open = whole_way();
  int sign = 0;
  for (std::size_t looks = 0; !open.empty(); ++looks) {
    const Piece piece = open.back();
    open.pop_back();
    const Seen seen = look(piece, index);
    const int here = (seen.there.lower > 0) - (seen.there.upper < 0);
    if (here * sign < 0) return Vanishes::changes_sign;
    if (here != 0) sign = here;
    if (seen.over.lower > 0 || seen.over.upper < 0) continue;
    const std::vector<Piece> parts = halves(piece);
    if (parts.empty() || looks >= most_looks) return Vanishes::undecided;
    open.insert(open.end(), parts.begin(), parts.end());
  }
  return Vanishes::never;
}

}  // namespace qdot
