#include "core/closed/allowed_motions.hpp"

#include <algorithm>

#include "core/closed/taken_squares.hpp"
#include "core/dynamics/specialization.hpp"
#include "core/expr/rational_function.hpp"
#include "core/mechanics/friction.hpp"
#include "core/steady/solved_slopes.hpp"

namespace qdot {
namespace {

using Rationals = std::vector<std::vector<RationalFunction>>;

std::vector<Replacement> taken_at(const LinearMotions& motions, const ExactPlace& place) {
  std::vector<Replacement> taken;
  const auto take = [&](const Expression& e) {
    if (has_roots(e)) taken.emplace_back(e, place.at(e));
  };
  for (const Expression& force : motions.forces) {
    for (std::size_t j = motions.moving.size(); j < motions.x.size(); ++j)
      take(differentiate(force, motions.x[j]));
  }
  for (const Matrix* matrix : {&motions.mass, &motions.stiffness, &motions.damping}) {
    for (const auto& row : *matrix) std::ranges::for_each(row, take);
  }
  return taken;
}

/// A at the place, a row for each constraint: the forces are g - sum of lambda A.
Rationals slopes(const LinearMotions& motions, const ExactPlace& place, std::size_t n, std::size_t m) {
  Rationals result(m);
  for (std::size_t j = 0; j < m; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const Expression slope = differentiate(motions.forces[i], motions.x[n + j]);
      result[j].push_back(rational_function(place.at(slope)));
    }
  }
  return result;
}

Expression plain(Graph& graph, const RationalFunction& f) {
  return to_expression(graph, f.above) / to_expression(graph, f.below);
}

/// Which coordinates follow the others, as the numbers are.
SolvedSlopes numbers_of(Graph& graph, const Rationals& a, std::size_t n, const ExactValues& values) {
  BallMatrix numbers;
  for (const auto& row : a) {
    numbers.emplace_back();
    for (const RationalFunction& f : row) numbers.back().push_back(Ball(values.value(plain(graph, f)).value));
  }
  return solved_slopes(std::move(numbers), n);
}

/// Z: a row for each coordinate, a column for each that is free.
Rationals allowed(Rationals a, const SolvedSlopes& numbers, std::size_t n) {
  const RationalFunction one{{{Monomial{}, Number(1)}}};
  std::vector<bool> is_used(a.size());
  Rationals z(n, std::vector<RationalFunction>(numbers.free.size()));
  std::vector<std::size_t> row_of;
  for (const std::size_t d : numbers.dependent) {
    std::size_t pivot = 0;
    while (pivot < a.size() && (is_used[pivot] || a[pivot][d].is_zero())) ++pivot;
    if (pivot == a.size()) return {};
    is_used[pivot] = true;
    row_of.push_back(pivot);
    for (std::size_t r = 0; r < a.size(); ++r) {
      if (r == pivot || a[r][d].is_zero()) continue;
      const RationalFunction factor = a[r][d] / a[pivot][d];
      for (std::size_t i = 0; i < n; ++i) a[r][i] = a[r][i] - factor * a[pivot][i];
    }
  }
  for (std::size_t f = 0; f < numbers.free.size(); ++f) {
    z[numbers.free[f]][f] = one;
    for (std::size_t k = 0; k < numbers.dependent.size(); ++k) {
      const std::size_t d = numbers.dependent[k], r = row_of[k];
      z[d][f] = -a[r][numbers.free[f]] / a[r][d];
    }
  }
  return z;
}

/// Z^T a Z at the place.
Matrix within(const Matrix& a, const Rationals& z, const ExactPlace& place, Graph& graph) {
  const std::size_t n = z.size(), free = z[0].size();
  Rationals sum(free, std::vector<RationalFunction>(free));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const RationalFunction entry = rational_function(place.at(a[i][j]));
      if (entry.is_zero()) continue;
      for (std::size_t f = 0; f < free; ++f) {
        for (std::size_t g = 0; g < free; ++g) sum[f][g] = sum[f][g] + z[i][f] * entry * z[j][g];
      }
    }
  }
  Matrix result(free);
  for (std::size_t f = 0; f < free; ++f) {
    for (const RationalFunction& entry : sum[f]) result[f].push_back(plain(graph, entry));
  }
  return result;
}

}  // namespace

std::optional<LinearMotions> motions_with_multipliers(const Model& model, const Reals& parameters) {
  if (!model.scene.inputs.empty() || has_forces_of_multipliers(model.lagrangian)) return std::nullopt;
  const Lagrangian own = specialized(model, {}, vanishing_among(parameters));
  const Reduction reduction = derive_reduction(own, {}, Ignorable::kept);
  if (!reduction.autonomous) return std::nullopt;
  LinearMotions motions = linear_motions(reduction, model.scene);
  for (std::size_t j = 0; j < own.constraints.size(); ++j) {
    const ConstraintEquation& constraint = own.constraints[j];
    if (!is_workless(constraint, own.symbols)) return std::nullopt;
    motions.x.push_back(motions.graph->adopt(own.symbols.multipliers[j]));
    motions.units.push_back(model.parsed.constraints[j].multiplier_unit);
    if (constraint.position) motions.surface.push_back(motions.graph->adopt(*constraint.position));
  }
  return motions;
}

std::optional<LinearMotions> allowed_motions(const LinearMotions& motions, const ExactPlace& place,
                                             const ExactValues& values) {
  const std::size_t n = motions.moving.size(), m = motions.x.size() - n;
  Graph& graph = *motions.graph;
  const Rationals a = slopes(motions, place, n, m);
  const SolvedSlopes numbers = numbers_of(graph, a, n, values);
  const Rationals z = allowed(a, numbers, n);
  if (z.empty() || numbers.free.empty()) return std::nullopt;
  LinearMotions result = motions;
  result.moving = numbers.free;
  result.following = numbers.dependent;
  result.taken = taken_at(motions, place);
  result.mass = within(motions.mass, z, place, graph);
  result.stiffness = within(motions.stiffness, z, place, graph);
  const std::vector<Expression> zeros(numbers.free.size(), graph.number(0));
  result.damping = within(motions.damping, z, place, graph);
  result.following_slopes = Matrix(m, zeros);
  result.following_rates.clear();
  for (const std::size_t d : numbers.dependent) {
    result.following_rates.emplace_back();
    for (const RationalFunction& rate : z[d]) result.following_rates.back().push_back(plain(graph, rate));
  }
  return result;
}

}  // namespace qdot
