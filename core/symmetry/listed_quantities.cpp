#include "core/symmetry/listed_quantities.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"
#include "core/mechanics/canonical.hpp"
#include "core/symmetry/dependence.hpp"
#include "core/symmetry/random_place.hpp"
#include "core/symmetry/shortened_change.hpp"

namespace qdot {
namespace {

constexpr int most_places = 20;

std::vector<Expression> variables(const Symbols& symbols) {
  std::vector<Expression> result{symbols.t};
  for (const auto* group : {&symbols.coordinates.value, &symbols.coordinates.rate})
    result.insert(result.end(), group->begin(), group->end());
  return result;
}

/// For each of the quantities, whether it is no function of those before it that are not either. All are
/// taken for new where no place with real residues is found (residue.hpp), or arguments are too long.
std::vector<bool> new_ones(const Lagrangian& lagrangian, const std::vector<Expression>& quantities) try {
  const std::vector<Expression> by = variables(lagrangian.symbols);
  std::vector<Expression> gradients;
  for (const Expression& quantity : quantities) {
    for (const Expression& x : by) gradients.push_back(differentiate(quantity, x));
  }
  std::vector<bool> result(quantities.size(), true);
  PlaceEvaluator place(*lagrangian.graph, gradients, lagrangian.symbols.parameters);
  place.keep(1);
  for (int seed = 1; seed <= most_places; ++seed) {
    const auto values = place.values(static_cast<std::uint64_t>(seed));
    if (!values || !std::ranges::all_of(*values, [](const Residue& x) { return x.im.is_zero(); })) continue;
    RowSpace space(by.size());
    for (std::size_t k = 0; k < quantities.size(); ++k) {
      std::vector<Modular> row;
      for (std::size_t i = 0; i < by.size(); ++i) row.push_back((*values)[k * by.size() + i].re);
      result[k] = space.add(std::move(row));
    }
    break;
  }
  return result;
} catch (const Error&) {  // an argument is too long
  return std::vector<bool>(quantities.size(), true);
}

/// Momenta of ignorable coordinates, and what constraints keep at 0 or constant.
std::vector<Expression> known_constants(const Lagrangian& lagrangian) {
  std::vector<Expression> p = integrals_of_constraints(lagrangian);
  for (const ConstraintEquation& constraint : lagrangian.constraints) {
    if (constraint.position) p.push_back(*constraint.position);
    p.push_back(constraint.rate);
  }
  for (const std::size_t i : ignorable_coordinates(lagrangian))
    p.push_back(differentiate(lagrangian.lagrangian, lagrangian.symbols.coordinates.rate[i]));
  return p;
}

}  // namespace

std::vector<ConservedQuantity> listed_quantities(const std::vector<Kept>& all, const Lagrangian& lagrangian) {
  std::vector<Expression> values = known_constants(lagrangian);
  std::vector<const Kept*> measured;
  for (const Kept& one : all) {
    if (one.kind == KindOfChange::linear) values.push_back(one.quantity.value);
    if (one.kind != KindOfChange::linear && one.kind != KindOfChange::in_time) measured.push_back(&one);
  }
  std::ranges::stable_sort(measured, {}, [](const Kept* one) { return std::pair(one->kind, one->spread); });
  std::vector<const Kept*> left_out;
  if (!measured.empty()) {
    const std::vector<Expression> momenta = values;
    for (const Kept* one : measured) values.push_back(one->quantity.value);
    const std::vector<bool> is_new = new_ones(lagrangian, values);
    for (std::size_t k = 0; k < measured.size(); ++k) {
      if (is_new[momenta.size() + k] || measured[k]->kind == KindOfChange::in_space) continue;
      std::vector<Expression> alone = momenta;
      alone.push_back(measured[k]->quantity.value);
      if (measured[k]->kind == KindOfChange::mixed || new_ones(lagrangian, alone).back())
        left_out.push_back(measured[k]);
    }
  }
  std::vector<ConservedQuantity> result;
  for (const Kept& one : all) {
    if (std::ranges::find(left_out, &one) == left_out.end()) result.push_back(one.quantity);
  }
  return result;
}

}  // namespace qdot
