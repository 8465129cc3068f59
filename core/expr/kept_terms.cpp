#include "core/expr/kept_terms.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

constexpr std::int64_t most_of_an_exponent = 1024;

/// How many sums are multiplied in e: 3 for (x + y)^2 (x - y).
std::int64_t sums_multiplied(const Expression& e) {
  const auto of_factor = [&](NodeId id) -> std::int64_t {
    const auto [base, exponent] = split_power({e.graph(), id});
    const auto whole = exponent.whole(most_of_an_exponent);
    return std::holds_alternative<Sum>(base.node()) && whole && *whole > 0 ? *whole : 0;
  };
  const auto* product = std::get_if<Product>(&e.node());
  if (product == nullptr) return of_factor(e.id());
  std::int64_t count = 0;
  for (const NodeId id : product->factors) count += of_factor(id);
  return count;
}

/// What stands inside functions of e, and in what it divides by.
std::vector<NodeId> insides(const Expression& e) {
  std::vector<NodeId> result;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(e.graph(), root)) {
    const Node& node = e.graph().node(id);
    if (const auto* call = std::get_if<Call>(&node)) result.push_back(call->argument);
    const auto* power = std::get_if<Power>(&node);
    if (power != nullptr && power->exponent.whole(most_of_an_exponent).value_or(-1) < 0) {
      result.push_back(power->base);
    }
  }
  return result;
}

bool contains(const Expression& e, Function function) {
  const NodeId root[]{e.id()};
  return std::ranges::any_of(reachable(e.graph(), root), [&](NodeId id) {
    const auto* call = std::get_if<Call>(&e.graph().node(id));
    return call != nullptr && call->function == function;
  });
}

bool contains_kinks(const Expression& e) { return contains(e, Function::abs) || contains(e, Function::sign); }

/// The sign that is one factor of a product; none where there are more, or powers of it.
std::optional<NodeId> sign_in(const Graph& graph, const Monomial& monomial) {
  std::optional<NodeId> found;
  for (const Atom& atom : monomial) {
    const auto* call = std::get_if<Call>(&graph.node(atom.base));
    if (call == nullptr || call->function != Function::sign) continue;
    if (found || atom.p != 1 || atom.q != 1) return std::nullopt;
    found = atom.base;
  }
  return found;
}

bool divides_by(const Polynomial& polynomial, NodeId base) {
  return std::ranges::any_of(polynomial, [&](const auto& term) {
    return std::ranges::any_of(term.first, [&](const Atom& atom) { return atom.base == base && atom.p < 0; });
  });
}

/// a/b, where that divides by nothing that a does not: no k/x of k and x.
std::optional<Polynomial> whole_quotient(const Polynomial& a, const Polynomial& b) {
  auto quotient = exact_quotient(a, b);
  if (!quotient) return quotient;
  for (const auto& [monomial, coefficient] : *quotient) {
    for (const Atom& atom : monomial) {
      if (atom.p < 0 && !divides_by(a, atom.base)) return std::nullopt;
    }
  }
  return quotient;
}

/// c u |u|, where c u^2 is the factor of sign(u), or c |u| of c u; as it is of others.
Expression with_sign(Graph& graph, NodeId sign, const Polynomial& factor) {
  const Expression u(graph, std::get<Call>(graph.node(sign)).argument);
  const Polynomial divisor = multiplied_out(u);
  const auto once = whole_quotient(factor, divisor);
  if (!once) return to_expression(graph, factor) * Expression(graph, sign);
  const auto twice = whole_quotient(*once, divisor);
  return graph.call(Function::abs, u) *
         (twice ? u * to_expression(graph, *twice) : to_expression(graph, *once));
}

/// Jumps where nothing jumps are written as what they are.
Expression without_jumps_of_zero(const Expression& e) {
  Polynomial others;
  std::map<NodeId, Polynomial> factors;
  for (const auto& [monomial, coefficient] : multiplied_out(e)) {
    if (const auto sign = sign_in(e.graph(), monomial))
      add(factors[*sign], times(monomial, *sign, -1), coefficient);
    else
      add(others, monomial, coefficient);
  }
  Expression sum = to_expression(e.graph(), others);
  for (const auto& [sign, factor] : factors) sum = sum + with_sign(e.graph(), sign, factor);
  return sum;
}

bool is_symbol_or_number(const Expression& factor) {
  const Expression base = split_power(factor).base;
  return base.number() != nullptr || std::holds_alternative<Symbol>(base.node());
}

void add_terms(const Expression& e, const Expression& factor, std::vector<Expression>& terms) {
  if (const auto* sum = std::get_if<Sum>(&e.node())) {
    for (const NodeId id : sum->terms) add_terms({e.graph(), id}, factor, terms);
    return;
  }
  const auto* product = std::get_if<Product>(&e.node());
  std::optional<Expression> sum;
  Expression others = factor;
  bool is_scaled_sum = product != nullptr;
  for (std::size_t i = 0; is_scaled_sum && i < product->factors.size(); ++i) {
    const Expression part(e.graph(), product->factors[i]);
    const bool is_sum = std::holds_alternative<Sum>(part.node());
    is_scaled_sum = is_sum ? !sum : is_symbol_or_number(part);
    if (is_sum)
      sum = part;
    else
      others = others * part;
  }
  if (is_scaled_sum && sum) return add_terms(*sum, split_coefficient(e).coefficient * others, terms);
  terms.push_back(factor * e);
}

}  // namespace

bool loses_digits_multiplied_out(const Expression& e) {
  const auto multiplies = [&](std::span<const NodeId> roots, std::int64_t most) {
    const std::vector<NodeId> below = reachable(e.graph(), roots);
    return std::ranges::any_of(below, [&](NodeId id) { return sums_multiplied({e.graph(), id}) > most; });
  };
  const NodeId root[]{e.id()};
  return multiplies(root, 2) || multiplies(insides(e), 1);
}

std::vector<Expression> summands(const Expression& e) {
  std::vector<Expression> terms;
  add_terms(e, e.graph().number(1), terms);
  return terms;
}

Terms split_kept_terms(const Expression& e) {
  std::vector<Expression> plain, kept;
  for (const Expression& term : summands(e))
    (loses_digits_multiplied_out(term) ? kept : plain).push_back(term);
  return {e.graph().sum(plain), e.graph().sum(kept)};
}

Expression shortened(const Expression& e) {
  const Terms terms = split_kept_terms(e);
  return terms.kept.is_zero() ? simplify(e) : simplify(terms.plain) + terms.kept;
}

Expression shortened_beside_kinks(const Expression& e) {
  if (!contains_kinks(e)) return simplify(e);
  std::vector<Expression> plain, jumps, kinked;
  for (const Expression& term : summands(e))
    (contains(term, Function::sign) ? jumps : contains_kinks(term) ? kinked : plain).push_back(term);
  Graph& graph = e.graph();
  return simplify(graph.sum(plain)) + without_jumps_of_zero(graph.sum(jumps)) + graph.sum(kinked);
}

Expression shortened_derivative(const Expression& e, const Expression& x) {
  const Terms terms = split_kept_terms(e);
  if (terms.kept.is_zero()) return simplify(differentiate(e, x));
  return simplify(differentiate(terms.plain, x)) + differentiate(terms.kept, x);
}

}  // namespace qdot
