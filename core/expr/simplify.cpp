#include "core/expr/simplify.hpp"

#include <map>

#include "core/expr/factor.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

/// A polynomial with its short form and what that costs.
struct Candidate {
  Polynomial polynomial;
  Expression form;
  std::size_t cost;
};

Candidate candidate(Graph& graph, Polynomial polynomial) {
  const Expression form = factored(graph, polynomial);
  return {std::move(polynomial), form, operation_count(form)};
}

/// All polynomials one identity away.
std::vector<Polynomial> neighbours(Graph& graph, const Polynomial& polynomial) {
  std::vector<Polynomial> found;
  for (const Expression& u : trigonometric_arguments(graph, polynomial)) {
    for (Polynomial next : {without_sine_squares(graph, polynomial, u), without_cosine_squares(graph, polynomial, u),
                            with_double_angle(graph, polynomial, u)}) {
      if (next != polynomial) found.push_back(joined(graph, std::move(next)));
    }
  }
  return found;
}

/// Whether some argument is a combination of others, so that terms may cancel unseen.
bool arguments_depend(Graph& graph, const Polynomial& polynomial) {
  const auto arguments = trigonometric_arguments(graph, polynomial);
  std::map<Monomial, int, LeadingFirst> occurrences;
  for (const Expression& u : arguments) {
    for (const auto& [monomial, coefficient] : multiplied_out(u)) {
      if (++occurrences[monomial] > 1 || !coefficient.is_one()) return arguments.size() > 1;
    }
  }
  return false;
}

std::size_t count(const Graph& graph, NodeId id, std::map<NodeId, std::size_t>& done);

std::size_t count_terms(const Graph& graph, const Sum& sum, std::map<NodeId, std::size_t>& done) {
  std::size_t operations = sum.terms.size() - 1;
  for (const NodeId id : sum.terms) operations += count(graph, id, done);
  return operations;
}

std::size_t count_factors(const Graph& graph, const Product& product, std::map<NodeId, std::size_t>& done) {
  const bool bare = product.coefficient.is_one() || product.coefficient == Number(-1);
  std::size_t operations = product.factors.size() - (bare ? 1 : 0);
  if (!product.coefficient.is_integer()) ++operations;
  for (const NodeId id : product.factors) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    const bool quotient = power != nullptr && power->exponent == Number(-1);
    operations += quotient ? count(graph, power->base, done) : count(graph, id, done);
  }
  return operations;
}

std::size_t count(const Graph& graph, NodeId id, std::map<NodeId, std::size_t>& done) {
  const auto found = done.find(id);
  if (found != done.end()) return found->second;
  const std::size_t operations = std::visit(
      overloaded{[](const Literal& x) { return std::size_t{x.value.is_integer() ? 0U : 1U}; },
                 [](const Symbol&) { return std::size_t{0}; },
                 [&](const Sum& x) { return count_terms(graph, x, done); },
                 [&](const Product& x) { return count_factors(graph, x, done); },
                 [&](const Power& x) { return 1 + count(graph, x.base, done); },
                 [&](const Call& x) { return 1 + count(graph, x.argument, done); }},
      graph.node(id));
  done.emplace(id, operations);
  return operations;
}

}  // namespace

Expression expand(const Expression& e) { return to_expression(e.graph(), multiplied_out(e)); }

Expression simplify(const Expression& e) {
  Graph& graph = e.graph();
  const Polynomial start = joined(graph, multiplied_out(e));
  Candidate best = candidate(graph, start);
  if (arguments_depend(graph, start)) {
    Candidate other = candidate(graph, joined(graph, with_single_angles(graph, start)));
    if (other.cost < best.cost) best = std::move(other);
  }
  for (bool improved = true; improved;) {
    improved = false;
    for (Polynomial& next : neighbours(graph, best.polynomial)) {
      Candidate other = candidate(graph, std::move(next));
      if (other.cost >= best.cost) continue;
      best = std::move(other);
      improved = true;
      break;
    }
  }
  return best.form;
}

Expression simplify_quotient(const Expression& numerator, const Expression& denominator) {
  Graph& graph = numerator.graph();
  Polynomial above = multiplied_out(simplify(numerator));
  if (above.empty()) return graph.number(0);
  const Expression below = simplify(denominator);
  Polynomial rest = multiplied_out(below);
  const Monomial common = common_monomial(rest);
  rest = scaled(rest, inverse(common), 1);
  above = scaled(above, inverse(common), 1);
  for (const NodeId id : children(below.node())) {  // brackets such as 1 + mu sin^2(phi)
    const Polynomial bracket = multiplied_out(split_power({graph, id}).base);
    if (bracket.size() < 2) continue;
    while (true) {
      const auto a = exact_quotient(above, bracket);
      const auto b = exact_quotient(rest, bracket);
      if (!a || !b) break;
      above = *a;
      rest = *b;
    }
  }
  if (const auto whole = exact_quotient(above, rest)) return simplify(to_expression(graph, *whole));
  return simplify(to_expression(graph, above)) / simplify(to_expression(graph, rest));
}

std::size_t operation_count(const Expression& e) {
  std::map<NodeId, std::size_t> done;
  return count(e.graph(), e.id(), done);
}

}  // namespace qdot
