#include "core/closed/exact_roots.hpp"

#include <algorithm>

#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

struct WithRoot {
  Expression rational, irrational;
};

/// e = u + v sqrt(n) with a number n.
std::optional<WithRoot> with_root_of_number(Graph& graph, const Polynomial& e) {
  const auto root_in = [&](const Monomial& monomial) {
    return std::ranges::find_if(monomial, [&](const Atom& atom) {
      return atom.q == 2 && std::holds_alternative<Literal>(graph.node(atom.base));
    });
  };
  std::optional<NodeId> n;
  Polynomial rational, irrational;
  for (const auto& [monomial, coefficient] : e) {
    const auto root = root_in(monomial);
    const bool has_root = root != monomial.end() && (!n || root->base == *n);
    if (has_root) n = root->base;
    add(has_root ? irrational : rational, monomial, coefficient);
  }
  if (!n) return std::nullopt;
  return WithRoot{to_expression(graph, rational), to_expression(graph, irrational)};
}

/// The one with fewer operations, or else fewer letters.
Expression shorter(const Expression& a, const Expression& b) {
  const std::size_t of_a = written_length(a), of_b = written_length(b);
  if (of_a != of_b) return of_b < of_a ? b : a;
  return print(b, Form::text).size() < print(a, Form::text).size() ? b : a;
}

/// Brackets with whole numbers that are positive where the symbols have their values, as one writes them by
/// hand: 3*(53*sin(2 x) - 9*cos(2 x)) for -159*(9/53*cos(2 x) - sin(2 x)).
Expression with_whole_brackets(const Expression& e, const SignOf& sign) {
  const auto* product = std::get_if<Product>(&e.node());
  if (product == nullptr) return e;
  Graph& graph = e.graph();
  const std::vector<NodeId> factors = product->factors;
  Expression result = graph.number(product->coefficient);
  for (const NodeId id : factors) {
    const auto [base, exponent] = split_power({graph, id});
    if (!std::holds_alternative<Sum>(base.node()) || !exponent.is_integer()) {
      result = result * Expression(graph, id);
      continue;
    }
    const Polynomial terms = multiplied_out(base);
    const Number front = sign(terms) < 0 ? -content(terms) : content(terms);
    const Expression bracket = to_expression(graph, scaled(terms, {}, Number(1) / front));
    result = result * pow(graph.number(front), exponent) * pow(bracket, exponent);
  }
  return written_length(result) <= written_length(e) + 3 ? result : e;
}

Expression root_of(const Expression& square, const SignOf& sign) {
  return shorter(positive_root(square.graph(), rational_function(square), sign), sqrt(square));
}

/// Without what all coefficients share in single angles, as the sine in the equations of a top.
std::vector<Surd> roots_in_single_angles(const Expression& c0, const Expression& c1, const Expression& c2) {
  Graph& graph = c0.graph();
  const auto single = [&](const Expression& e) { return with_single_angles(graph, multiplied_out(e)); };
  const Polynomial leading = single(c2);
  const RationalFunction one{{{Monomial{}, Number(1)}}};
  return quadratic_roots(one, in_lowest_terms(single(c1), leading), in_lowest_terms(single(c0), leading));
}

/// e as a function of u^2 = v, v written as u; no value where odd powers of u are in it.
std::optional<Expression> in_squares(const Expression& e, const Expression& u) {
  Polynomial halved;
  for (const auto& [monomial, coefficient] : rational_function(e).above) {
    const int power = exponent_of(monomial, u.id());
    if (power % 2 != 0) return std::nullopt;
    add(halved, times(monomial, u.id(), -power / 2), coefficient);
  }
  return to_expression(e.graph(), halved);
}

}  // namespace

Expression shortest_quotient(const Expression& a, const Expression& b, const SignOf& sign) {
  Graph& graph = a.graph();
  if (const auto split = with_root_of_number(graph, multiplied_out(b))) {
    const auto& [rational, irrational] = *split;
    const Expression below = expand(rational * rational - irrational * irrational);
    if (!below.is_zero()) return shortest_quotient(expand(a * (rational - irrational)), below, sign);
  }
  const auto single = [&](const Expression& e) {
    return to_expression(graph, with_single_angles(graph, multiplied_out(e)));
  };
  const Expression lowest = to_expression(graph, rational_function(a / b));
  Expression best =
      shorter(with_whole_brackets(simplify_quotient(a, b), sign), with_whole_brackets(lowest, sign));
  if (const Expression sum = expand(lowest); std::holds_alternative<Sum>(sum.node()))
    best = shorter(best, sum);
  return shorter(best,
                 with_whole_brackets(to_expression(graph, rational_function(single(a) / single(b))), sign));
}

std::vector<Expression> roots_of(const Expression& c0, const Expression& c1, const Expression& c2,
                                 const SignOf& sign) {
  if (c2.is_zero())
    return c1.is_zero() ? std::vector<Expression>{} : std::vector{shortest_quotient(-c0, c1, sign)};
  if (c1.is_zero()) {
    const Expression root = root_of(shortest_quotient(-c0, c2, sign), sign);
    return {root, -root};
  }
  const auto written = [&](const std::vector<Surd>& surds) {
    std::vector<Expression> roots;
    for (const Surd& root : surds) roots.push_back(to_expression(c0.graph(), root));
    return roots;
  };
  const auto length = [](const std::vector<Expression>& roots) {
    std::size_t sum = 0;
    for (const Expression& root : roots) sum += written_length(root);
    return sum;
  };
  const std::vector<Expression> plain =
      written(quadratic_roots(rational_function(c2), rational_function(c1), rational_function(c0)));
  const std::vector<Expression> single = written(roots_in_single_angles(c0, c1, c2));
  return length(single) < length(plain) ? single : plain;
}

std::vector<Expression> roots_in(const Expression& e, const Expression& u, const ExactValues& values) {
  const SignOf sign = values.sign_of();
  if (const auto c = quadratic_in(e, u)) return roots_of((*c)[0], (*c)[1], (*c)[2], sign);
  const auto halved = in_squares(e, u);
  const auto c = halved ? quadratic_in(*halved, u) : std::nullopt;
  std::vector<Expression> roots;
  if (!c) return roots;
  for (const Expression& square : roots_of((*c)[0], (*c)[1], (*c)[2], sign)) {
    const Real value = values.value(square);
    if (!value.is_finite() || value.value <= 0) continue;
    const Expression root = root_of(square, sign);
    roots.insert(roots.end(), {root, -root});
  }
  return roots;
}

std::optional<std::vector<Expression>> quadratic_in(const Expression& e, const Expression& u) {
  Graph& graph = e.graph();
  std::map<int, Polynomial> parts;
  for (const auto& [monomial, coefficient] : rational_function(e).above) {
    const int power = exponent_of(monomial, u.id());
    const Monomial rest = times(monomial, u.id(), -power);
    if (depends_on(to_expression(graph, rest), u)) return std::nullopt;
    add(parts[power], rest, coefficient);
  }
  std::erase_if(parts, [](const auto& part) { return part.second.empty(); });
  if (parts.size() < 2) return std::nullopt;
  const int lowest = parts.begin()->first;
  std::vector<Expression> c(3, graph.number(0));
  for (const auto& [power, part] : parts) {
    if (power - lowest > 2) return std::nullopt;
    c[static_cast<std::size_t>(power - lowest)] = to_expression(graph, part);
  }
  return c;
}

}  // namespace qdot
