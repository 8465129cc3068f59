#include "core/grading/right_motion.hpp"

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/zeroness.hpp"
#include "core/grading/ball_system.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t work_in_letters = 60'000;

std::vector<Expression> entries(const ExpectedSystem& system) {
  std::vector<Expression> all = system.right();
  for (const auto& row : system.matrix()) all.insert(all.end(), row.begin(), row.end());
  return all;
}

/// Cramer's rule, not simplified.
std::vector<Expression> by_determinants(const ExpectedSystem& system) {
  const Expression below = determinant(system.matrix());
  std::vector<Expression> solution;
  for (std::size_t i = 0; i < system.unknowns().size(); ++i) {
    Matrix m = system.matrix();
    for (std::size_t k = 0; k < m.size(); ++k) m[k][i] = system.right()[k];
    solution.push_back(determinant(m) / below);
  }
  return solution;
}

}  // namespace

RightMotion::RightMotion(const ExpectedSystem& system)
    : system_(system), symbols_(system.domains()), values_(entries(system)) {
  if (system.has_constraints()) surface_.emplace(system);
}

bool RightMotion::set(State& state, BallValues& values) {
  if (surface_ && !surface_->move(state)) return false;
  for (BallValues* all : {&values_, &values}) {
    for (std::size_t i = 0; i < state.size(); ++i) all->set(symbols_[i].symbol, state[i]);
    if (!surface_) continue;
    for (const auto& [symbol, value] : surface_->place()) all->set(symbol, value);
  }
  values_.evaluate();
  auto solution = qdot::solved(matrix(), of(system_.right()));
  if (!solution) return false;
  solution_ = std::move(*solution);
  for (std::size_t i = 0; i < solution_.size(); ++i) values.set(system_.unknowns()[i], solution_[i]);
  return true;
}

BallMatrix RightMotion::matrix() const {
  BallMatrix m;
  for (const auto& row : system_.matrix()) m.push_back(of(row));
  return m;
}

std::optional<Expression> RightMotion::in_letters(const Expression& e) const {
  const auto written = written_out(e);
  const bool says_nothing = written && system_.has_constraints() && zeroness(*written) != Zeroness::zero;
  return says_nothing ? std::nullopt : written;
}

std::optional<Expression> RightMotion::written_out(const Expression& e) const {
  if (system_.unknowns().size() > largest_written_system) return std::nullopt;
  try {
    const WorkScope scope(work_in_letters);
    const std::vector<Expression> solution = by_determinants(system_);
    std::vector<Replacement> replacements;
    for (std::size_t i = 0; i < solution.size(); ++i)
      replacements.emplace_back(system_.unknowns()[i], solution[i]);
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
