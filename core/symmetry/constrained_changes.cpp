#include "core/symmetry/constrained_changes.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

using Places = std::vector<std::size_t>;  ///< of coordinates

constexpr std::size_t most_sets = 100;

bool depends_on_place(const Expression& e, const Symbols& symbols) {
  return depends_on(e, symbols.coordinates.value) || depends_on(e, symbols.t);
}

/// Sets of m coordinates, those with the shortest slopes first.
std::vector<Places> sets_of_dependent(const Lagrangian& lagrangian) {
  const std::size_t n = lagrangian.symbols.coordinates.value.size(), m = lagrangian.constraints.size();
  std::vector<std::size_t> length(n);
  for (const ConstraintEquation& constraint : lagrangian.constraints) {
    for (std::size_t i = 0; i < n; ++i) length[i] += written_length(constraint.slope[i]);
  }
  Places order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return length[i]; });
  std::vector<bool> chosen(n);
  std::fill_n(chosen.begin(), m, true);
  std::vector<Places> sets;
  do {
    sets.emplace_back();
    for (std::size_t k = 0; k < n; ++k) {
      if (chosen[k]) sets.back().push_back(order[k]);
    }
  } while (sets.size() < most_sets && std::prev_permutation(chosen.begin(), chosen.end()));
  return sets;
}

Matrix slopes_of(const Lagrangian& lagrangian, const Places& columns) {
  Matrix result;
  for (const ConstraintEquation& constraint : lagrangian.constraints) {
    result.emplace_back();
    for (const std::size_t i : columns) result.back().push_back(constraint.slope[i]);
  }
  return result;
}

/// adj(m) b: Cramer's rule without its division.
std::vector<Expression> times_adjugate(const Matrix& m, const std::vector<Expression>& b) {
  std::vector<Expression> result;
  for (std::size_t k = 0; k < m.size(); ++k) {
    Matrix replaced = m;
    for (std::size_t i = 0; i < m.size(); ++i) replaced[i][k] = b[i];
    result.push_back(simplify(determinant(replaced)));
  }
  return result;
}

ElementaryChange change_of(const Lagrangian& lagrangian, ChangeKind kind, std::size_t i, std::size_t j) {
  const Expression zero = lagrangian.graph->number(0);
  const std::size_t n = lagrangian.symbols.coordinates.value.size();
  return {kind, i, j, {std::vector<Expression>(n, zero), zero, zero}};
}

/// The coordinates whose rates are in omega.
Places turning_coordinates(const Vector& omega, const Symbols& symbols) {
  Places found;
  for (std::size_t i = 0; i < symbols.coordinates.rate.size(); ++i) {
    if (std::ranges::any_of(omega,
                            [&](const Expression& w) { return depends_on(w, symbols.coordinates.rate[i]); }))
      found.push_back(i);
  }
  return found;
}

/// xi with omega(xi) = e for each of the three axes e.
void add_turns(const Lagrangian& lagrangian, const Vector& omega, std::size_t body, ChangeKind kind,
               std::vector<ElementaryChange>& changes) {
  const Symbols& symbols = lagrangian.symbols;
  const Places turning = turning_coordinates(omega, symbols);
  if (turning.size() != 3) return;
  Matrix slopes;
  for (const Expression& w : omega) {
    slopes.emplace_back();
    for (const std::size_t i : turning)
      slopes.back().push_back(simplify(differentiate(w, symbols.coordinates.rate[i])));
  }
  if (simplify(determinant(slopes)).is_zero()) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<Expression> e(3, lagrangian.graph->number(0));
    e[axis] = lagrangian.graph->number(1);
    const std::vector<Expression> xi = cramer(slopes, e);
    if (std::ranges::none_of(xi, [&](const Expression& x) { return depends_on_place(x, symbols); })) continue;
    changes.push_back(change_of(lagrangian, kind, body, axis));
    for (std::size_t k = 0; k < 3; ++k) changes.back().change.shift[turning[k]] = xi[k];
  }
}

}  // namespace

std::optional<AllowedRates> allowed_rates(const Lagrangian& lagrangian) {
  const std::size_t m = lagrangian.constraints.size(), n = lagrangian.symbols.coordinates.value.size();
  if (m == 0 || m > largest_written_system || m > n) return std::nullopt;
  std::optional<AllowedRates> best;
  for (const Places& set : sets_of_dependent(lagrangian)) {
    const Matrix slopes = slopes_of(lagrangian, set);
    const Expression d = simplify(determinant(slopes));
    if (d.is_zero()) continue;
    const bool is_constant = !depends_on_place(d, lagrangian.symbols);
    if (best && !is_constant && written_length(d) >= written_length(best->determinant)) continue;
    best = AllowedRates{set, slopes, d, {}};
    if (is_constant) break;
  }
  if (!best) return best;
  std::vector<Replacement> none;
  const std::vector<Expression>& rate = lagrangian.symbols.coordinates.rate;
  for (const std::size_t i : best->dependent) none.emplace_back(rate[i], lagrangian.graph->number(0));
  std::vector<Expression> right;
  for (const ConstraintEquation& constraint : lagrangian.constraints)
    right.push_back(-substitute(constraint.rate, none));
  const std::vector<Expression> solved = cramer(best->slopes, right);
  for (std::size_t k = 0; k < m; ++k) best->rates.emplace_back(rate[best->dependent[k]], solved[k]);
  return best;
}

std::vector<ElementaryChange> changes_along(const Lagrangian& lagrangian, const AllowedRates& allowed) {
  std::vector<ElementaryChange> changes;
  const auto in_velocities = [](const ConstraintEquation& constraint) { return !constraint.position; };
  if (std::ranges::none_of(lagrangian.constraints, in_velocities)) return changes;
  for (std::size_t f = 0; f < lagrangian.symbols.coordinates.value.size(); ++f) {
    if (std::ranges::find(allowed.dependent, f) != allowed.dependent.end()) continue;
    std::vector<Expression> slope;
    for (const ConstraintEquation& constraint : lagrangian.constraints) slope.push_back(constraint.slope[f]);
    if (std::ranges::all_of(slope, [](const Expression& e) { return e.is_zero(); })) continue;
    ElementaryChange change = change_of(lagrangian, ChangeKind::along, f, f);
    change.change.shift[f] = allowed.determinant;
    const std::vector<Expression> follow = times_adjugate(allowed.slopes, slope);
    for (std::size_t k = 0; k < follow.size(); ++k) change.change.shift[allowed.dependent[k]] = -follow[k];
    changes.push_back(std::move(change));
  }
  return changes;
}

std::vector<ElementaryChange> turns_of_bodies(const ParsedScene& scene, const Lagrangian& lagrangian,
                                              std::span<const Replacement> replacements) {
  Graph& graph = *lagrangian.graph;
  std::vector<Replacement> own;
  for (const auto& [symbol, value] : replacements) own.emplace_back(graph.adopt(symbol), graph.adopt(value));
  const auto put_in = [&](const Expression& e) {
    return substitute(substitute(graph.adopt(e), lagrangian.holding), own);
  };
  std::vector<ElementaryChange> changes;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    std::vector<Turn> turns;
    for (const Turn& turn : scene.bodies[b].turns) {
      turns.push_back({{}, put_in(turn.angle)});
      for (const Expression& component : turn.axis) turns.back().axis.push_back(put_in(component));
    }
    if (turns.empty()) continue;
    const std::vector<Replacement> rates = lagrangian.symbols.rates();
    add_turns(lagrangian, space_angular_velocity(graph, turns, rates), b, ChangeKind::turn, changes);
    add_turns(lagrangian, body_angular_velocity(graph, turns, rates), b, ChangeKind::own_turn, changes);
  }
  return changes;
}

}  // namespace qdot
