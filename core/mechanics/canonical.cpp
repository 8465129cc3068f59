#include "core/mechanics/canonical.hpp"

#include "core/expr/linear.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// q_i' of the chosen coordinates from p_i = dL/dq_i', the other velocities left as they are.
std::optional<std::vector<Replacement>> velocities(const Lagrangian& lagrangian, const std::vector<std::size_t>& chosen) {
  if (chosen.empty() || chosen.size() > largest_written_system) return std::nullopt;
  const std::vector<Expression>& rate = lagrangian.symbols.coordinates.rate;
  const std::vector<Expression> p = momentum_symbols(lagrangian);
  const Expression zero = lagrangian.graph->number(0);
  std::vector<Replacement> at_rest;
  for (const std::size_t i : chosen) at_rest.emplace_back(rate[i], zero);
  Matrix mass;
  std::vector<Expression> b;
  for (const std::size_t i : chosen) {
    const Expression momentum = differentiate(lagrangian.lagrangian, rate[i]);
    mass.emplace_back();
    for (const std::size_t j : chosen) {
      mass.back().push_back(simplify(differentiate(momentum, rate[j])));
      if (depends_on(mass.back().back(), rate)) return std::nullopt;
    }
    b.push_back(p[i] - substitute(momentum, at_rest));
  }
  if (simplify(determinant(mass)).is_zero()) return std::nullopt;
  const std::vector<Expression> solution = cramer(mass, b);
  std::vector<Replacement> result;
  for (std::size_t k = 0; k < chosen.size(); ++k) result.emplace_back(rate[chosen[k]], solution[k]);
  return result;
}

std::vector<std::size_t> all_coordinates(const Lagrangian& lagrangian) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < lagrangian.symbols.coordinates.value.size(); ++i) all.push_back(i);
  return all;
}

/// L - sum p_i q_i' over the chosen coordinates, their velocities eliminated.
Expression legendre(const Lagrangian& lagrangian, const std::vector<std::size_t>& chosen,
                    const std::vector<Replacement>& eliminated) {
  const std::vector<Expression> p = momentum_symbols(lagrangian);
  std::vector<Expression> terms{lagrangian.lagrangian};
  for (const std::size_t i : chosen) terms.push_back(-(p[i] * lagrangian.symbols.coordinates.rate[i]));
  return substitute(lagrangian.graph->sum(terms), eliminated);
}

}  // namespace

std::vector<Expression> momentum_symbols(const Lagrangian& lagrangian) {
  std::vector<Expression> symbols;
  for (const Expression& q : lagrangian.symbols.coordinates.value) {
    symbols.push_back(lagrangian.graph->symbol("p_" + std::get<Symbol>(q.node()).name));
  }
  return symbols;
}

std::optional<Expression> hamiltonian(const Lagrangian& lagrangian) {
  const std::vector<std::size_t> all = all_coordinates(lagrangian);
  const auto eliminated = velocities(lagrangian, all);
  if (!eliminated) return std::nullopt;
  return simplify(-legendre(lagrangian, all, *eliminated));
}

std::vector<std::size_t> ignorable_coordinates(const Lagrangian& lagrangian) {
  std::vector<std::size_t> found;
  for (const std::size_t i : all_coordinates(lagrangian)) {
    const Expression slope = differentiate(lagrangian.lagrangian, lagrangian.symbols.coordinates.value[i]);
    if (lagrangian.generalized_forces[i].is_zero() && simplify(slope).is_zero()) found.push_back(i);
  }
  return found;
}

std::optional<Routhian> routhian(const Lagrangian& lagrangian) {
  const std::vector<std::size_t> ignored = ignorable_coordinates(lagrangian);
  if (ignored.size() == lagrangian.symbols.coordinates.value.size()) return std::nullopt;
  const auto eliminated = velocities(lagrangian, ignored);
  if (!eliminated) return std::nullopt;
  Routhian result{simplify_by_degree(legendre(lagrangian, ignored, *eliminated), lagrangian.symbols), ignored, {}};
  for (const Replacement& replacement : *eliminated) result.rates.push_back(replacement.second);
  return result;
}

}  // namespace qdot
