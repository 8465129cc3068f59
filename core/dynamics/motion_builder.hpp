#pragma once
// A tape of a model's motion under construction, on a private copy of the model's graph:
//
//   M(q,t) q'' = f(q,q',t)
//
// or, with constraints, [M, -C; A, 0] (q'', lambda) = (f, -rest) (core/mechanics/equations_of_motion.hpp).
// Where f has kinks (core/expr/unfold.hpp) their sides s_k are parameters that follow the model's own. On a
// kink where both sides push the motion to u_k = 0 it stays there: s_k is unknown, too, and there is one more
// equation, u_k'' = 0, or u_k' = 0 where velocities stand in u_k. What acts is then the mean of the two sides
// and s_k times half their difference. Source: Filippov, Differential Equations with Discontinuous Righthand
// Sides (1988), 4, 18 and 19; Utkin, Sliding Modes in Control and Optimization (1992), 2 (equivalent
// control).

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/compile/tape_builder.hpp"
#include "core/dynamics/inputs.hpp"
#include "core/dynamics/staying.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/unfold.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {

class MotionBuilder {
 public:
  /// `graph` is the model's or was copied from it.
  MotionBuilder(const Model& model, const InputTexts& inputs, const Graph& graph);
  /// With kinks unfolded, and staying on some of them; none is needed in an empty list. Throws
  /// Error(not_applicable) where two of them multiply each other or the mass matrix jumps.
  MotionBuilder(const Model& model, const InputTexts& inputs, const Graph& graph, const Staying& staying);
  MotionBuilder(const MotionBuilder&) = delete;
  MotionBuilder& operator=(const MotionBuilder&) = delete;

  [[nodiscard]] Expression expression(const Expression& of_model) const;
  [[nodiscard]] ParsedEvent parsed_event(const std::string& text, const ExponentValues& exponents);

  /// Slots of q''.
  [[nodiscard]] const std::vector<Slot>& accelerations();
  /// Slots of dq''/dy_j for every y_j of (q, q').
  [[nodiscard]] std::vector<std::vector<Slot>> acceleration_derivatives();
  /// An output of the tape; the motion is solved for where it is needed.
  void output(const Expression& e);
  /// The only output, of a tape whose variables are (q, q', q''). False where it does not need q'', or needs
  /// more than that.
  [[nodiscard]] bool output_by_accelerations(const Expression& e);

  [[nodiscard]] const Unfolded& kinks() const { return kinks_; }
  [[nodiscard]] const std::vector<Expression>& coordinates() const { return q_; }
  [[nodiscard]] const std::vector<Expression>& rates() const { return rates_; }
  [[nodiscard]] const Expression& time() const { return t_; }
  [[nodiscard]] TapeBuilder& tape() { return *tape_; }

 private:
  [[nodiscard]] std::vector<Expression> adopted(const std::vector<Expression>& symbols);
  void take_equations();
  void unfold();
  void stay_on(std::size_t kink);
  [[nodiscard]] std::vector<Expression> split_forces(const Expression& side);
  /// Where the side stands beside a multiplier, their product is the unknown: friction that sticks.
  [[nodiscard]] std::optional<std::vector<Expression>> split_reactions(const Expression& side,
                                                                       Expression& unknown);
  void eliminate(std::size_t j, const Expression& acceleration, const std::vector<Expression>& half,
                 const Expression& side);
  void append(const std::vector<Expression>& slope, const Expression& rest,
              const std::vector<Expression>& half, const Expression& side);
  [[nodiscard]] std::vector<Expression> derivative_column(const Expression& y) const;
  [[nodiscard]] TapeBuilder::LinearSystem system(std::vector<std::vector<Expression>> right_hand_sides) const;

  const Model& model_;
  mutable Graph graph_;
  std::vector<Expression> q_, rates_, accelerations_, parameters_;
  Expression t_;
  std::vector<Replacement> replacements_;
  Unfolded kinks_;
  std::vector<Expression> unknown_sides_;  ///< of the kinks on which the motion stays
  // matrix x = right for x = unknowns: q'', some of them replaced by the sides of kinks, and more of those.
  Matrix matrix_;
  std::vector<Expression> right_, unknowns_;
  std::vector<Replacement> known_;      ///< accelerations that a kink prescribes
  std::vector<Replacement> quotients_;  ///< sides that are known by their products with multipliers
  std::optional<Expression> determinant_;
  std::optional<TapeBuilder> tape_;
  std::vector<Slot> solution_;
  bool is_solved_{false};
};

}  // namespace qdot
