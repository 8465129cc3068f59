#include "core/grading/surface_states.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/grading/ball_system.hpp"

namespace qdot {
namespace {

constexpr int most_steps_to_surface = 40;
constexpr int steps_in_double_doubles = 3;
constexpr double size_of_place = 1e-24;  // of the box about it

using Rows = std::vector<std::vector<Ball>>;

/// Columns in which the rows are independent, by elimination with the largest pivots; none: they are not.
std::optional<std::vector<std::size_t>> pivot_columns(const Rows& rows) {
  std::vector<std::vector<double>> m;
  for (const auto& row : rows) {
    m.emplace_back();
    for (const Ball& entry : row) m.back().push_back(entry.value());
  }
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < m.size(); ++k) {
    std::size_t row = k, column = 0;
    for (std::size_t i = k; i < m.size(); ++i) {
      for (std::size_t j = 0; j < m[i].size(); ++j) {
        if (std::abs(m[i][j]) > std::abs(m[row][column])) row = i, column = j;
      }
    }
    if (!(std::abs(m[row][column]) > 0)) return std::nullopt;
    std::swap(m[k], m[row]);
    columns.push_back(column);
    for (std::size_t i = k + 1; i < m.size(); ++i) {
      const double factor = m[i][column] / m[k][column];
      for (std::size_t j = 0; j < m[i].size(); ++j) m[i][j] -= factor * m[k][j];
      m[i][column] = 0;
    }
  }
  std::ranges::sort(columns);
  return columns;
}

double largest(const std::vector<Ball>& x) {
  double size = 0;
  for (const Ball& component : x) size = std::max(size, component.magnitude());
  return size;
}

Ball middle_of(const Ball& ball) { return {ball.middle, 0}; }

/// A A^T.
Rows products_of_rows(const Rows& a) {
  Rows gram;
  for (const auto& row : a) {
    gram.emplace_back();
    for (const auto& other : a)
      gram.back().push_back(std::inner_product(row.begin(), row.end(), other.begin(), Ball(0.0)));
  }
  return gram;
}

std::vector<Expression> roots_of(const std::vector<Expression>& phi,
                                 const std::vector<std::vector<Expression>>& slope,
                                 const std::vector<Expression>& drift) {
  std::vector<Expression> roots = phi;
  for (const auto& row : slope) roots.insert(roots.end(), row.begin(), row.end());
  roots.insert(roots.end(), drift.begin(), drift.end());
  return roots;
}

std::vector<ConstraintEquation> holonomic_first(const ExpectedSystem& system) {
  std::vector<ConstraintEquation> constraints = system.constraints();
  std::stable_partition(constraints.begin(), constraints.end(),
                        [](const ConstraintEquation& c) { return c.position.has_value(); });
  return constraints;
}

std::vector<Expression> positions_of(const ExpectedSystem& system) {
  std::vector<Expression> phi;
  for (const ConstraintEquation& constraint : holonomic_first(system)) {
    if (constraint.position) phi.push_back(*constraint.position);
  }
  return phi;
}

std::vector<std::vector<Expression>> slopes_of(const ExpectedSystem& system) {
  std::vector<std::vector<Expression>> slopes;
  for (const ConstraintEquation& constraint : holonomic_first(system)) slopes.push_back(constraint.slope);
  return slopes;
}

std::vector<Expression> drifts_of(const ExpectedSystem& system) {
  std::vector<Replacement> at_rest;
  for (const Expression& rate : system.symbols().coordinates.rate)
    at_rest.emplace_back(rate, system.graph().number(0));
  std::vector<Expression> drifts;
  for (const ConstraintEquation& constraint : holonomic_first(system))
    drifts.push_back(substitute(constraint.rate, at_rest));
  return drifts;
}

}  // namespace

SurfaceStates::SurfaceStates(const ExpectedSystem& system)
    : symbols_(system.domains()),
      phi_(positions_of(system)),
      slope_(slopes_of(system)),
      drift_(drifts_of(system)),
      n_(system.degrees_of_freedom()),
      values_(roots_of(phi_, slope_, drift_)) {
  const auto first =
      std::ranges::find(symbols_, system.symbols().coordinates.value[0], &SymbolDomain::symbol);
  first_coordinate_ = static_cast<std::size_t>(first - symbols_.begin());
}

bool SurfaceStates::move(State& state) {
  for (std::size_t i = 0; i < state.size(); ++i) values_.set(symbols_[i].symbol, state[i]);
  const auto q = state.begin() + static_cast<std::ptrdiff_t>(first_coordinate_);
  const auto middle = q + static_cast<std::ptrdiff_t>(n_);
  q_.assign(q, middle);
  rate_.assign(middle, middle + static_cast<std::ptrdiff_t>(n_));
  if (!find_place() || !solve_rates() || !is_inside()) return false;
  place_.clear();
  for (std::size_t i = 0; i < n_; ++i) place_.emplace_back(symbols_[first_coordinate_ + i].symbol, q_[i]);
  for (std::size_t i = 0; i < n_; ++i)
    place_.emplace_back(symbols_[first_coordinate_ + n_ + i].symbol, rate_[i]);
  for (std::size_t i = 0; i < place_.size(); ++i) state[first_coordinate_ + i] = place_[i].second.value();
  return true;
}

bool SurfaceStates::find_place() {
  if (!phi_.empty()) return approach() && enclose();
  evaluate();
  return true;
}

bool SurfaceStates::approach() {
  std::vector<std::size_t> all(n_);
  std::iota(all.begin(), all.end(), 0);
  for (int step = 0; step < most_steps_to_surface; ++step) {
    evaluate();
    const Rows a = slopes(phi_.size(), all);
    const auto along = solved(products_of_rows(a), seen(phi_));
    if (!along) return false;
    double length = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      Ball way(0.0);
      for (std::size_t k = 0; k < a.size(); ++k) way = way + a[k][i] * (*along)[k];
      length = std::max(length, std::abs(way.value()));
      q_[i] = Ball(q_[i].value() - way.value());
    }
    if (!std::isfinite(length)) return false;
    if (length <= 1e-13 * (1 + largest(q_))) return true;
  }
  return false;
}

bool SurfaceStates::enclose() {
  std::vector<std::size_t> all(n_);
  std::iota(all.begin(), all.end(), 0);
  const auto columns = pivot_columns(slopes(phi_.size(), all));
  if (!columns) return false;
  for (int step = 0; step < steps_in_double_doubles; ++step) {
    evaluate();
    const auto way = solved(slopes(phi_.size(), *columns), seen(phi_));
    if (!way) return false;
    for (std::size_t k = 0; k < columns->size(); ++k)
      q_[(*columns)[k]] = middle_of(q_[(*columns)[k]] - (*way)[k]);
  }
  evaluate();
  const auto inverse = inverted(slopes(phi_.size(), *columns));
  if (!inverse) return false;
  const std::vector<Ball> residuals = seen(phi_);
  const double radius = size_of_place * (1 + largest(q_));
  for (const std::size_t i : *columns) q_[i].radius = radius;
  evaluate();
  const auto image = krawczyk_image(*inverse, residuals, slopes(phi_.size(), *columns), radius);
  if (!image) return false;
  for (std::size_t k = 0; k < columns->size(); ++k)
    q_[(*columns)[k]] = middle_of(q_[(*columns)[k]]) + (*image)[k];
  evaluate();
  return true;
}

/// A_dependent q'_dependent = -(A_free q'_free + b).
bool SurfaceStates::solve_rates() {
  std::vector<std::size_t> all(n_);
  std::iota(all.begin(), all.end(), 0);
  const Rows a = slopes(slope_.size(), all);
  const auto columns = pivot_columns(a);
  if (!columns) return false;
  for (const std::size_t i : *columns) rate_[i] = Ball(0.0);
  std::vector<Ball> rest = seen(drift_);
  for (std::size_t k = 0; k < a.size(); ++k)
    rest[k] = -std::inner_product(a[k].begin(), a[k].end(), rate_.begin(), rest[k]);
  const auto dependent = solved(slopes(slope_.size(), *columns), rest);
  if (!dependent) return false;
  for (std::size_t k = 0; k < columns->size(); ++k) rate_[(*columns)[k]] = (*dependent)[k];
  return true;
}

bool SurfaceStates::is_inside() const {
  for (std::size_t i = 0; i < n_; ++i) {
    const Domain& domain = symbols_[first_coordinate_ + i].domain;
    if (!(q_[i].value() > domain.lower && q_[i].value() < domain.upper)) return false;
  }
  return true;
}

void SurfaceStates::evaluate() {
  for (std::size_t i = 0; i < n_; ++i) values_.set(symbols_[first_coordinate_ + i].symbol, q_[i]);
  values_.evaluate();
}

std::vector<Ball> SurfaceStates::seen(const std::vector<Expression>& expressions) const {
  std::vector<Ball> balls;
  for (const Expression& e : expressions) balls.push_back(values_.of(e));
  return balls;
}

Rows SurfaceStates::slopes(std::size_t count, const std::vector<std::size_t>& columns) const {
  Rows rows;
  for (std::size_t k = 0; k < count; ++k) {
    rows.emplace_back();
    for (const std::size_t i : columns) rows.back().push_back(values_.of(slope_[k][i]));
  }
  return rows;
}

}  // namespace qdot
