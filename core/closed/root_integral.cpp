#include "core/closed/root_integral.hpp"

#include <algorithm>
#include <map>

#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

constexpr int highest_degree = 8;

RationalFunction rational(const Number& number) { return {{{Monomial{}, number}}}; }

int degree(const Univariate& e) { return static_cast<int>(e.size()) - 1; }

/// The lowest power of the unknown, which is taken out.
int take_out_power(Univariate& e) {
  const auto first = std::ranges::find_if_not(e, &RationalFunction::is_zero);
  const auto power = static_cast<int>(first - e.begin());
  e.erase(e.begin(), first);
  return power;
}

/// The leading coefficient, by which e is divided.
RationalFunction make_monic(Univariate& e) {
  const RationalFunction leading = e.back();
  for (RationalFunction& c : e) c = c / leading;
  return leading;
}

Univariate product(const Univariate& a, const Univariate& b) {
  Univariate result(a.size() + b.size() - 1, RationalFunction{{}});
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] = result[i + j] + a[i] * b[j];
  }
  return result;
}

/// s with s^2 = e, of a monic e.
std::optional<Univariate> monic_root(const Univariate& e) {
  if (degree(e) % 2 != 0) return std::nullopt;
  const std::size_t n = e.size() / 2;
  Univariate root(n + 1, RationalFunction{{}});
  root[n] = e.back();
  for (std::size_t k = 1; k <= n; ++k) {  // from the coefficient of w^(2n - k)
    RationalFunction rest = e[2 * n - k];
    for (std::size_t i = 1; i < k; ++i) rest = rest - root[n - i] * root[n - k + i];
    root[n - k] = rest * rational(Number::ratio(1, 2));
  }
  const Univariate square = product(root, root);
  for (std::size_t k = 0; k < e.size(); ++k) {
    if (!(square[k] - e[k]).is_zero()) return std::nullopt;
  }
  return root;
}

/// P(w) dw / sqrt(-(w^2 + b w + c)), times the root of `scale`.
struct QuadraticForm {
  Univariate p;
  int shift{};  ///< P is w^shift times p
  RationalFunction b, c;
  RationalFunction scale;
};

std::optional<QuadraticForm> quadratic_form(Univariate above, Univariate below) {
  int shift = take_out_power(below) - take_out_power(above);
  if (degree(above) > 2 || degree(below) > highest_degree) return std::nullopt;
  const RationalFunction of_above = make_monic(above), of_below = make_monic(below);
  Univariate p;
  if (const auto root = monic_root(below)) {
    p = *root;
  } else if (degree(above) + degree(below) <= 2) {
    p = below;
    above = product(above, below);
  } else {
    return std::nullopt;
  }
  if (shift % 2 != 0) {  // one more w under the root
    above.insert(above.begin(), RationalFunction{{}});
    ++shift;
  }
  if (degree(above) != 2) return std::nullopt;
  return QuadraticForm{p, shift / 2, above[1], above[0], -(of_below / of_above)};
}

/// |f| times the root of g, in the shortest of three forms.
Expression times_root(Graph& graph, const RationalFunction& f, const RationalFunction& g,
                      const SignOf& sign) {
  const RationalFunction square = f * f * g;
  const Expression inside = positive_root(graph, square, sign);
  const Number size = sign(f.above) * sign(f.below) < 0 ? Number(-1) : Number(1);
  const Expression outside = size * to_expression(graph, f) * positive_root(graph, g, sign);
  const Expression& best = written_length(outside) < written_length(inside) ? outside : inside;
  const Expression joined = sqrt(simplify(to_expression(graph, square)));
  return written_length(joined) < written_length(best) ? joined : best;
}

}  // namespace

std::optional<Univariate> univariate(Graph& graph, const Polynomial& e, const Expression& u) {
  std::map<int, Polynomial> parts;
  for (const auto& [monomial, coefficient] : e) {
    const int power = exponent_of(monomial, u.id());
    const Monomial rest = times(monomial, u.id(), -power);
    if (power < 0 || power > highest_degree || depends_on(to_expression(graph, rest), u)) return std::nullopt;
    add(parts[power], rest, coefficient);
  }
  std::erase_if(parts, [](const auto& part) { return part.second.empty(); });
  if (parts.empty()) return std::nullopt;
  Univariate result(static_cast<std::size_t>(parts.rbegin()->first) + 1, RationalFunction{{}});
  for (const auto& [power, part] : parts) result[static_cast<std::size_t>(power)] = RationalFunction{part};
  return result;
}

bool is_root_integral(const Univariate& above, const Univariate& below) {
  return (degree(above) == 1 && degree(below) == 0) || quadratic_form(above, below);
}

std::optional<Expression> root_integral(Graph& graph, const Univariate& above, const Univariate& below,
                                        const SignOf& sign, int passes) {
  const auto form = quadratic_form(above, below);
  if (!form) return std::nullopt;
  const auto& [p, shift, b, c, scale] = *form;
  (void)(sign(c.above) * sign(c.below));  // asked: whether 0 lies between the zeros
  const RationalFunction mean = b * rational(Number::ratio(-1, 2));  // of the two zeros
  RationalFunction plain{{}}, by_root{{}};                           // integral / pi, and times sqrt(c)
  const RationalFunction factor = rational(Number(passes));
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p[i].is_zero()) continue;
    const RationalFunction f = factor * p[i];
    const int k = static_cast<int>(i) + shift;
    if (k < -2 || k > 2 || (k < 0 && c.is_zero())) return std::nullopt;
    if (k == 0) plain = plain + f;
    if (k == 1) plain = plain + f * mean;
    if (k == 2)
      plain = plain + f * (rational(Number::ratio(3, 2)) * mean * mean - c * rational(Number::ratio(1, 2)));
    if (k == -1) by_root = by_root + f;
    if (k == -2) by_root = by_root + f * mean / c;
  }
  const Expression pi = graph.symbol("pi");
  if (by_root.is_zero()) return pi * times_root(graph, plain, scale, sign);
  if (plain.is_zero()) return pi * times_root(graph, by_root, scale / c, sign);
  // Zeros of one sign: w^-1 has the sign of their mean.
  const int of_zeros = sign(mean.above) * sign(mean.below);
  const RationalFunction other = of_zeros < 0 ? -by_root : by_root;
  const bool opposed = sign(plain.above) * sign(plain.below) != sign(other.above) * sign(other.below);
  const Expression first = times_root(graph, plain, scale, sign),
                   second = times_root(graph, other, scale / c, sign);
  return pi * (opposed ? first - second : first + second);
}

namespace {

/// sqrt(d/n) acos(-mean/sqrt(mean^2 - c)) with D/N = d/(n (-w^2 + 2 mean w - c)), c < 0.
std::optional<Expression> arc_from_zero(Graph& graph, const Univariate& above, const RationalFunction& below,
                                        const SignOf& sign, int passes) {
  const RationalFunction mean = -(above[1] / above[2]) * rational(Number::ratio(1, 2));
  const RationalFunction c = above[0] / above[2];
  const int side = sign(mean.above) * sign(mean.below);
  if (side == 0 || sign(c.above) * sign(c.below) >= 0) return std::nullopt;
  const Expression cosine = Number(-side) * positive_root(graph, mean * mean / (mean * mean - c), sign);
  const RationalFunction factor = rational(Number(passes * passes));
  return positive_root(graph, -(factor * below / above[2]), sign) * graph.call(Function::acos, cosine);
}

}  // namespace

std::optional<Expression> root_integral_from_zero(Graph& graph, const Univariate& above,
                                                  const Univariate& below, const SignOf& sign, int passes) {
  if (degree(below) != 0) return std::nullopt;
  if (degree(above) == 2) {
    if (!above[1].is_zero()) return arc_from_zero(graph, above, below[0], sign, passes);
    return passes % 2 == 0 ? root_integral(graph, above, below, sign, passes / 2) : std::nullopt;
  }
  if (degree(above) != 1) return std::nullopt;
  // sqrt(d/(n (w - r))): 2 sqrt(-d r/n)
  const RationalFunction zero = -(above[0] / above[1]);
  const RationalFunction factor = rational(Number(4 * passes * passes));
  return positive_root(graph, -(factor * below[0] * zero / above[1]), sign);
}

}  // namespace qdot
