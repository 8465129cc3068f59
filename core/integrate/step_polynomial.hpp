#pragma once
// The dense output of a step as polynomials: the method's own, or through its values at nine Chebyshev
// points.

#include <optional>
#include <span>
#include <vector>

#include "core/integrate/stepper.hpp"

namespace qdot {

/// The polynomials of a piece in times since `by` seconds later.
void shift_rows(std::span<double> rows, unsigned order, double by);

class StepPolynomial {
 public:
  enum class Look { rough, exact };

  /// Of the stepper's last step; rough: by its sketch. An Ending where the dense output failed.
  [[nodiscard]] std::optional<Ending> take(Stepper& stepper, Look look);

  /// Whether that is the dense output itself, or might be off.
  [[nodiscard]] bool is_exact() const { return is_exact_; }
  [[nodiscard]] const MotionPiece& whole() const { return whole_; }
  /// From whole().t + from on, without its defect. Valid until the next call.
  [[nodiscard]] MotionPiece piece(double from, double length);

 private:
  [[nodiscard]] std::optional<Ending> interpolate(Stepper& stepper, Look look);

  MotionPiece whole_;
  bool is_exact_{};
  std::vector<double> rows_, shifted_;
};

}  // namespace qdot
