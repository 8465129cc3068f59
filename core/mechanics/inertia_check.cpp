#include "core/mechanics/inertia_check.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/expr/calculus.hpp"
#include "core/numerics/ball.hpp"
#include "core/numerics/random_bits.hpp"

namespace qdot {
namespace {

constexpr unsigned enough = 6, most_tried = 60;  // states that have a value, and others
constexpr double sharp = 1e-18;  ///< of what it is the difference of: twice the digits leave some 1e-30

using Rows = std::vector<std::vector<Ball>>;

/// Sizes from 0.1 to 3.1, every second time of both signs: a Lagrangian may have values for small or large
/// velocities only.
std::vector<RealAssignment> state_number(unsigned state, const Matrix& matrix) {
  RandomBits random(state);
  const auto value = [&random, state] {
    const double part = random.fraction();
    const double size = 0.1 + 3 * part * part;
    return random.fraction() < 0.5 && state % 2 == 1 ? -size : size;
  };
  std::vector<NodeId> roots;
  for (const auto& row : matrix) {
    for (const Expression& e : row) roots.push_back(e.id());
  }
  Graph& graph = matrix[0][0].graph();
  std::vector<RealAssignment> values;
  for (const NodeId id : reachable(graph, roots)) {
    const auto* symbol = std::get_if<Symbol>(&graph.node(id));
    if (symbol != nullptr && symbol->name != "pi") values.emplace_back(Expression(graph, id), value());
  }
  return values;
}

/// What the terms of e are like in size, so that a difference that vanishes shows.
double size_of(const Expression& e, const std::vector<RealAssignment>& values) {
  double size = std::abs(evaluate_exactly(e, values).value);
  if (const auto* sum = std::get_if<Sum>(&e.node())) {
    for (const NodeId id : sum->terms)
      size = std::max(size, std::abs(evaluate_exactly({e.graph(), id}, values).value));
  }
  return size;
}

/// Rows divided by their sizes; what vanishes in its row is zero. None where an entry has no value.
std::optional<Rows> scaled_rows(const Matrix& matrix, const std::vector<RealAssignment>& values) {
  Rows rows;
  for (const auto& row : matrix) {
    double size = 0;
    for (const Expression& e : row) size = std::max(size, size_of(e, values));
    if (!std::isfinite(size)) return std::nullopt;
    rows.emplace_back();
    for (const Expression& e : row) {
      const Real entry = evaluate_exactly(e, values);
      if (!entry.is_finite() || entry.error > sharp * size) return std::nullopt;
      const bool vanishes = std::abs(entry.value) <= sharp * size;
      rows.back().push_back(vanishes ? Ball(0) : Ball::literal(entry) / Ball(size));
    }
  }
  return rows;
}

/// By elimination with the largest pivots.
bool is_singular(Rows rows) {
  const std::size_t n = rows.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t row = k, column = k;
    for (std::size_t i = k; i < n; ++i) {
      for (std::size_t j = k; j < n; ++j) {
        if (rows[i][j].magnitude() > rows[row][column].magnitude()) std::tie(row, column) = std::pair(i, j);
      }
    }
    if (rows[row][column].magnitude() <= sharp) return true;
    std::swap(rows[k], rows[row]);
    for (auto& r : rows) std::swap(r[k], r[column]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Ball factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < n; ++j) rows[i][j] = rows[i][j] - factor * rows[k][j];
    }
  }
  return false;
}

bool has_no_inertia(const std::vector<Ball>& row) {
  return std::ranges::all_of(row, [](const Ball& entry) { return entry.is_zero(); });
}

}  // namespace

std::optional<InertiaFault> inertia_fault(const Matrix& mass_matrix) {
  std::optional<InertiaFault> fault;
  unsigned singular = 0;
  for (unsigned state = 0; state < most_tried && singular < enough; ++state) {
    const auto rows = scaled_rows(mass_matrix, state_number(state, mass_matrix));
    if (!rows) continue;
    if (!is_singular(*rows)) return std::nullopt;
    if (singular++ > 0) continue;
    fault.emplace();
    for (std::size_t i = 0; i < rows->size(); ++i) {
      if (has_no_inertia((*rows)[i])) fault->coordinates.push_back(i);
    }
  }
  return fault;
}

}  // namespace qdot
