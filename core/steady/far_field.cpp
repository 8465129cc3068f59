#include "core/steady/far_field.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "core/base/error.hpp"
#include "core/compile/tape_builder.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/expr/polynomial.hpp"
#include "core/numerics/box.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_unknowns = 3, most_pieces = 4000;
constexpr int farthest_power = 49;  ///< 2^49 is nearly as far as is searched

/// c x_1^k_1 x_2^k_2 ...
struct Term {
  std::vector<int> exponents;
  int degree{};
  Interval c;
};

/// One force.
class Form {
 public:
  void add(Term term) {
    if (is_zero(term.c)) return;
    degree_ = std::max(degree_, term.degree);
    terms_.push_back(std::move(term));
  }

  /// A bound of |g_D| over directions.
  [[nodiscard]] double least(const Box& direction) const {
    Interval sum = 0;
    for (const Term& term : terms_) {
      if (term.degree != degree_) continue;
      Interval product = term.c;
      for (std::size_t k = 0; k < direction.size(); ++k) {
        if (term.exponents[k] > 0) product = product * power(direction[k], Interval(term.exponents[k]));
      }
      sum = sum + product;
    }
    return sum.contains(0.0) || !sum.is_finite() ? 0 : sum.least_magnitude();
  }

  /// The first power of two beyond which the others are less than that.
  [[nodiscard]] std::optional<double> outweighs(double least) const {
    for (int k = 0; k <= farthest_power; ++k) {
      Interval others = 0;
      for (const Term& term : terms_) {
        if (term.degree < degree_)
          others =
              others + Interval(term.c.magnitude()) * Interval(std::ldexp(1, k * (term.degree - degree_)));
      }
      if (others.upper < least) return std::ldexp(1, k);
    }
    return std::nullopt;
  }

 private:
  std::vector<Term> terms_;
  int degree_{};
};

/// The exponents of the unknowns in a monomial, which they are taken out of; none where they are no whole
/// numbers, or stand in other atoms.
std::optional<std::vector<int>> take_exponents(Graph& graph, Monomial& monomial,
                                               const std::vector<Expression>& unknowns) {
  std::vector<int> exponents(unknowns.size());
  for (const Atom& atom : monomial) {
    const Expression base(graph, atom.base);
    const auto k = static_cast<std::size_t>(std::ranges::find(unknowns, base) - unknowns.begin());
    const bool is_unknown = k < unknowns.size();
    if (is_unknown ? atom.p < 0 || atom.q != 1
                   : std::ranges::any_of(unknowns, [&](const auto& x) { return depends_on(base, x); }))
      return std::nullopt;
    if (is_unknown) exponents[k] = atom.p;
  }
  std::erase_if(monomial, [&](const Atom& atom) {
    return std::ranges::find(unknowns, Expression(graph, atom.base)) != unknowns.end();
  });
  return exponents;
}

/// Empty where some force is no polynomial.
std::vector<Form> forms_of(const SteadyProblem& problem) {
  const SteadyForces& forces = *problem.forces;
  const Reduction& reduction = problem.statics->reduction;
  Graph graph(*forces.graph);
  std::vector<Expression> constants, unknowns;
  for (const Expression& c : reduction.constants) constants.push_back(graph.adopt(c));
  for (const std::size_t j : forces.unknowns) unknowns.push_back(graph.adopt(reduction.x[j]));
  TapeBuilder tape(graph, constants, graph.symbol("t"), {});
  std::vector<std::pair<std::size_t, Term>> terms;
  for (std::size_t i = 0; i < forces.equations.size(); ++i) {
    for (const auto& [whole, number] : multiplied_out(graph.adopt(forces.rest[forces.equations[i]]))) {
      Monomial monomial = whole;
      const auto exponents = take_exponents(graph, monomial, unknowns);
      if (!exponents) return {};
      int degree = 0;
      for (const int exponent : *exponents) degree += exponent;
      tape.output(number * to_expression(graph, monomial));
      terms.emplace_back(i, Term{*exponents, degree, {}});
    }
  }
  const CompiledFunction compiled = tape.finish();
  TapeEvaluator<Interval> coefficients(compiled, problem.constants);
  std::vector<Interval> values(terms.size());
  coefficients({}, values);
  std::vector<Form> forms(forces.equations.size());
  for (std::size_t k = 0; k < terms.size(); ++k) {
    terms[k].second.c = values[k];
    forms[terms[k].first].add(std::move(terms[k].second));
  }
  return forms;
}

/// Directions, and beyond which one of the forms does not vanish in any of them; infinite where none is
/// known.
struct Piece {
  Box directions;
  double radius{};
  bool operator<(const Piece& other) const { return radius < other.radius; }
};

Piece piece_of(const std::vector<Form>& forms, Box directions) {
  double radius = infinity;
  for (const Form& form : forms) {
    const double least = form.least(directions);
    if (least > 0) radius = std::min(radius, form.outweighs(least).value_or(infinity));
  }
  return {std::move(directions), radius};
}

/// The piece of the largest radius is halved again and again: the narrower, the smaller it is.
std::optional<double> radius_of_all(const std::vector<Form>& forms, std::size_t unknowns) {
  std::priority_queue<Piece> pieces;
  for (std::size_t face = 0; face < unknowns; ++face) {
    Box directions(unknowns, Interval(-1, 1));
    directions[face] = 1;
    pieces.push(piece_of(forms, std::move(directions)));
  }
  const BoxUnits units(std::vector<double>(unknowns, 1.0));
  while (pieces.size() < most_pieces && units.width(pieces.top().directions) > 0) {
    auto [left, right] = units.halves(pieces.top().directions);
    pieces.pop();
    pieces.push(piece_of(forms, std::move(left)));
    pieces.push(piece_of(forms, std::move(right)));
  }
  const double radius = pieces.top().radius;
  return std::isfinite(radius) ? std::optional(radius) : std::nullopt;
}

}  // namespace

std::optional<double> farthest_zero(const SteadyProblem& problem) {
  const std::size_t unknowns = problem.forces->unknowns.size();
  if (unknowns > most_unknowns || problem.forces->smooth.kinks() > 0) return std::nullopt;
  try {
    const std::vector<Form> forms = forms_of(problem);
    return forms.empty() ? std::nullopt : radius_of_all(forms, unknowns);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return std::nullopt;
  }
}

}  // namespace qdot
