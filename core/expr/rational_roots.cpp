#include "core/expr/rational_roots.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/root_isolation.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_boxes_of_roots = 500;

template <class T>
T by_horner(std::span<const T> c, const T& x) {
  T sum = c.back();
  for (std::size_t k = c.size() - 1; k-- > 0;) sum = sum * x + c[k];
  return sum;
}

template <class T>
std::vector<T> slope_of(std::span<const T> c) {
  std::vector<T> slope;
  for (std::size_t k = 1; k < c.size(); ++k) slope.push_back(T(static_cast<std::int64_t>(k)) * c[k]);
  return slope;
}

/// Near the roots of c, in doubles.
std::vector<double> approximate_roots(std::span<const Number> c) {
  std::vector<Interval> rounded;
  double largest = 0;
  for (const Number& coefficient : c) {
    rounded.emplace_back((coefficient / c.back()).value());
    largest = std::max(largest, std::abs(rounded.back().middle()));
  }
  if (!std::isfinite(largest)) return {};
  std::vector<Interval> slope;
  for (std::size_t k = 1; k < rounded.size(); ++k)
    slope.push_back(Interval(static_cast<double>(k)) * rounded[k]);
  const SquareSystem system{
      1, [&](auto x, auto out) { out[0] = by_horner(std::span<const Interval>(rounded), x[0]); },
      [&](auto x, auto out) { out[0] = by_horner(std::span<const Interval>(slope), x[0]); }};
  const Interval region(-1 - largest, 1 + largest);  // Cauchy's bound
  std::vector<double> roots;
  for (const IsolatedZero& zero : isolate_zeros(system, {region}, {}, most_boxes_of_roots).zeros)
    roots.push_back(zero.enclosure[0].middle());
  return roots;
}

/// The integer root near `start` of a polynomial with whole coefficients, if there is one: Newton's iteration
/// from integer to integer.
std::optional<Number> integer_root(std::span<const Number> h, double start) {
  constexpr int most_steps = 12;
  const std::vector<Number> slope = slope_of(h);
  Number z = Number::real(std::round(start));
  for (int i = 0; i < most_steps; ++i) {
    const Number value = by_horner(h, z);
    if (value.is_zero()) return z;
    const Number rise = by_horner(std::span<const Number>(slope), z);
    if (rise.is_zero()) return std::nullopt;
    const double step = std::round((value / rise).value());
    if (step == 0 || !std::isfinite(step)) return std::nullopt;
    z = z - Number::real(step);
  }
  return std::nullopt;
}

}  // namespace

std::vector<Number> rational_roots(std::span<const Number> c) {
  std::vector<Number> roots;
  if (c.size() < 2) return roots;
  Number common(0);
  for (const Number& coefficient : c) common = gcd(common, coefficient);
  const Number leading = c.back() / common;
  // Of z = leading x the leading coefficient is 1, so that rational roots are integers.
  std::vector<Number> h(c.size(), Number(1));
  Number front(1);
  for (std::size_t k = c.size() - 1; k-- > 0;) {
    h[k] = c[k] / common * front;
    front = front * leading;
  }
  for (const double x : approximate_roots(c)) {
    const double start = x * leading.value();
    if (!std::isfinite(start)) continue;
    const auto z = integer_root(h, start);
    if (!z) continue;
    const Number root = *z / leading;
    if (std::ranges::find(roots, root) == roots.end()) roots.push_back(root);
  }
  std::ranges::sort(roots, [](const Number& a, const Number& b) { return a < b; });
  return roots;
}

}  // namespace qdot
