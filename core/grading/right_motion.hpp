#pragma once
// The accelerations of the right motion, M q'' = f, and with constraints their multipliers
// (expected_system.hpp), at sampled states and in letters.

#include <optional>
#include <span>
#include <vector>

#include "core/grading/ball_values.hpp"
#include "core/grading/expected_system.hpp"
#include "core/grading/surface_states.hpp"
#include "core/grading/vanishing.hpp"

namespace qdot {

using BallMatrix = std::vector<std::vector<Ball>>;

class RightMotion {
 public:
  /// Keeps a reference to the system.
  explicit RightMotion(const ExpectedSystem& system);

  /// What a state is made of.
  [[nodiscard]] std::span<const SymbolDomain> symbols() const { return symbols_; }

  /// Sets a state and the unknowns of the motion there; with constraints the state is moved to their surface
  /// first. False where S is singular or something has no value.
  [[nodiscard]] bool set(State& state, BallValues& values);
  // Of the last state:
  /// The system's unknowns.
  [[nodiscard]] const std::vector<Ball>& solution() const { return solution_; }
  /// S.
  [[nodiscard]] BallMatrix matrix() const;

  /// e with the unknowns written out by Cramer's rule; none for more than that is done for, or where it grows
  /// too long; with constraints also where that does not vanish, because on their surface it may.
  [[nodiscard]] std::optional<Expression> in_letters(const Expression& e) const;

 private:
  [[nodiscard]] std::vector<Ball> of(const std::vector<Expression>& expressions) const;
  [[nodiscard]] std::optional<Expression> written_out(const Expression& e) const;

  const ExpectedSystem& system_;
  std::vector<SymbolDomain> symbols_;
  BallValues values_;
  std::optional<SurfaceStates> surface_;
  std::vector<Ball> solution_;
};

}  // namespace qdot
