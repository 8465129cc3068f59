#include "core/steady/numerator.hpp"

#include <algorithm>
#include <map>

#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

struct Fraction {
  int p{};
  int q{1};
};

bool less(const Fraction& a, const Fraction& b) { return a.p * b.q < b.p * a.q; }

/// The most negative exponent of each base with one of the variables in it.
std::map<NodeId, Fraction> poles_of(Graph& graph, const Polynomial& polynomial,
                                    std::span<const Expression> variables) {
  std::map<NodeId, Fraction> poles;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      if (atom.p > 0 || !depends_on(Expression(graph, atom.base), variables)) continue;
      Fraction& least = poles[atom.base];
      if (less({atom.p, atom.q}, least)) least = {atom.p, atom.q};
    }
  }
  return poles;
}

bool has_negative_power(const Expression& e, std::span<const Expression> variables) {
  const NodeId root = e.id();
  for (const NodeId id : reachable(e.graph(), {&root, 1})) {
    const auto* power = std::get_if<Power>(&e.graph().node(id));
    if (power != nullptr && power->exponent < Number(0) &&
        depends_on(Expression(e.graph(), power->base), variables)) {
      return true;
    }
  }
  return false;
}

}  // namespace

Expression numerator_of(const Expression& e, std::span<const Expression> variables) {
  if (!has_negative_power(e, variables)) return e;
  Graph& graph = e.graph();
  const Polynomial polynomial = multiplied_out(e);
  Monomial common;
  for (const auto& [base, exponent] : poles_of(graph, polynomial, variables)) {
    common = times(common, base, -exponent.p, exponent.q);
  }
  if (common.empty()) return e;
  return simplify(to_expression(graph, scaled(polynomial, common, Number(1))));
}

std::vector<Expression> denominators_of(const Expression& e, std::span<const Expression> variables) {
  if (!has_negative_power(e, variables)) return {};
  Graph& graph = e.graph();
  std::vector<Expression> found;
  for (const auto& pole : poles_of(graph, multiplied_out(e), variables))
    found.emplace_back(graph, pole.first);
  return found;
}

}  // namespace qdot
