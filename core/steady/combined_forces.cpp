#include "core/steady/combined_forces.hpp"

#include <algorithm>
#include <map>

#include "core/expr/kept_terms.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_combinations = 6;
constexpr std::size_t most_shared_terms = 24;

using Coefficients = std::vector<Number>;  ///< for each equation

/// Equations as sums of terms: the coefficients of each term, by its node.
using Table = std::map<NodeId, Coefficients>;

Table table_of(std::span<const Expression> equations) {
  Table table;
  for (std::size_t i = 0; i < equations.size(); ++i) {
    for (const Expression& term : summands(equations[i])) {
      const Scaled scaled = split_coefficient(term);
      auto& coefficients = table.try_emplace(scaled.rest.id(), equations.size()).first->second;
      coefficients[i] = coefficients[i] + scaled.coefficient;
    }
  }
  return table;
}

std::size_t count_nonzero(const Coefficients& c) {
  return c.size() - static_cast<std::size_t>(std::ranges::count_if(c, &Number::is_zero));
}

Number combined(const Coefficients& weights, const Coefficients& c) {
  Number sum;
  for (std::size_t i = 0; i < c.size(); ++i) sum = sum + weights[i] * c[i];
  return sum;
}

/// With 1 as the first that is not 0; empty where all are.
Coefficients normalized(Coefficients c) {
  const auto first = std::ranges::find_if_not(c, &Number::is_zero);
  if (first == c.end()) return {};
  const Number divisor = *first;
  for (Number& value : c) value = value / divisor;
  return c;
}

Coefficients cross(const Coefficients& a, const Coefficients& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Weights with which terms cancel that equations share.
std::vector<Coefficients> cancelling_weights(const std::vector<Coefficients>& shared, std::size_t equations) {
  std::vector<Coefficients> result;
  const auto add = [&](Coefficients weights) {
    weights = normalized(std::move(weights));
    if (!weights.empty() && std::ranges::find(result, weights) == result.end()) result.push_back(weights);
  };
  for (std::size_t k = 0; k < shared.size(); ++k) {
    if (equations == 2) {
      add({shared[k][1], -shared[k][0]});
      continue;
    }
    for (std::size_t l = 0; l < k; ++l) add(cross(shared[k], shared[l]));
  }
  return result;
}

Expression combination(Graph& graph, const Table& table, const Coefficients& weights) {
  std::vector<Expression> terms;
  for (const auto& [term, coefficients] : table) {
    const Number c = combined(weights, coefficients);
    if (!c.is_zero()) terms.push_back(c * Expression(graph, term));
  }
  return graph.sum(terms);
}

}  // namespace

std::vector<Expression> combinations(std::span<const Expression> equations) {
  if (equations.size() < 2 || equations.size() > 3) return {};
  const Table table = table_of(equations);
  std::vector<Coefficients> shared;
  for (const auto& [term, coefficients] : table) {
    if (count_nonzero(coefficients) > 1 && shared.size() < most_shared_terms) shared.push_back(coefficients);
  }
  const auto length_with = [&](const Coefficients& weights) {
    return std::ranges::count_if(
        table, [&](const auto& entry) { return !combined(weights, entry.second).is_zero(); });
  };
  std::vector<std::pair<std::ptrdiff_t, Coefficients>> found;
  for (Coefficients& weights : cancelling_weights(shared, equations.size())) {
    const auto length = length_with(weights);
    if (length > 0 && count_nonzero(weights) > 1) found.emplace_back(length, std::move(weights));
  }
  std::ranges::stable_sort(found, {}, &std::pair<std::ptrdiff_t, Coefficients>::first);
  if (found.size() > most_combinations) found.resize(most_combinations);
  std::vector<Expression> result;
  for (const auto& [length, weights] : found)
    result.push_back(combination(equations[0].graph(), table, weights));
  return result;
}

}  // namespace qdot
