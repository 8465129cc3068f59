#include "core/expr/simplify.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "core/base/error.hpp"
#include "core/expr/common_denominator.hpp"
#include "core/expr/factored_form.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

/// Identities are tried one by one in expressions of up to so many terms and angles.
constexpr std::size_t most_terms_searched = 200;
constexpr std::size_t most_angles_searched = 8;
constexpr std::size_t most_terms_opened = 40;

/// A polynomial with its short form and what that costs.
struct Candidate {
  Polynomial polynomial;
  Expression form;
  std::size_t cost;
};

Candidate candidate(Graph& graph, Polynomial polynomial) {
  const Expression form = factored_form(graph, polynomial);
  return {std::move(polynomial), form, written_length(form)};
}

/// All polynomials one identity away.
std::vector<Polynomial> neighbours(Graph& graph, const Polynomial& polynomial) {
  std::vector<Polynomial> found = over_common_denominators(graph, polynomial);
  for (const Expression& u : trigonometric_arguments(graph, polynomial)) {
    for (Polynomial next :
         {without_sine_squares(graph, polynomial, u), without_cosine_squares(graph, polynomial, u),
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

/// The shortest form that identities reach, one after the other.
Expression short_form(const Expression& e) {
  Graph& graph = e.graph();
  const Polynomial start = joined(graph, multiplied_out(e));
  Candidate best = candidate(graph, start);
  if (start.size() > most_terms_searched ||
      trigonometric_arguments(graph, start).size() > most_angles_searched) {
    return best.form;
  }
  if (start.size() > 1 && arguments_depend(graph, start)) {
    const Polynomial opened = with_single_angles(graph, start);
    if (opened.size() <= most_terms_opened) {
      Candidate other = candidate(graph, joined(graph, opened));
      if (other.cost < best.cost) best = std::move(other);
    }
  }
  std::vector<Polynomial> tried{start, best.polynomial};
  for (bool improved = true; improved;) {
    improved = false;
    for (Polynomial& next : neighbours(graph, best.polynomial)) {
      if (std::ranges::find(tried, next) != tried.end()) continue;  // the way back, or a second way
      tried.push_back(next);
      Candidate other = candidate(graph, std::move(next));
      if (other.cost >= best.cost) continue;
      best = std::move(other);
      improved = true;
      break;
    }
  }
  return best.form;
}

/// What a polynomial has to be divided by for no power in it to be negative.
Monomial lowest_powers(const Polynomial& polynomial) {
  Monomial lowest;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      const int less = std::min(atom.p, 0) - exponent_of(lowest, atom.base);
      if (atom.q == 1 && less < 0) lowest = times(lowest, atom.base, less);
    }
  }
  return lowest;
}

/// What stands in front of each product of functions.
void add_coefficients(const Graph& graph, const Polynomial& polynomial, std::vector<Polynomial>& found) {
  const Monomial below = inverse(lowest_powers(polynomial));
  std::map<Monomial, Polynomial, LeadingFirst> by_functions;
  for (const auto& [monomial, coefficient] : polynomial) {
    Monomial functions, symbols;
    for (const Atom& atom : monomial* below)
      (std::holds_alternative<Call>(graph.node(atom.base)) ? functions : symbols).push_back(atom);
    add(by_functions[functions], symbols, coefficient);
  }
  for (auto& [functions, coefficient] : by_functions) found.push_back(std::move(coefficient));
}

/// A sum of symbols that divides both, as R - r does. None where that would take long to tell.
std::optional<Polynomial> common_sum(const Graph& graph, const Polynomial& a, const Polynomial& b) {
  constexpr std::size_t most_terms = 12;
  std::vector<Polynomial> all;
  add_coefficients(graph, a, all);
  add_coefficients(graph, b, all);
  std::ranges::stable_sort(all, {}, &Polynomial::size);
  if (all.back().size() > most_terms) return std::nullopt;
  Polynomial common = all[0];
  for (auto next = all.begin() + 1; common.size() > 1 && next != all.end(); ++next)
    common = greatest_common_divisor(common, *next);
  return common.size() > 1 ? std::optional(common) : std::nullopt;
}

}  // namespace

Expression simplify(const Expression& e) {
  if (const auto known = e.graph().simplified(e)) return *known;
  const Expression form = short_form(e);
  e.graph().keep_simplified(e, form);
  return form;
}

Expression simplify_quotient(const Expression& numerator, const Expression& denominator) {
  Graph& graph = numerator.graph();
  Polynomial above = multiplied_out(simplify(numerator));
  const Expression below = simplify(denominator);
  Polynomial rest = multiplied_out(below);
  if (rest.empty()) throw Error(ErrorCode::not_applicable, "The denominator vanishes identically.");
  if (above.empty()) return graph.number(0);
  const Monomial common = common_monomial(rest);
  rest = scaled(rest, inverse(common), 1);
  above = scaled(above, inverse(common), 1);
  for (const NodeId id : children(below.node())) {  // brackets such as 1 + mu sin^2(phi)
    const Polynomial bracket = multiplied_out(split_power({graph, id}).base);
    while (bracket.size() > 1) {
      const auto a = trigonometric_quotient(graph, above, bracket);
      const auto b = trigonometric_quotient(graph, rest, bracket);
      if (!a || !b) break;
      above = *a;
      rest = *b;
    }
  }
  if (const auto sum = common_sum(graph, above, rest)) {
    above = *exact_quotient(above, *sum);
    rest = *exact_quotient(rest, *sum);
  }
  if (const auto whole = trigonometric_quotient(graph, above, rest))
    return simplify(to_expression(graph, *whole));
  return simplify(to_expression(graph, above)) / simplify(to_expression(graph, rest));
}

}  // namespace qdot
