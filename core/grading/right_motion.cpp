#include "core/grading/right_motion.hpp"

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/linear.hpp"
#include "core/grading/ball_system.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t work_in_letters = 60'000;

std::vector<Expression> roots(const ExpectedSystem& system) {
  std::vector<Expression> all = system.forcing();
  for (const auto& row : system.mass_matrix()) all.insert(all.end(), row.begin(), row.end());
  return all;
}

/// Cramer's rule, not simplified.
std::vector<Expression> written_out(const ExpectedSystem& system) {
  const Expression below = determinant(system.mass_matrix());
  std::vector<Expression> solution;
  for (std::size_t i = 0; i < system.degrees_of_freedom(); ++i) {
    Matrix m = system.mass_matrix();
    for (std::size_t k = 0; k < m.size(); ++k) m[k][i] = system.forcing()[k];
    solution.push_back(determinant(m) / below);
  }
  return solution;
}

}  // namespace

RightMotion::RightMotion(const ExpectedSystem& system)
    : system_(system), symbols_(system.domains()), values_(roots(system)) {}

bool RightMotion::at(const State& state) {
  for (std::size_t i = 0; i < state.size(); ++i) values_.set(symbols_[i].symbol, state[i]);
  values_.evaluate();
  auto solution = qdot::solved(mass(), of(system_.forcing()));
  if (!solution) return false;
  accelerations_ = std::move(*solution);
  return true;
}

BallMatrix RightMotion::mass() const {
  BallMatrix m;
  for (const auto& row : system_.mass_matrix()) m.push_back(of(row));
  return m;
}

bool RightMotion::set(const State& state, BallValues& values) {
  if (!at(state)) return false;
  const std::vector<Expression>& symbols = system_.symbols().coordinates.second_rate;
  for (std::size_t i = 0; i < symbols.size(); ++i) values.set(symbols[i], accelerations_[i]);
  return true;
}

std::optional<Expression> RightMotion::in_letters(const Expression& e) const {
  if (system_.degrees_of_freedom() > largest_written_system) return std::nullopt;
  try {
    const WorkScope scope(work_in_letters);
    const std::vector<Expression> solution = written_out(system_);
    std::vector<Replacement> replacements;
    for (std::size_t i = 0; i < solution.size(); ++i)
      replacements.emplace_back(system_.symbols().coordinates.second_rate[i], solution[i]);
    return substitute(e, replacements);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return std::nullopt;
  }
}

std::vector<Ball> RightMotion::of(const std::vector<Expression>& expressions) const {
  std::vector<Ball> balls;
  for (const Expression& e : expressions) balls.push_back(values_.of(e));
  return balls;
}

}  // namespace qdot
