#include "core/steady/shared_shift.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compile/tape_evaluator.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/rational_function.hpp"
#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

constexpr double nearly_none = 1e-9;

/// K by rows, at one place.
std::vector<Interval> stiffness_somewhere(const SteadyProblem& problem) {
  std::vector<Interval> x, k(problem.forces->stiffness.outputs());
  for (std::size_t j = 0; j < problem.statics->reduction.kept.size(); ++j)
    x.emplace_back(0.37 + 0.11 * static_cast<double>(j * j));
  TapeEvaluator<Interval>(problem.forces->stiffness, problem.constants)(x, k);
  return k;
}

/// Whether rows of K have no sum over these columns, at one place, to rounding: else no algebra is needed.
bool may_be_shared(const SteadyProblem& problem, const std::vector<std::size_t>& columns) {
  const std::size_t n = problem.statics->reduction.kept.size();
  const std::vector<Interval> k = stiffness_somewhere(problem);
  for (const std::size_t i : problem.forces->equations) {
    double sum = 0, size = 0;
    for (const std::size_t j : columns) {
      sum += k[i * n + j].middle();
      size += std::abs(k[i * n + j].middle());
    }
    if (!(std::abs(sum) <= nearly_none * size)) return false;
  }
  return true;
}

/// No force changes when the same is added to these coordinates.
bool is_shared(const SteadyProblem& problem, const std::vector<std::size_t>& columns) {
  Graph graph = *problem.forces->graph;
  for (const std::size_t i : problem.forces->equations) {
    const Expression g = graph.adopt(problem.forces->rest[i]);
    Expression sum = graph.number(0);
    for (const std::size_t j : columns)
      sum = sum + differentiate(g, graph.adopt(problem.statics->reduction.x[j]));
    if (!rational_function(sum).is_zero()) return false;
  }
  return true;
}

/// Whether K has no inverse at one place, to rounding.
bool may_have_shift(const SteadyProblem& problem) {
  const std::vector<std::size_t>&rows = problem.forces->equations, &columns = problem.forces->unknowns;
  const std::size_t n = problem.statics->reduction.kept.size();
  const std::vector<Interval> all = stiffness_somewhere(problem);
  Eigen::MatrixXd k(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j)
      k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = all[rows[i] * n + columns[j]].middle();
  }
  return k.allFinite() && rank(k, nearly_none) < k.cols();
}

}  // namespace

std::vector<std::size_t> shared_shift(const Scene& scene, const SteadyProblem& problem) {
  if (problem.forces->smooth.kinks() > 0) return {};
  const auto unit = [&](std::size_t j) { return scene.coordinates[problem.statics->reduction.kept[j]].unit; };
  const std::vector<std::size_t>& unknowns = problem.forces->unknowns;
  for (const std::size_t first : unknowns) {
    std::vector<std::size_t> alike;
    std::ranges::copy_if(unknowns, std::back_inserter(alike),
                         [&](std::size_t j) { return unit(j) == unit(first); });
    if (alike.front() != first || alike.size() < 2) continue;
    if (may_be_shared(problem, alike) && is_shared(problem, alike)) return alike;
  }
  return {};
}

WrittenChange shift_in_ratio(const SteadyProblem& problem) {
  const std::vector<std::size_t>& unknowns = problem.forces->unknowns;
  if (problem.forces->smooth.kinks() > 0 || unknowns.size() < 2 || !may_have_shift(problem)) return {};
  for (WrittenChange& shift : symmetric_shifts(*problem.statics)) {
    const bool is_of_unknowns = std::ranges::any_of(
        shift, [&](const auto& each) { return std::ranges::find(unknowns, each.first) != unknowns.end(); });
    if (is_of_unknowns) return std::move(shift);
  }
  return {};
}

}  // namespace qdot
