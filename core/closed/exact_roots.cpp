#include "core/closed/exact_roots.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

Expression shorter(const Expression& a, const Expression& b) {
  return written_length(b) < written_length(a) ? b : a;
}

/// a/b: by identities of angles, or in lowest terms.
Expression quotient(const Expression& a, const Expression& b) {
  return shorter(simplify_quotient(a, b), to_expression(a.graph(), rational_function(a / b)));
}

Expression root_of(const Expression& square, const SignOf& sign) {
  return shorter(sqrt(square), positive_root(square.graph(), rational_function(square), sign));
}

}  // namespace

std::vector<Expression> roots_of(const Expression& c0, const Expression& c1, const Expression& c2,
                                 const SignOf& sign) {
  if (c2.is_zero()) return c1.is_zero() ? std::vector<Expression>{} : std::vector{quotient(-c0, c1)};
  if (c1.is_zero()) {
    const Expression root = root_of(quotient(-c0, c2), sign);
    return {root, -root};
  }
  std::vector<Expression> roots;
  for (const Surd& root :
       quadratic_roots(rational_function(c2), rational_function(c1), rational_function(c0)))
    roots.push_back(to_expression(c0.graph(), root));
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
