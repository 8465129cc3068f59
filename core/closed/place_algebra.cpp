#include "core/closed/place_algebra.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/expr/calculus.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/rational_function.hpp"

namespace qdot {

std::optional<LinearIn> linear_in(Graph& graph, const Polynomial& e, const Expression& u,
                                  const Expression& symbol, int n) {
  LinearIn parts;
  for (const auto& [monomial, coefficient] : e) {
    const int power = exponent_of(monomial, u.id());
    if (power != 0 && power != n) return std::nullopt;
    const Monomial rest = times(monomial, u.id(), -power);
    if (depends_on(to_expression(graph, rest), symbol)) return std::nullopt;
    add(power == n ? parts.slope : parts.rest, rest, coefficient);
  }
  if (parts.slope.empty()) return std::nullopt;
  return parts;
}

std::optional<Expression> angle_of_tangent(Graph& graph, const RationalFunction& f) {
  if (f.above.size() != 1 || f.below.size() != 1) return std::nullopt;
  const auto& [above, c] = *f.above.begin();
  const auto& [below, d] = *f.below.begin();
  for (const Atom& atom : above) {
    const auto* call = std::get_if<Call>(&graph.node(atom.base));
    if (call == nullptr || call->function != Function::sin) continue;
    const Expression u(graph, call->argument);
    const Monomial partner = times(times(above, atom.base, -1), cos(u).id(), 1);
    if (partner == below && (c == d || c == -d)) return Number(c == d ? 1 : -1) * u;
  }
  return std::nullopt;
}

Expression factored_tangent(Graph& graph, const RationalFunction& f) {
  const Monomial above = common_monomial(f.above), below = common_monomial(f.below);
  Monomial front = above * inverse(below);
  Expression result = to_expression(graph, scaled(f.above, inverse(above), Number(1))) /
                      to_expression(graph, scaled(f.below, inverse(below), Number(1)));
  for (const Atom& atom : above) {
    const auto* call = std::get_if<Call>(&graph.node(atom.base));
    if (call == nullptr || call->function != Function::sin) continue;
    const Expression u(graph, call->argument);
    const NodeId cosine = cos(u).id();
    if (exponent_of(front, atom.base) != 1 || exponent_of(front, cosine) != -1) continue;
    front = times(times(front, atom.base, -1), cosine, 1);
    result = result * graph.call(Function::tan, u);
  }
  return to_expression(graph, front) * result;
}

Expression with_tangents_written(const Expression& e) {
  Graph& graph = e.graph();
  std::vector<Replacement> tangents;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph, root)) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr || call->function != Function::tan) continue;
    const Expression argument(graph, call->argument);
    tangents.emplace_back(Expression(graph, id), sin(argument) / cos(argument));
  }
  return tangents.empty() ? e : substitute(e, tangents);
}

Expression with_roots_taken(const Expression& e, const SignOf& sign) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph, root)) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr || power->exponent.denominator() != Number(2)) continue;
    const Expression base(graph, power->base);
    const Number twice = power->exponent * Number(2);
    const Expression half = positive_root(graph, rational_function(base), sign);
    if (written_length(half) < written_length(sqrt(base)))
      taken.emplace_back(Expression(graph, id), pow(half, twice));
  }
  return taken.empty() ? e : substitute(e, taken);
}

Expression with_sizes_taken(const Expression& e, const SignOf& sign) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph, root)) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr || (call->function != Function::abs && call->function != Function::sign)) continue;
    const Expression u(graph, call->argument);
    const bool is_size = call->function == Function::abs;
    const RationalFunction f = rational_function(u);
    const Number side(sign(f.above) * sign(f.below));
    if (!side.is_zero()) taken.emplace_back(Expression(graph, id), is_size ? side * u : graph.number(side));
  }
  return taken.empty() ? e : substitute(e, taken);
}

namespace {

/// What exp(argument) is by the u of n log(u) in it, and the rest of the argument.
std::optional<std::pair<Expression, Expression>> power_of_logarithm(const Expression& argument) {
  Graph& graph = argument.graph();
  for (const Expression& term : terms_of(argument)) {
    const auto [n, rest] = split_coefficient(term);
    const auto* call = std::get_if<Call>(&rest.node());
    if (call != nullptr && call->function == Function::log)
      return std::pair(pow(Expression(graph, call->argument), n), argument - term);
  }
  return std::nullopt;
}

}  // namespace

Expression with_logarithms_taken(const Expression& e) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph, root)) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr) continue;
    const Function function = call->function;
    if (function == Function::log) {
      const auto* inner = std::get_if<Call>(&graph.node(call->argument));
      if (inner != nullptr && inner->function == Function::exp)
        taken.emplace_back(Expression(graph, id), Expression(graph, inner->argument));
      continue;
    }
    const auto power = power_of_logarithm(expand(Expression(graph, call->argument)));
    if (!power) continue;
    const Expression up = power->first * graph.call(Function::exp, expand(power->second));
    const Expression down = graph.number(1) / up;
    const Number half = Number::ratio(1, 2);
    if (function == Function::exp) taken.emplace_back(Expression(graph, id), up);
    if (function == Function::sinh) taken.emplace_back(Expression(graph, id), half * (up - down));
    if (function == Function::cosh) taken.emplace_back(Expression(graph, id), half * (up + down));
  }
  return taken.empty() ? e : substitute(e, taken);
}

ByExponential in_powers_apart(const ByExponential& f) {
  if (f.e.empty()) return f;
  const auto power = [&](const auto& term) { return exponent_of(term.first, f.w.id()); };
  int lowest = power(*f.e.begin()), apart = 0;
  for (const auto& term : f.e) lowest = std::min(lowest, power(term));
  for (const auto& term : f.e) apart = std::gcd(apart, power(term) - lowest);
  if (apart == 0) return f;
  ByExponential result{{}, f.w, Number(apart) * f.argument};
  for (const auto& term : f.e) {
    const int reduced = (power(term) - lowest) / apart;
    add(result.e, times(term.first, f.w.id(), reduced - power(term)), term.second);
  }
  return result;
}

Polynomial without_factor(const Polynomial& e, const Expression& u) {
  if (e.empty()) return e;
  int common = 64;
  for (const auto& [monomial, coefficient] : e) common = std::min(common, exponent_of(monomial, u.id()));
  return scaled(e, times({}, u.id(), -common), Number(1));
}

int highest_power(const Polynomial& e, const Expression& u) {
  int highest = 0;
  for (const auto& [monomial, coefficient] : e) highest = std::max(highest, exponent_of(monomial, u.id()));
  return highest;
}

namespace {

/// r with r^n = x > 0, a small fraction; 2 for 8 and n = 3.
std::optional<Number> whole_root(const Number& x, int n) {
  constexpr std::int64_t largest = 1000;
  const auto root_of = [&](std::int64_t value) -> std::optional<std::int64_t> {
    for (std::int64_t r = 1; r <= largest; ++r) {
      std::int64_t power = 1;
      for (int k = 0; k < n && power <= value; ++k) power *= r;
      if (power == value) return r;
      if (power > value) break;
    }
    return std::nullopt;
  };
  const auto small = x.small();
  if (!small || small->numerator <= 0) return std::nullopt;
  const auto above = root_of(small->numerator), below = root_of(small->denominator);
  return above && below ? std::optional(Number::ratio(*above, *below)) : std::nullopt;
}

}  // namespace

std::optional<Expression> root_of_product(Graph& graph, const RationalFunction& f, int n,
                                          const SignOf& sign) {
  if (f.is_zero()) return std::nullopt;
  Expression result = graph.number(1);
  for (const auto& [part, side] : {std::pair(&f.above, 1), std::pair(&f.below, -1)}) {
    Monomial monomial = common_monomial(*part);
    Number coefficient = content(*part);
    if (part->size() == 1) {
      std::tie(monomial, coefficient) = *part->begin();
    } else {
      const Polynomial sum = scaled(*part, inverse(monomial), Number(1) / coefficient);
      if (sign(sum) <= 0) return std::nullopt;
      result = result * pow(to_expression(graph, sum), Number::ratio(side, n));
    }
    if (coefficient.is_negative()) return std::nullopt;
    const auto whole = whole_root(coefficient, n);
    result = result * (whole ? pow(graph.number(*whole), Number(side))
                             : pow(graph.number(coefficient), Number::ratio(side, n)));
    for (const Atom& atom : monomial) {
      const Expression base(graph, atom.base);
      if (sign(multiplied_out(base)) <= 0) return std::nullopt;
      result = result * pow(base, Number::ratio(side * atom.p, atom.q * n));
    }
  }
  return result;
}

}  // namespace qdot
