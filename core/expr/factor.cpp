#include "core/expr/factor.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

constexpr std::size_t worthwhile_saving = 4;

Expression grouped(Graph& graph, const Polynomial& polynomial);

bool alike(const Polynomial& polynomial) {
  const Number first = polynomial.begin()->second;
  return std::all_of(polynomial.begin(), polynomial.end(),
                     [&](const auto& term) { return term.second == first || term.second == -first; });
}

/// Numbers worth taking out: one, each coefficient and what divides them all.
std::vector<Number> numeric_factors(const Polynomial& polynomial) {
  std::vector<Number> factors{Number(1)};
  Number divisor(0);
  for (const auto& [monomial, coefficient] : polynomial) {
    if (!coefficient.is_exact()) return factors;
    const Number size = coefficient.is_negative() ? -coefficient : coefficient;
    if (std::find(factors.begin(), factors.end(), size) == factors.end()) factors.push_back(size);
    divisor = divisor.is_zero() ? size : gcd(divisor, size);
  }
  if (std::find(factors.begin(), factors.end(), divisor) == factors.end()) factors.push_back(divisor);
  return factors;
}

/// A power of one symbol or bracket that many terms share, and how many.
struct Shared {
  Atom atom{};
  std::size_t terms{};
};

Shared most_shared(const Polynomial& polynomial) {
  std::map<NodeId, Shared> shared;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      if (atom.p < 0) continue;
      Shared& entry = shared.try_emplace(atom.base, Shared{atom, 0}).first->second;
      ++entry.terms;
      if (atom.p * entry.atom.q < entry.atom.p * atom.q) entry.atom = atom;
    }
  }
  Shared best;
  for (const auto& [base, entry] : shared) {
    if (entry.terms > best.terms) best = entry;
  }
  return best;
}

/// The polynomial without its common monomial and number.
Expression primitive(Graph& graph, const Polynomial& polynomial) {
  if (polynomial.size() > 2) {
    if (const auto root = exact_root(polynomial)) return pow(factored(graph, *root), Number(2));
  }
  return grouped(graph, polynomial);
}

/// polynomial = common (rest), with the number in front that makes the whole shortest.
Expression with_common_factor(Graph& graph, const Polynomial& polynomial, const Monomial& common) {
  const Polynomial rest = scaled(polynomial, inverse(common), 1);
  const Expression front = to_expression(graph, common);
  Expression best;
  std::size_t least = static_cast<std::size_t>(-1);
  for (const Number& number : numeric_factors(rest)) {
    const Expression candidate = number * front * primitive(graph, scaled(rest, {}, Number(1) / number));
    const std::size_t cost = operation_count(candidate);
    if (cost < least) {
      least = cost;
      best = candidate;
    }
  }
  return best;
}

Polynomial terms_with(const Polynomial& polynomial, const Atom& atom) {
  Polynomial found;
  for (const auto& [monomial, coefficient] : polynomial) {
    const bool has = std::any_of(monomial.begin(), monomial.end(),
                                 [&](const Atom& a) { return a.base == atom.base && a.p > 0; });
    if (has) found.emplace_hint(found.end(), monomial, coefficient);
  }
  return found;
}

Expression grouped(Graph& graph, const Polynomial& polynomial) {
  const Shared shared = most_shared(polynomial);
  if (shared.terms < 2) return to_expression(graph, polynomial);
  const Polynomial group = terms_with(polynomial, shared.atom);
  Polynomial others = polynomial;
  add(others, group, Number(-1));
  if (others.empty()) return with_common_factor(graph, polynomial, Monomial{shared.atom});
  const Monomial front = common_monomial(group);
  const Polynomial bracket = scaled(group, inverse(front), 1);
  if (const auto quotient = exact_quotient(others, bracket)) {
    Polynomial cofactor = *quotient;
    add(cofactor, front, 1);
    return factored(graph, cofactor) * factored(graph, bracket);
  }
  return factored(graph, group) + factored(graph, others);
}

}  // namespace

Expression factored(Graph& graph, const Polynomial& polynomial) {
  if (polynomial.size() < 2) return to_expression(graph, polynomial);
  const Monomial common = common_monomial(polynomial);
  const Expression together = with_common_factor(graph, polynomial, common);
  if (common.empty() || alike(polynomial)) return together;
  const Expression apart = to_expression(graph, polynomial);
  return operation_count(together) + worthwhile_saving <= operation_count(apart) ? together : apart;
}

}  // namespace qdot
