#pragma once
// The states that obey the constraints: phi(q, t) = 0 and w(q, q', t) = A q' + b = 0
// (core/mechanics/constraints.hpp), and the way back to them.
//
//   [M A^T; A 0] (dq, mu) = (0, -phi), then the same for dq' with -w
//
// is Newton's step to the nearest one, measured by the kinetic energy of the displacement. Source: Hairer,
// Lubich, Wanner, Geometric Numerical Integration, 2nd ed., IV.4 (projection).

#include <memory>
#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/dynamics/inputs.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {

/// What states have to obey, compiled; shared by threads.
class ConstraintSurface {
 public:
  ConstraintSurface(const Model& model, const InputTexts& inputs);

  [[nodiscard]] std::size_t coordinates() const { return n_; }
  [[nodiscard]] std::size_t positions() const { return position_of_.size(); }
  [[nodiscard]] std::size_t constraints() const { return m_; }
  /// Of each phi, the number of its constraint.
  [[nodiscard]] const std::vector<std::size_t>& position_of() const { return position_of_; }

  /// M (n x n), A (m x n), phi, w, then the terms of each phi and of each w; of t and (q, q').
  [[nodiscard]] const CompiledFunction& values() const { return *values_; }
  [[nodiscard]] std::size_t first_slope() const { return n_ * n_; }
  [[nodiscard]] std::size_t first_residual() const { return n_ * (n_ + m_); }
  /// Of residual k, phi before w: where its terms end; they begin where those before end.
  [[nodiscard]] const std::vector<std::size_t>& ends_of_terms() const { return ends_of_terms_; }

 private:
  std::size_t n_, m_;
  std::vector<std::size_t> position_of_, ends_of_terms_;
  std::unique_ptr<const CompiledFunction> values_;
};

/// The surface at one set of parameters, for one thread.
class ConstrainedStates {
 public:
  ConstrainedStates(const ConstraintSurface& surface, std::span<const double> parameters);

  /// False where something has no value.
  [[nodiscard]] bool evaluate(double t, std::span<const double> y);
  // Of the state that was evaluated last, phi before w:
  [[nodiscard]] std::span<const double> residuals() const;
  /// How large the terms are that residual k is the sum of.
  [[nodiscard]] double size_of_terms(std::size_t k, std::span<const double> y) const;
  /// By how much phi k changes along `step`, by its slopes.
  [[nodiscard]] double change(std::size_t k, std::span<const double> step) const;
  /// What takes phi (or w) to `residuals` less: dq or dq', 0 where not free. False where there is none.
  [[nodiscard]] bool step_of_positions(std::span<const double> phi, const std::vector<bool>& free,
                                       std::span<double> step) const;
  [[nodiscard]] bool step_of_rates(std::span<const double> w, const std::vector<bool>& free,
                                   std::span<double> step) const;

  /// Moves a state that is near to the surface: what a step of an integration has left. Returns whether it
  /// could.
  [[nodiscard]] bool project(double t, std::span<double> y);

 private:
  [[nodiscard]] bool step(std::span<const std::size_t> rows, std::span<const double> residuals,
                          const std::vector<bool>& free, std::span<double> step) const;

  const ConstraintSurface& surface_;
  Workspace workspace_;
  std::vector<double> values_;
  std::vector<std::size_t> all_rows_;
};

}  // namespace qdot
