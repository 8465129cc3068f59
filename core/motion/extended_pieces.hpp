#pragma once
// A motion in double-doubles, piece by piece: what happens to it between two pieces, an impact or a kink, is
// known from a motion in doubles to that one's error, a billionth of a second, say. It is the zero of a
// function next to the instant that is known,
//
//   g(y(t + d)) = 0,   y(t + d) = sum_j c_j d^j,
//
// found by the secant method, so that the series needs few terms. What is measured so is what rounding did to
// the motion; whether something else happens before is the other computations' to tell.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/motion/extended_motion.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {

/// The outputs of a tape in double-doubles, y = (q, q') as its variables.
class ExtendedFunction {
 public:
  /// Keeps a reference to the function.
  ExtendedFunction(const CompiledFunction& function, std::span<const DoubleDouble> parameters);

  [[nodiscard]] std::vector<DoubleDouble> operator()(const DoubleDouble& t, std::span<const DoubleDouble> y);

 private:
  std::size_t outputs_;
  TapeEvaluator<Ball> evaluator_;
};

/// The rows of the request's grid up to where the motion has come. What happens between two pieces is done to
/// y() by who asks.
class ExtendedPieces {
 public:
  /// At the beginning: t_start and y_start of the request.
  explicit ExtendedPieces(const ExtendedMotionRequest& request);

  /// To t and the rows up to there, or to the end of the grid. False where the motion cannot be followed, or
  /// where the system's margin is used up: it is there then (has_left).
  [[nodiscard]] bool go_to(const ExtendedSystem& system, const DoubleDouble& t);
  [[nodiscard]] bool finish(const ExtendedSystem& system);

  [[nodiscard]] bool has_left() const { return has_left_; }

  using Function = std::function<DoubleDouble(const DoubleDouble& t, std::span<const DoubleDouble> y)>;
  /// To the zero of g beside the place, at most a small part of `duration` away. False where there is none,
  /// or where a row lies between the two, so that it may belong to either side.
  [[nodiscard]] bool jump_at_zero(const ExtendedSystem& system, const Function& g, double duration);
  /// The same, where the state goes on without a jump: a row between the two lies where it is in these
  /// digits.
  [[nodiscard]] bool turn_at_zero(const ExtendedSystem& system, const Function& g, double duration);

  [[nodiscard]] const DoubleDouble& t() const { return piece_.t_start; }
  [[nodiscard]] std::vector<DoubleDouble>& y() { return piece_.y_start; }
  [[nodiscard]] ExtendedRun run() && { return std::move(run_); }

 private:
  [[nodiscard]] bool go_on(const ExtendedSystem& system);
  void pass_on(std::vector<double> passed);
  void drop_last_row();
  [[nodiscard]] std::optional<DoubleDouble> zero_beside(const ExtendedSystem& system, const Function& g,
                                                        double duration);
  void move(const DoubleDouble& d);
  [[nodiscard]] bool has_row_within(double t, double reach) const;

  ExtendedMotionRequest piece_;
  std::vector<DoubleDouble> grid_;
  ExtendedRun run_;
  std::vector<double> largest_;       ///< that was passed, of each component
  bool has_left_{false};              ///< in the last piece
  DoubleDouble known_;                ///< the place where a piece ended in doubles
  std::vector<DoubleDouble> beside_;  ///< the series around it, in units of time of the system
  double unit_{1};                    ///< that one, in seconds
};

}  // namespace qdot
