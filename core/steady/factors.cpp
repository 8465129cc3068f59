#include "core/steady/factors.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/linear_factors.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

bool is_number(const Polynomial& a) { return a.size() == 1 && a.begin()->first.empty(); }

/// p stands in it as a symbol only, in whole powers.
bool is_polynomial_in(const Polynomial& a, const Expression& p) {
  for (const auto& [monomial, coefficient] : a) {
    for (const Atom& atom : monomial) {
      if (atom.q != 1 || atom.p < 0) return false;
      const Expression base(p.graph(), atom.base);
      if (!(base == p) && depends_on(base, p)) return false;
    }
  }
  return true;
}

bool has_no_denominator(const Polynomial& a) {
  return std::ranges::all_of(a, [](const auto& term) {
    return std::ranges::all_of(term.first, [](const Atom& atom) { return atom.p > 0; });
  });
}

class Factors {
 public:
  Factors(Graph& graph, const Polynomial& whole) : graph_(graph), whole_(whole) {}

  /// Those of a, which divides the whole.
  void add(const Polynomial& a) {
    if (is_number(a)) return;
    const SquareFactors parts = square_factors(a);
    if (is_number(parts.outside)) return add_one(a);
    add(parts.outside);
    const Polynomial common = greatest_common_divisor(parts.inside, parts.outside);
    if (const auto rest = exact_quotient(parts.inside, common)) add(*rest);
  }

  [[nodiscard]] std::vector<Factor> found() && { return std::move(found_); }

 private:
  void add_one(const Polynomial& a) {
    const Expression base = to_expression(graph_, a);
    if (std::ranges::find(found_, base, &Factor::base) != found_.end()) return;
    const auto rest = exact_quotient(whole_, a * a);
    found_.push_back({base, rest && has_no_denominator(*rest)});
  }

  Graph& graph_;
  const Polynomial& whole_;
  std::vector<Factor> found_;
};

/// And what is left; e itself where there are none.
std::vector<Expression> linear_factors_of(const Expression& e) {
  std::vector<Expression> found;
  try {
    Polynomial rest = multiplied_out(e);
    const Monomial common = common_monomial(rest);
    if (!has_no_denominator({{common, Number(1)}})) return {e};
    for (const Atom& atom : common) found.emplace_back(e.graph(), atom.base);
    rest = scaled(rest, inverse(common), Number(1));
    while (const auto factor = linear_factor(rest)) {
      found.push_back(to_expression(e.graph(), *factor));
      rest = *exact_quotient(rest, *factor);
    }
    if (found.empty()) return {e};
    if (!is_number(rest)) found.push_back(to_expression(e.graph(), rest));
    return found;
  } catch (const Error&) {
    return {e};
  }
}

std::vector<Factor> with_linear_ones(const Expression& e, const Expression& p) {
  std::vector<Factor> result;
  for (const Factor& factor : factors_along(e, p)) {
    for (const Expression& base : linear_factors_of(factor.base)) {
      if (std::ranges::find(result, base, &Factor::base) == result.end())
        result.push_back({base, factor.is_repeated});
    }
  }
  return result;
}

/// k, where a = k u and k is a whole number.
std::optional<Number> multiple_of(const Expression& u, const Expression& a) {
  const auto quotient = exact_quotient(multiplied_out(a), multiplied_out(u));
  if (!quotient || !is_number(*quotient) || !quotient->begin()->second.is_integer()) return std::nullopt;
  return quotient->begin()->second;
}

/// Each argument by the symbol w of an angle u that all of them are multiples of; empty where there is none.
std::vector<Replacement> as_multiples(std::span<const Expression> arguments, const Expression& u,
                                      const Expression& w) {
  std::vector<Replacement> result;
  for (const Expression& argument : arguments) {
    const auto k = multiple_of(u, argument);
    if (!k) return {};
    result.emplace_back(argument, *k * w);
  }
  return result;
}

/// By the multiples of one that moves with p, where all are, as u = x - p: those of x alone would tear u
/// apart.
Expression in_single_angles(const Expression& e, const Expression& p) {
  const auto is_no_symbol = [](const Expression& u) { return !std::holds_alternative<Symbol>(u.node()); };
  Graph& graph = e.graph();
  try {
    const Polynomial terms = multiplied_out(e);
    const std::vector<Expression> arguments = trigonometric_arguments(graph, terms);
    if (std::ranges::none_of(arguments, is_no_symbol)) return e;
    const Expression w = graph.symbol("w of angles");
    for (const Expression& u : arguments) {
      if (!depends_on(u, p)) continue;
      const std::vector<Replacement> multiples = as_multiples(arguments, u, w);
      if (multiples.empty()) continue;
      const Polynomial of_w = multiplied_out(substitute(to_expression(graph, terms), multiples));
      const Replacement back{w, u};
      return substitute(to_expression(graph, with_single_angles(graph, of_w)), {&back, 1});
    }
    return to_expression(graph, with_single_angles(graph, terms));
  } catch (const Error&) {  // the algebra grows too large
    return e;
  }
}

}  // namespace

std::vector<Factor> factors_along(const Expression& e, const Expression& p) {
  try {
    const Polynomial whole = multiplied_out(e);
    if (whole.empty() || !is_polynomial_in(whole, p)) return {{e, false}};
    const Polynomial content = content_in(whole, p.id());
    Factors factors(e.graph(), whole);
    factors.add(content);
    if (const auto rest = exact_quotient(whole, content)) factors.add(*rest);
    return std::move(factors).found();
  } catch (const Error&) {  // the algebra grows too large
    return {{e, false}};
  }
}

std::vector<Factor> factors_and_curves(const Expression& e, const Expression& p) {
  std::vector<Factor> plain = with_linear_ones(e, p);
  if (plain.size() != 1) return plain;
  std::vector<Factor> single = with_linear_ones(in_single_angles(e, p), p);
  return single.size() > 1 ? single : plain;
}

}  // namespace qdot
