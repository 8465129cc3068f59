// What each instruction adds to the distance of a row from what it stands for.
//
// Functions by a differential equation w' = f(w) d, d the rate of the argument u: a residual of the rows of
// order N - 1 and more grows over the step to no more than h/N times its bound, since it starts as s^(N-1).

#include <algorithm>
#include <cmath>

#include "core/compile/taylor/remainder.hpp"

namespace qdot::taylor {
namespace {

// Bounds are computed in double; this is far more than their own rounding.
constexpr double slack = 1 + 1e-9;
constexpr double smallest_exponential = 1e-322;  ///< what is less may have become 0
constexpr double rounding_of_one = 1.2e-16;      ///< z of a tanh that has become 1
constexpr double near_zero = 0x1p-20;            ///< of the terms of what is divided by

/// For what a function of a bound is rounded.
Range widened(const Range& a) {
  return range(a.lower < 0 ? a.lower * slack : a.lower / slack,
               a.upper < 0 ? a.upper / slack : a.upper * slack);
}

double exponential(double x) { return evaluate(Function::exp, x); }

/// x^p for x > 0.
double positive_power(double x, double p) { return exponential(p * evaluate(Function::log, x)); }

/// u^p where u > 0.
Range power(const Range& u, double p) {
  const double one = positive_power(u.lower, p), other = positive_power(u.upper, p);
  return range(std::min(one, other) / slack, std::max(one, other) * slack);
}

}  // namespace

bool Remainder::is_without_value() const {
  return std::ranges::any_of(rules_, [this](const Rule& rule) {
    const bool is_partial = rule.kind == Kind::root || rule.kind == Kind::logarithm ||
                            (rule.kind == Kind::power && *rule.constant != std::floor(*rule.constant));
    return is_partial && rows_[rule.x].of_value.upper < 0;
  });
}

void Remainder::conclude(Row& row, double r) const {
  row.r = std::isnan(r) ? infinity : r * slack;
  row.of_value = range(row.of_row.lower - row.r, row.of_row.upper + row.r);
}

/// The value is also where the interval operation has it.
void Remainder::meet(Row& row, const Range& by_operation) const {
  const Range both = range(std::max(row.of_value.lower, by_operation.lower),
                           std::min(row.of_value.upper, by_operation.upper));
  row.of_value = both;
  const double distance = std::max(both.upper - row.of_row.lower, row.of_row.upper - both.lower);
  if (distance < row.r) row.r = distance;
}

/// From -1e20 to 0 is rounded by more than an exponential lets pass.
Range Remainder::argument(const Rule& rule) const {
  const Row& rate = rows_[rule.x];
  const Range moved = variation(rate);
  const double more = rate.argument_r + rounding_of_sums * (std::abs(*rule.argument) + h_ * rate.t0);
  const Range by_rate = range(*rule.argument + moved.lower - more, *rule.argument + moved.upper + more);
  return range(std::max(by_rate.lower, rate.of_argument.lower),
               std::min(by_rate.upper, rate.of_argument.upper));
}

void Remainder::apply(const Rule& rule) {
  switch (rule.kind) {
    case Kind::sum:
    case Kind::sum_1_0:
    case Kind::sum_2_0:
    case Kind::sum_0_1:
    case Kind::sum_1_1:
    case Kind::sum_2_1:
    case Kind::sum_3_1:
    case Kind::sum_0_2:
    case Kind::sum_1_2:
    case Kind::sum_2_2:
      return apply_sum(rule);
    case Kind::rate:
    case Kind::rate_of_sum:
      return apply_rate(rule);
    case Kind::quotient:
      return apply_quotient(rule);
    case Kind::power:
      return apply_power(rule);
    case Kind::root:
      return apply_root(rule);
    case Kind::sine_cosine:
      return apply_sine_cosine(rule);
    case Kind::exponential:
      return apply_exponential(rule);
    case Kind::logarithm:
      return apply_logarithm(rule);
    case Kind::tangent:
      return apply_tangent(rule);
    case Kind::hyperbolic:
      return apply_hyperbolic(rule);
    case Kind::absolute:
    case Kind::sign:
      return apply_kink(rule);
    case Kind::arc:
      return apply_arc(rule);
    case Kind::solve:
    case Kind::solve_2:
    case Kind::solve_3:
      return apply_solve(rule);
    case Kind::still:
      break;  // rules have the usual kind
  }
}

void Remainder::apply_sum(const Rule& rule) {
  double r = 0;
  for (const auto& [factor, x, unused] : rule.terms) {
    r += std::abs(factor) * (rows_[x].r + rows_[x].own_top);
  }
  for (const auto& [factor, x, y] : rule.products) {
    const Row &a = rows_[x], &b = rows_[y];
    const double of_b = b.of_row.magnitude();
    r += std::abs(factor) * (tail(a, b) + a.of_row.magnitude() * b.r + (of_b + b.r) * a.r);
  }
  Row& out = rows_[rule.out];
  conclude(out, r);
  if (effort_ != Effort::careful) return;
  RangeOfSum value(*rule.constant);
  for (const auto& [factor, x, unused] : rule.terms) value.add(factor * rows_[x].of_value);
  for (const auto& [factor, x, y] : rule.products) {
    const Row &a = rows_[x], &b = rows_[y];
    value.add(factor * (x == y ? square(a.of_value) : a.of_value * b.of_value));
  }
  meet(out, value.rounded_outwards());
}

/// The row of a rate belongs to the argument's polynomial: by how much does the argument depart from it?
void Remainder::apply_rate(const Rule& rule) {
  Row& out = rows_[rule.out];
  if (rule.kind == Kind::rate) {
    out.argument_r = rows_[rule.x].r + rows_[rule.x].own_top;
    out.of_argument = rows_[rule.x].of_value;
    return;
  }
  out.argument_r = 0;
  for (const auto& [factor, x, unused] : rule.terms) {
    out.argument_r += std::abs(factor) * (rows_[x].argument_r + h_ / order_ * size(rows_[x], order_ - 1));
  }
}

/// What rounding may hide of a product with what is divided by: nothing that counts unless that comes near to
/// zero. Then a row may belong to something else: 1 - s is the root of (1 - s)^2, and (1 - s)^2 + 1e-16
/// rounds to that.
double Remainder::hidden_by_rounding(const Row& divisor, double factor) const {
  const bool is_near = divisor.of_value.least_magnitude() < near_zero * divisor.t0;
  return is_near ? rounding_of_sums * divisor.t0 * factor : 0;
}

/// w = x/y: x - w_row y is what is left.
void Remainder::apply_quotient(const Rule& rule) {
  const Row &x = rows_[rule.x], &y = rows_[rule.y];
  Row& out = rows_[rule.out];
  const double left =
      tail(out, y) + x.own_top + x.r + out.of_row.magnitude() * y.r + hidden_by_rounding(y, out.t0);
  conclude(out, left / y.of_value.least_magnitude());
  if (effort_ == Effort::careful) meet(out, x.of_value / y.of_value);
}

/// w = u^p, by u w' = p u' w: (w u^-p)' is the residual over u^(p+1).
void Remainder::apply_power(const Rule& rule) {
  const Row& u = rows_[rule.x];
  Row& out = rows_[rule.out];
  const double p = *rule.constant;
  if (!(u.of_value.lower > 0)) return conclude(out, infinity);
  const Range values = power(u.of_value, p);
  const double residual = std::max(1.0, std::abs(p)) * (tail(u, out) + hidden_by_rounding(u, out.t0));
  const double slope = std::abs(p) * power(u.of_value, p - 1).upper;
  conclude(out, values.upper * residual / power(u.of_value, p + 1).lower + slope * u.r);
  if (effort_ == Effort::careful) meet(out, values);
}

/// z = sqrt(u): |u - p^2| = |z - p| (z + p) <= d. Where p may be as small as -z, continuity tells: |z - p|
/// begins with 0 and has (2 z - |z - p|) |z - p| <= d.
void Remainder::apply_root(const Rule& rule) {
  const Row& u = rows_[rule.x];
  Row& out = rows_[rule.out];
  const double d = u.r + u.own_top + tail(out, out) + hidden_by_rounding(u, 1);
  const double least = std::max(0.0, u.of_value.lower);
  double of_sum = 0;
  if (d <= least) of_sum = std::sqrt(least) + std::sqrt(least - d);
  if (out.of_row.lower > 0) of_sum = std::max(of_sum, std::sqrt(least) + out.of_row.lower);
  conclude(out, of_sum > 0 ? d / of_sum : infinity);
  if (effort_ == Effort::careful && u.of_value.lower >= 0) {
    meet(out, range(std::sqrt(u.of_value.lower) / slack, std::sqrt(u.of_value.upper) * slack));
  }
}

/// The residual turns (sin, cos), and does not grow.
void Remainder::apply_sine_cosine(const Rule& rule) {
  const Row& rate = rows_[rule.x];
  Row &sin = rows_[rule.out], &cos = rows_[rule.out2];
  const double r = rate.argument_r + h_ / order_ * (tail_of_rate(rate, sin) + tail_of_rate(rate, cos));
  conclude(sin, r);
  conclude(cos, r);
  if (effort_ != Effort::careful) return;
  meet(sin, sine(argument(rule), 0));
  meet(cos, sine(argument(rule), 1));
}

/// The residual grows as w does. What has become 0 by underflow grows too.
void Remainder::apply_exponential(const Rule& rule) {
  const Row& rate = rows_[rule.x];
  Row& out = rows_[rule.out];
  const Range moved = variation(rate);
  const double growth = exponential(moved.upper - moved.lower);
  const double most = exponential(moved.upper);
  const double start = out.coefficients[0] + smallest_exponential;
  double r = h_ / order_ * tail_of_rate(rate, out) * growth + most * smallest_exponential;
  if (rate.argument_r > 0) r += start * most * rate.argument_r * exponential(2 * rate.argument_r);
  conclude(out, r);
  if (effort_ == Effort::careful) {
    const Range value = rising(Function::exp, argument(rule));
    meet(out, range(value.lower / slack, value.upper * slack + smallest_exponential));
  }
}

/// z = log u, by u z' = u'.
void Remainder::apply_logarithm(const Rule& rule) {
  const Row& u = rows_[rule.x];
  Row& out = rows_[rule.out];
  if (!(u.of_value.lower > 0) || !(u.of_row.lower > 0)) return conclude(out, infinity);
  const double residual = tail(u, out) + u.own_top + hidden_by_rounding(u, out.t0);
  conclude(out, residual / u.of_row.lower + u.r / u.of_value.lower);
  if (effort_ == Effort::careful) meet(out, rising(Function::log, u.of_value));
}

/// z' = (1 + c z^2) d: with e = z - z_row, e' = c (z + z_row) d e + residual.
void Remainder::apply_tangent(const Rule& rule) {
  const Row &rate = rows_[rule.x], &square_row = rows_[rule.aux];
  Row& z = rows_[rule.out];
  const double moved = variation(rate).magnitude();
  double most = 1;  // of |z|
  if (*rule.constant > 0) {
    const Range u = argument(rule);
    const double quarter = std::floor(u.lower / pi + 0.5);
    const bool pole_inside = std::floor(u.upper / pi + 0.5) != quarter;
    const Range values = pole_inside ? Range{} : rising(Function::tan, u);
    most = values.magnitude();
  }
  const double growth = exponential((most + z.of_row.magnitude()) * rate.t0 * h_);
  const double residual = h_ / order_ * (tail_of_rate(rate, square_row) + rate.t0 * tail(z, z));
  const double slope = *rule.constant > 0 ? 1 + most * most : 1;
  // What has become 0 by underflow grows as 1/cosh^2 does.
  conclude(z, growth * (residual + smallest_exponential * moved) + slope * rate.argument_r);
  if (effort_ == Effort::careful && *rule.constant < 0) {
    const Range value = rising(Function::tanh, argument(rule));
    meet(z, range(value.lower - rounding_of_one, value.upper + rounding_of_one));
  }
}

void Remainder::apply_hyperbolic(const Rule& rule) {
  const Row& rate = rows_[rule.x];
  Row &out = rows_[rule.out], &other = rows_[rule.out2];
  const double growth = exponential(variation(rate).magnitude() + rate.argument_r);
  const double start = std::abs(out.coefficients[0]) + std::abs(other.coefficients[0]);
  const double r = growth * (h_ / order_ * (tail_of_rate(rate, out) + tail_of_rate(rate, other)) +
                             start * rate.argument_r);
  conclude(out, r);
  conclude(other, r);
  if (effort_ != Effort::careful) return;
  const Range u = argument(rule);
  const Range sinh = rising(Function::sinh, u);
  const Range cosh = range(evaluate(Function::cosh, u.least_magnitude()) / slack,
                           evaluate(Function::cosh, u.magnitude()) * slack);
  const bool is_cosh_first = *rule.constant > 0;
  meet(is_cosh_first ? out : other, cosh);
  meet(is_cosh_first ? other : out, widened(sinh));
}

/// w z' = c u', w = 1 + u^2 or sqrt(1 - u^2).
void Remainder::apply_arc(const Rule& rule) {
  const Row &rate = rows_[rule.x], &w = rows_[rule.y];
  Row& z = rows_[rule.out];
  double slope = 0;  // h max |z_row'|
  for (unsigned k = 1; k < order_; ++k) slope += k * size(z, k);
  const double residual = tail(w, z) + h_ / order_ * size(rate, order_ - 1) + w.r * slope;
  conclude(z, (residual + rate.argument_r) / w.of_value.least_magnitude());
}

/// With what x leaves zero at once it does not come back to: c_0 and c_1 have one sign and the rest is
/// smaller.
double Remainder::beyond_kink(const Row& x, double side) const {
  const double rise = side * x.coefficients[1] * h_;
  if (rise > x.t2 + x.r) return 0;
  return std::max(0.0, -(side > 0 ? x.of_value.lower : -x.of_value.upper));
}

/// |abs(x) - side x| is twice what x is beyond zero; sign has jumped by 2 there.
void Remainder::apply_kink(const Rule& rule) {
  const Row& x = rows_[rule.x];
  const double side = *rule.constant;
  if (std::isnan(side)) return conclude(rows_[rule.out], infinity);
  const double beyond = side == 0 ? x.of_value.magnitude() : beyond_kink(x, side);
  if (rule.kind == Kind::sign) {
    conclude(rows_[rule.out], side == 0 ? 1 : beyond > 0 ? 2 : 0);
  } else {
    conclude(rows_[rule.out], side == 0 ? beyond : x.r + x.own_top + 2 * beyond);
  }
}

}  // namespace qdot::taylor
