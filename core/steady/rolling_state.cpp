#include "core/steady/rolling_state.hpp"

#include <algorithm>

#include "core/numerics/enclosed_system.hpp"
#include "core/numerics/linear_system.hpp"
#include "core/steady/small_motions.hpp"
#include "core/steady/state_eigensystem.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot {
namespace {

SolvedSlopes solved_rows(const SteadyRolling& motion, bool all) {
  BallMatrix rows;
  for (std::size_t j = 0; j < motion.slope.size(); ++j) {
    if (all || motion.holonomic[j]) rows.push_back(motion.slope[j]);
  }
  return solved_slopes(std::move(rows), motion.mass.size());
}

bool all_zero(const BallMatrix& rows) {
  return std::ranges::all_of(rows, [](const auto& row) {
    return std::ranges::all_of(row, [](const Ball& b) { return b.is_zero(); });
  });
}

bool all_zero(const SquareMatrix<Ball>& a) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (!a(i, j).is_zero()) return false;
    }
  }
  return true;
}

std::vector<Ball> column_of(const BallMatrix& a, std::size_t k) {
  std::vector<Ball> column;
  for (const auto& row : a) column.push_back(row[k]);
  return column;
}

Ball product(const SquareMatrix<Ball>& a, std::size_t i, const std::vector<Ball>& x) {
  Ball sum(0);
  for (std::size_t j = 0; j < x.size(); ++j) sum = sum + a(i, j) * x[j];
  return sum;
}

/// Z^T M Z by rows.
std::vector<Ball> projected(const SquareMatrix<Ball>& mass, const BallMatrix& z, std::size_t f) {
  std::vector<Ball> result;
  for (std::size_t a = 0; a < f; ++a) {
    for (std::size_t b = 0; b < f; ++b) {
      Ball sum(0);
      for (std::size_t i = 0; i < z.size(); ++i) sum = sum + z[i][a] * product(mass, i, column_of(z, b));
      result.push_back(sum);
    }
  }
  return result;
}

}  // namespace

RollingState::RollingState(const SteadyRolling& motion)
    : motion_(motion), n_(motion.mass.size()), of_rates_(solved_rows(motion, true)) {
  if (n_ > largest_system) undetermined_on_surface("it has too many coordinates for the bounds.");
  const SolvedSlopes of_places = solved_rows(motion, false);
  d_ = of_places.free.size() + of_rates_.free.size();
  reversible_ = all_zero(motion.rates) && all_zero(motion.drift);
  write_departures(of_places);
  write_matrix(of_places);
  take_out_what_drives_nothing();
}

/// Y u: the rates that the constraints ask for at u.
std::vector<Ball> RollingState::held_back(const std::vector<Ball>& u) const {
  std::vector<Ball> result(n_, Ball(0)), drift;
  for (const auto& row : motion_.drift) {
    Ball sum(0);
    for (std::size_t i = 0; i < n_; ++i) sum = sum + row[i] * u[i];
    drift.push_back(sum);
  }
  for (std::size_t k = 0; k < of_rates_.dependent.size(); ++k) {
    Ball& rate = result[of_rates_.dependent[k]];
    for (std::size_t j = 0; j < drift.size(); ++j) rate = rate - of_rates_.inverse[k][j] * drift[j];
  }
  return result;
}

void RollingState::write_departures(const SolvedSlopes& of_places) {
  place_.assign(n_, std::vector<Ball>(d_, Ball(0)));
  rate_ = place_;
  const std::size_t places = of_places.free.size();
  for (std::size_t k = 0; k < places; ++k) {
    const std::vector<Ball> u = column_of(of_places.allowed, k), asked = held_back(u);
    for (std::size_t i = 0; i < n_; ++i) place_[i][k] = u[i], rate_[i][k] = asked[i];
  }
  for (std::size_t k = places; k < d_; ++k) {
    for (std::size_t i = 0; i < n_; ++i) rate_[i][k] = of_rates_.allowed[i][k - places];
  }
}

void RollingState::write_matrix(const SolvedSlopes& of_places) {
  const BallMatrix& z = of_rates_.allowed;
  const std::size_t places = of_places.free.size(), f = of_rates_.free.size();
  matrix_.assign(d_, std::vector<Ball>(d_, Ball(0)));
  const std::vector<Ball> mass = projected(motion_.mass, z, f);
  for (std::size_t k = 0; k < d_; ++k) {
    const std::vector<Ball> u = column_of(place_, k), rate = column_of(rate_, k), asked = held_back(rate);
    for (std::size_t i = 0; i < places; ++i) matrix_[i][k] = rate[of_places.free[i]];
    std::vector<Ball> right(f, Ball(0));
    for (std::size_t i = 0; i < n_; ++i) {
      const Ball force = product(motion_.mass, i, asked) + product(motion_.rates, i, rate) +
                         product(motion_.stiffness, i, u);
      for (std::size_t a = 0; a < f; ++a) right[a] = right[a] - z[i][a] * force;
    }
    if (std::ranges::all_of(right, [](const Ball& b) { return b.is_zero(); })) continue;
    solve_linear(f, mass, right);
    for (std::size_t a = 0; a < f; ++a) matrix_[places + a][k] = right[a];
  }
}

void RollingState::take_out_what_drives_nothing() {
  for (std::size_t k = 0; k < d_; ++k) active_.push_back(k);
  const auto drives_nothing = [&](std::size_t k) {
    return std::ranges::all_of(active_, [&](std::size_t i) { return matrix_[i][k].is_zero(); });
  };
  for (auto found = std::ranges::find_if(active_, drives_nothing); found != active_.end();
       found = std::ranges::find_if(active_, drives_nothing)) {
    removed_.push_back(*found);
    active_.erase(found);
  }
}

std::vector<std::vector<ComplexBall>> RollingState::free_displacements() const {
  std::vector<std::size_t> places;  // of xi; those without a rate are at first all zeros
  for (const std::size_t k : removed_) {
    if (!all_zero({column_of(place_, k)}) && all_zero({column_of(matrix_, k)})) places.push_back(k);
  }
  std::ranges::sort(places);
  SquareMatrix<Ball> slopes(std::max(places.size(), motion_.slope.size()));
  for (std::size_t j = 0; j < motion_.slope.size(); ++j) {
    for (std::size_t c = 0; c < places.size(); ++c) {
      for (std::size_t i = 0; i < n_; ++i)
        slopes(j, c) = slopes(j, c) + motion_.slope[j][i] * place_[i][places[c]];
    }
  }
  std::vector<std::vector<ComplexBall>> shapes;
  for (const auto& weights : kernel(slopes)) {
    std::vector<ComplexBall> u(n_);
    bool is_place = false;  // not of the columns that only fill the square
    for (std::size_t c = 0; c < places.size(); ++c) {
      is_place = is_place || magnitude(weights[c]) > 0;
      for (std::size_t i = 0; i < n_; ++i) u[i] = u[i] + ComplexBall(place_[i][places[c]]) * weights[c];
    }
    if (is_place) shapes.push_back(std::move(u));
  }
  return shapes.empty() ? shapes : echelon_form(std::move(shapes));
}

Eigensystem<ComplexBall> RollingState::eigenvalues() const {
  const std::size_t size = active_.size();
  if (size == 0) return {{}, {}, SquareMatrix<ComplexBall>(0), {}, {}};
  SquareMatrix<ComplexBall> a(size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      const Ball& entry = matrix_[active_[i]][active_[j]];
      if (!entry.is_finite()) undetermined_on_surface("its masses determine no accelerations there.");
      a(i, j) = entry;
    }
  }
  return state_eigensystem(a);
}

std::vector<ComplexBall> RollingState::shape(const Eigensystem<ComplexBall>& found, std::size_t i) const {
  std::vector<ComplexBall> xi(d_);
  for (std::size_t k = 0; k < active_.size(); ++k) {
    ComplexBall& entry = xi[active_[k]] = found.vectors(k, i);
    const double bound = found.bounds[k * active_.size() + i];
    entry.re.radius += bound;
    entry.im.radius += bound;
  }
  ComplexBall s = found.values[i];
  s.re.radius = s.im.radius = found.radii[i];
  if (s.re.contains_zero() && s.im.contains_zero()) return displacement(xi);
  for (auto k = removed_.rbegin(); k != removed_.rend(); ++k) {  // s xi_k = sum of R_kj xi_j
    ComplexBall sum;
    for (std::size_t j = 0; j < d_; ++j) {
      if (!matrix_[*k][j].is_zero()) sum = sum + ComplexBall(matrix_[*k][j]) * xi[j];
    }
    xi[*k] = sum / s;
  }
  return displacement(xi);
}

std::vector<ComplexBall> RollingState::displacement(const std::vector<ComplexBall>& xi) const {
  std::vector<ComplexBall> u(n_);
  for (std::size_t r = 0; r < n_; ++r) {
    for (std::size_t k = 0; k < d_; ++k) u[r] = u[r] + ComplexBall(place_[r][k]) * xi[k];
  }
  return u;
}

}  // namespace qdot
