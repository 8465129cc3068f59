#include "core/mechanics/canonical.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/jumps.hpp"

namespace qdot {
namespace {

/// L = q'.A q'/2 + a.q' + L0 in the velocities of the chosen coordinates; A, a and L0 may contain the others.
struct QuadraticForm {
  Matrix mass;                     ///< A
  std::vector<Expression> linear;  ///< a
  Expression rest;                 ///< L0
};

/// No value where L is not quadratic.
std::optional<QuadraticForm> quadratic_form(const Lagrangian& lagrangian,
                                            const std::vector<std::size_t>& chosen) {
  const std::vector<Expression>& rate = lagrangian.symbols.coordinates.rate;
  std::vector<Replacement> at_rest;
  for (const std::size_t i : chosen) at_rest.emplace_back(rate[i], lagrangian.graph->number(0));
  QuadraticForm form{{}, {}, substitute(lagrangian.lagrangian, at_rest)};
  for (const std::size_t i : chosen) {
    const Expression momentum = differentiate(lagrangian.lagrangian, rate[i]);
    form.mass.emplace_back();
    for (const std::size_t j : chosen) {
      form.mass.back().push_back(simplify(differentiate(momentum, rate[j])));
      if (depends_on(form.mass.back().back(), rate)) return std::nullopt;
    }
    form.linear.push_back(substitute(momentum, at_rest));
  }
  return form;
}

/// The same where A has an inverse that can be written.
std::optional<QuadraticForm> solvable_form(const Lagrangian& lagrangian,
                                           const std::vector<std::size_t>& chosen) {
  if (chosen.empty() || chosen.size() > largest_written_system) return std::nullopt;
  auto form = quadratic_form(lagrangian, chosen);
  if (form && simplify(determinant(form->mass)).is_zero()) form.reset();
  return form;
}

/// p - a.
std::vector<Expression> kinetic_momenta(const Lagrangian& lagrangian, const std::vector<std::size_t>& chosen,
                                        const QuadraticForm& form) {
  const std::vector<Expression> p = momentum_symbols(lagrangian);
  std::vector<Expression> difference;
  for (std::size_t k = 0; k < chosen.size(); ++k) difference.push_back(p[chosen[k]] - form.linear[k]);
  return difference;
}

/// v.adj(A) u: the opposite of the determinant of A bordered by u and v.
Expression adjugate_form(const Matrix& a, const std::vector<Expression>& u,
                         const std::vector<Expression>& v) {
  Matrix bordered = a;
  for (std::size_t k = 0; k < u.size(); ++k) bordered[k].push_back(u[k]);
  bordered.push_back(v);
  bordered.back().push_back(u[0].graph().number(0));
  return -determinant(bordered);
}

/// By what sines and cosines say of each other, or in lowest terms, where that is shorter.
Expression short_quotient(const Expression& above, const Expression& below) {
  const Expression known = simplify_quotient(above, below);
  try {
    const Expression lowest = to_expression(above.graph(), rational_function(known));
    return written_length(lowest) < written_length(known) ? lowest : known;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return known;
  }
}

/// The terms with the momentum k apart from the others: those may have a factor that all together have not.
Expression kinetic_beside(std::size_t k, std::vector<Expression> difference, const Matrix& mass,
                          const Expression& divisor) {
  Graph& graph = divisor.graph();
  const Expression own = std::exchange(difference[k], graph.number(0));
  std::vector<Expression> unit(difference.size(), graph.number(0));
  unit[k] = graph.number(1);
  const auto part = [&](const std::vector<Expression>& u, const std::vector<Expression>& v) {
    return short_quotient(adjugate_form(mass, u, v), divisor);
  };
  return own * own * part(unit, unit) + Number(2) * own * part(unit, difference) +
         part(difference, difference);
}

/// (p - a).A^-1 (p - a)/2.
Expression kinetic_in_momenta(const std::vector<Expression>& difference, const QuadraticForm& form) {
  const Expression divisor = Number(2) * determinant(form.mass);
  Expression best = simplify_quotient(adjugate_form(form.mass, difference, difference), divisor);
  for (std::size_t k = 0; k < difference.size() && difference.size() > 1; ++k) {
    const Expression apart = kinetic_beside(k, difference, form.mass, divisor);
    if (written_length(apart) < written_length(best)) best = apart;
  }
  return best;
}

/// The groups of velocities that A couples with each other, by their places in it.
std::vector<std::vector<std::size_t>> coupled_groups(const Matrix& mass) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<bool> seen(mass.size());
  for (std::size_t start = 0; start < mass.size(); ++start) {
    if (seen[start]) continue;
    std::vector<std::size_t> group{start};
    seen[start] = true;
    for (std::size_t k = 0; k < group.size(); ++k) {
      for (std::size_t j = 0; j < mass.size(); ++j) {
        if (seen[j] || mass[group[k]][j].is_zero()) continue;
        seen[j] = true;
        group.push_back(j);
      }
    }
    std::ranges::sort(group);
    groups.push_back(std::move(group));
  }
  return groups;
}

/// T of many velocities, which is written group by group; no value where a group is too large.
std::optional<Expression> kinetic_by_groups(const std::vector<Expression>& difference,
                                            const QuadraticForm& form) {
  std::vector<Expression> terms;
  for (const std::vector<std::size_t>& group : coupled_groups(form.mass)) {
    if (group.size() > largest_written_system) return std::nullopt;
    QuadraticForm part{{}, {}, form.rest};
    std::vector<Expression> momenta;
    for (const std::size_t i : group) {
      momenta.push_back(difference[i]);
      part.mass.emplace_back();
      for (const std::size_t j : group) part.mass.back().push_back(form.mass[i][j]);
    }
    if (simplify(determinant(part.mass)).is_zero()) return std::nullopt;
    terms.push_back(kinetic_in_momenta(momenta, part));
  }
  return form.rest.graph().sum(terms);
}

/// T in the momenta; no value where it is too large to be written.
std::optional<Expression> kinetic_energy(const std::vector<Expression>& difference,
                                         const QuadraticForm& form) {
  if (difference.size() > largest_written_system) return kinetic_by_groups(difference, form);
  return kinetic_in_momenta(difference, form);
}

/// T - L0, with V in it as it is written or not, and what is free of the momenta in T beside L0, or beside
/// its part of T: the shortest, since terms of the two may cancel.
Expression joined_with_rest(const Expression& kinetic, const Lagrangian& lagrangian,
                            const QuadraticForm& form) {
  Graph& graph = kinetic.graph();
  std::optional<Expression> v = lagrangian.potential_energy;
  if (v && depends_on(*v, lagrangian.symbols.coordinates.rate)) v.reset();
  std::vector<Expression> forms{kinetic - simplify(form.rest)};
  if (v) forms.push_back(kinetic - simplify(form.rest + *v) + *v);
  if (!std::ranges::all_of(form.linear, &Expression::is_zero)) {
    std::vector<Replacement> zeros;
    for (const Expression& p : momentum_symbols(lagrangian)) zeros.emplace_back(p, graph.number(0));
    const Expression without = substitute(kinetic, zeros);
    const Expression with_momenta = simplify(kinetic - without);
    forms.push_back(with_momenta + simplify(without - form.rest));
    if (v) forms.push_back(with_momenta + simplify(without - (form.rest + *v)) + simplify(*v));
  }
  return *std::ranges::min_element(forms, {}, &written_length);
}

std::vector<std::size_t> all_coordinates(const Lagrangian& lagrangian) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < lagrangian.symbols.coordinates.value.size(); ++i) all.push_back(i);
  return all;
}

}  // namespace

std::vector<Expression> momentum_symbols(const Lagrangian& lagrangian) {
  std::vector<Expression> symbols;
  for (const std::string& name : momentum_names(lagrangian.symbols))
    symbols.push_back(lagrangian.graph->symbol(name));
  return symbols;
}

std::optional<CanonicalEquations> canonical_equations(const Lagrangian& lagrangian) {
  const auto form = quadratic_form(lagrangian, all_coordinates(lagrangian));
  if (!form) return std::nullopt;
  CanonicalEquations result{form->mass, {}, form->linear, {}};
  if (form->mass.size() == 2) result.determinant = simplify(determinant(form->mass));
  const std::vector<Expression>& q = lagrangian.symbols.coordinates.value;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Expression slope = differentiate(lagrangian.lagrangian, q[i]);
    result.forces.push_back(simplify(slope) + lagrangian.generalized_forces[i]);
  }
  return result;
}

std::optional<Expression> hamiltonian(const Lagrangian& lagrangian) {
  const std::vector<std::size_t> all = all_coordinates(lagrangian);
  const auto form =
      all.size() > largest_written_system ? quadratic_form(lagrangian, all) : solvable_form(lagrangian, all);
  if (!form) return std::nullopt;
  const auto kinetic = kinetic_energy(kinetic_momenta(lagrangian, all, *form), *form);
  if (!kinetic) return std::nullopt;
  return joined_with_rest(*kinetic, lagrangian, *form);
}

std::vector<std::size_t> ignorable_coordinates(const Lagrangian& lagrangian) {
  std::vector<std::size_t> found;
  const SmoothedJumps smoothed(lagrangian.lagrangian, lagrangian.symbols);
  for (const std::size_t i : all_coordinates(lagrangian)) {
    const Expression slope = differentiate(smoothed.smooth(), lagrangian.symbols.coordinates.value[i]);
    if (lagrangian.generalized_forces[i].is_zero() && simplify(slope).is_zero()) found.push_back(i);
  }
  return found;
}

std::optional<Routhian> routhian(const Lagrangian& lagrangian) {
  const std::vector<std::size_t> ignored = ignorable_coordinates(lagrangian);
  if (ignored.size() == lagrangian.symbols.coordinates.value.size()) return std::nullopt;
  const auto form = solvable_form(lagrangian, ignored);
  if (!form) return std::nullopt;
  const std::vector<Expression> difference = kinetic_momenta(lagrangian, ignored, *form);
  const Expression rest = simplify_by_degree(form->rest, lagrangian.symbols);
  return Routhian{rest - kinetic_in_momenta(difference, *form), ignored, cramer(form->mass, difference)};
}

}  // namespace qdot
