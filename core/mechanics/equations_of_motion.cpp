#include "core/mechanics/equations_of_motion.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/kept_terms.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/solved_by_substitution.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

/// What a bracket may cost that may divide an equation.
constexpr std::uint64_t most_division = 300'000;
/// What the solution of more unknowns than Cramer's rule is used for may cost, and how long it may be.
constexpr std::uint64_t most_substitution = 1'000'000;
constexpr std::size_t longest_solution = 150;

/// Lagrange's equation of coordinate i, with left - right multiplied out.
struct RawEquation {
  Polynomial left, right;
};

RawEquation raw_equation(const Lagrangian& lagrangian, std::size_t i) {
  const Symbols& symbols = lagrangian.symbols;
  const Expression momentum = differentiate(lagrangian.lagrangian, symbols.coordinates.rate[i]);
  const Expression left = total_derivative(momentum, symbols.rates()) -
                          differentiate(lagrangian.lagrangian, symbols.coordinates.value[i]);
  return {multiplied_out(simplify(left)), multiplied_out(lagrangian.generalized_forces[i])};
}

/// Brackets in the diagonal of M, such as 1/2 + sin(theta), may divide the whole equation.
std::vector<Expression> brackets(const Expression& diagonal) {
  std::vector<Expression> found;
  const auto* product = std::get_if<Product>(&diagonal.node());
  std::vector<NodeId> factors = product != nullptr ? product->factors : std::vector<NodeId>{diagonal.id()};
  for (const NodeId id : factors) {
    const Expression base = split_power({diagonal.graph(), id}).base;
    if (std::holds_alternative<Sum>(base.node())) found.push_back(base);
  }
  return found;
}

/// The equation divided by the bracket; none where it is no factor, or where to find that out takes too much.
std::optional<RawEquation> quotient(Graph& graph, const RawEquation& equation, const Expression& bracket) {
  const WorkScope budget(most_division);
  try {
    const Polynomial by = multiplied_out(bracket);
    auto left = trigonometric_quotient(graph, equation.left, by);
    auto right = trigonometric_quotient(graph, equation.right, by);
    if (left && right) return RawEquation{*std::move(left), *std::move(right)};
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
  }
  return std::nullopt;
}

Monomial common_monomial(const RawEquation& equation) {
  Polynomial both = equation.left;
  add(both, equation.right, Number(-1));
  return both.empty() ? Monomial{} : common_monomial(both);
}

/// Divides both sides by everything they share but velocities, accelerations and multipliers; returns what it
/// was.
Expression divide(const Lagrangian& lagrangian, RawEquation& equation, const Expression& diagonal) {
  Graph& graph = *lagrangian.graph;
  const Symbols::Varying& q = lagrangian.symbols.coordinates;
  Monomial common = common_monomial(equation);
  std::erase_if(common, [&](const Atom& atom) {
    const Expression base(graph, atom.base);
    return atom.q != 1 || depends_on(base, q.rate) || depends_on(base, q.second_rate) ||
           depends_on(base, lagrangian.symbols.multipliers);
  });
  equation.left = scaled(equation.left, inverse(common), 1);
  equation.right = scaled(equation.right, inverse(common), 1);
  Expression divisor = to_expression(graph, common);
  for (const Expression& bracket : brackets(diagonal)) {
    auto divided = quotient(graph, equation, bracket);
    if (!divided) continue;
    equation = *std::move(divided);
    divisor = divisor * bracket;
  }
  return divisor;
}

std::vector<Replacement> without_accelerations(const Lagrangian& lagrangian) {
  std::vector<Replacement> result;
  for (const Expression& acceleration : lagrangian.symbols.coordinates.second_rate) {
    result.emplace_back(acceleration, lagrangian.graph->number(0));
  }
  return result;
}

/// Whether terms without velocities, or of the generalized force, are kept as they are written.
bool has_kept_terms(const Lagrangian& lagrangian, std::size_t i) {
  const Expression of_l = split_kept_terms(lagrangian.lagrangian).kept;
  const Expression of_force = split_kept_terms(lagrangian.generalized_forces[i]).kept;
  return (!of_l.is_zero() || !of_force.is_zero()) && !depends_on(of_l, lagrangian.symbols.coordinates.rate);
}

/// (Q - (d/dt dL/dq' - dL/dq) without accelerations)/divisor, with those terms' slopes as they are.
Expression forcing_as_written(const Lagrangian& lagrangian, std::size_t i, const Expression& divisor) {
  const Symbols::Varying& q = lagrangian.symbols.coordinates;
  const Terms l = split_kept_terms(lagrangian.lagrangian);
  const Terms force = split_kept_terms(lagrangian.generalized_forces[i]);
  const Expression momentum = differentiate(l.plain, q.rate[i]);
  const Expression left =
      total_derivative(momentum, lagrangian.symbols.rates()) - differentiate(l.plain, q.value[i]);
  const Expression plain = force.plain - substitute(left, without_accelerations(lagrangian));
  return simplify_quotient(plain, divisor) + differentiate(l.kept, q.value[i]) / divisor +
         force.kept / divisor;
}

/// f + C lambda in its two parts.
void split_reactions(const Lagrangian& lagrangian, EquationsOfMotion& equations) {
  const std::vector<Expression>& multipliers = lagrangian.symbols.multipliers;
  std::vector<Replacement> none;
  for (const Expression& lambda : multipliers) none.emplace_back(lambda, lagrangian.graph->number(0));
  for (Expression& force : equations.forcing) {
    equations.reactions.emplace_back();
    for (const Expression& lambda : multipliers)
      equations.reactions.back().push_back(simplify(differentiate(force, lambda)));
    if (!multipliers.empty()) force = substitute(force, none);
  }
}

}  // namespace

EquationsOfMotion derive_equations(const Lagrangian& lagrangian) {
  Graph& graph = *lagrangian.graph;
  const Symbols::Varying& q = lagrangian.symbols.coordinates;
  const std::vector<Replacement> at_rest = without_accelerations(lagrangian);
  EquationsOfMotion result;
  for (std::size_t i = 0; i < q.value.size(); ++i) {
    RawEquation raw = raw_equation(lagrangian, i);
    const Expression diagonal = simplify(differentiate(to_expression(graph, raw.left), q.second_rate[i]));
    Expression divisor = divide(lagrangian, raw, diagonal);
    if (raw.right.empty() && !raw.left.empty()) {  // a number in front of everything says nothing
      const Number number = split_coefficient(simplify(to_expression(graph, raw.left))).coefficient;
      raw.left = scaled(raw.left, {}, Number(1) / number);
      divisor = number * divisor;
    }
    const Expression left = to_expression(graph, raw.left);
    const Expression right = to_expression(graph, raw.right);
    result.equations.push_back({simplify(left), simplify(right), divisor});
    result.mass_matrix.emplace_back();
    for (const Expression& acceleration : q.second_rate) {
      result.mass_matrix.back().push_back(simplify(differentiate(left, acceleration)));
    }
    result.forcing.push_back(has_kept_terms(lagrangian, i) ? forcing_as_written(lagrangian, i, divisor)
                                                           : simplify(right - substitute(left, at_rest)));
  }
  split_reactions(lagrangian, result);
  if (q.value.size() == 2) result.determinant = simplify(determinant(result.mass_matrix));
  return result;
}

Matrix mass_matrix(const Lagrangian& lagrangian) {
  Matrix result;
  for (const Expression& momentum : conjugate_momenta(lagrangian)) {
    result.emplace_back();
    for (const Expression& rate : lagrangian.symbols.coordinates.rate) {
      result.back().push_back(simplify(differentiate(momentum, rate)));
    }
  }
  return result;
}

AugmentedSystem augmented(const EquationsOfMotion& equations, const Lagrangian& lagrangian) {
  const std::vector<ConstraintEquation>& constraints = lagrangian.constraints;
  AugmentedSystem system{equations.mass_matrix, equations.forcing,
                         lagrangian.symbols.coordinates.second_rate};
  for (std::size_t i = 0; i < equations.reactions.size(); ++i) {
    for (const Expression& reaction : equations.reactions[i]) system.matrix[i].push_back(-reaction);
  }
  for (const ConstraintEquation& constraint : constraints) {
    system.matrix.push_back(constraint.slope);
    system.matrix.back().resize(system.matrix.front().size(), lagrangian.graph->number(0));
    system.right.push_back(-constraint.rest);
  }
  const std::vector<Expression>& multipliers = lagrangian.symbols.multipliers;
  system.unknowns.insert(system.unknowns.end(), multipliers.begin(), multipliers.end());
  return system;
}

std::vector<Expression> solved(const AugmentedSystem& system) {
  if (system.matrix.size() <= largest_written_system) return cramer(system.matrix, system.right);
  const WorkScope budget(most_substitution);
  std::vector<Expression> solution = solved_by_substitution(system.matrix, system.right);
  const bool is_short = std::ranges::all_of(
      solution, [](const Expression& e) { return written_length(e) <= longest_solution; });
  return is_short ? solution : std::vector<Expression>{};
}

std::vector<Expression> solved_on_constraints(const AugmentedSystem& system, const Lagrangian& lagrangian) {
  std::vector<Expression> solution = solved(system);
  const std::vector<Replacement> held = held_by_constraints(lagrangian.constraints, lagrangian.symbols);
  if (held.empty() || solution.empty()) return solution;
  AugmentedSystem there = system;
  for (std::vector<Expression>& row : there.matrix) {
    for (Expression& entry : row) entry = substitute(entry, held);
  }
  for (Expression& entry : there.right) entry = substitute(entry, held);
  try {
    const std::vector<Expression> other = solved(there);
    for (std::size_t i = 0; i < other.size(); ++i) {
      if (written_length(other[i]) < written_length(solution[i])) solution[i] = other[i];
    }
  } catch (const Error& error) {  // the first solution stands
    if (error.code() != ErrorCode::too_large && error.code() != ErrorCode::not_applicable) throw;
  }
  return solution;
}

}  // namespace qdot
