#pragma once
// The accelerations of the right motion, M q'' = f, at sampled states and in letters.

#include <optional>
#include <span>
#include <vector>

#include "core/grading/ball_values.hpp"
#include "core/grading/expected_system.hpp"
#include "core/grading/vanishing.hpp"

namespace qdot {

using BallMatrix = std::vector<std::vector<Ball>>;

class RightMotion {
 public:
  /// Keeps a reference to the system.
  explicit RightMotion(const ExpectedSystem& system);

  /// What a state is made of.
  [[nodiscard]] std::span<const SymbolDomain> symbols() const { return symbols_; }

  /// False where M is singular or something has no value.
  [[nodiscard]] bool at(const State& state);
  /// Of the last state.
  [[nodiscard]] const std::vector<Ball>& accelerations() const { return accelerations_; }
  [[nodiscard]] BallMatrix mass() const;

  /// Sets the accelerations of a state; false as for at().
  [[nodiscard]] bool set(const State& state, BallValues& values);

  /// e with the accelerations written out by Cramer's rule; none for more coordinates than that is done for,
  /// or where it grows too long.
  [[nodiscard]] std::optional<Expression> in_letters(const Expression& e) const;

 private:
  [[nodiscard]] std::vector<Ball> of(const std::vector<Expression>& expressions) const;

  const ExpectedSystem& system_;
  std::vector<SymbolDomain> symbols_;
  BallValues values_;
  std::vector<Ball> accelerations_;
};

}  // namespace qdot
