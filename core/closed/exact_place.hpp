#pragma once
// An equilibrium as expressions of the parameters: angles that are multiples of pi/2, or have a sine, a
// cosine or a tangent that solves a linear equation; coordinates that solve one, l = l0 + m*g/k, or a
// quadratic one, of which a power, an exponential or a length solves one, r^6 = 2*s^6, exp(-a*x) = 1/2,
// sqrt(x^2 + l^2) = l0, or that are a parameter. What is known of it, and what an expression is there; it is
// found by place_search.hpp.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/closed/bracket.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/surd.hpp"
#include "core/numerics/interval.hpp"

namespace qdot {

/// What is looked for: x with g(x) = 0 near a place that is known by numbers.
struct PlaceProblem {
  /// A parameter, or an expression of them, and its value.
  struct Known {
    Expression symbol;
    double value;
  };
  std::vector<Expression> x;
  std::vector<bool> is_angle;
  std::vector<std::vector<Known>> alike;     ///< for each x the parameters of its unit
  std::vector<std::optional<Known>> starts;  ///< for each x, where the scene tells it
  std::vector<Expression> forces;            ///< g
  std::vector<Interval> near;                ///< encloses x
  SignOf sign;                               ///< also of what holds x
  /// Whether the forces decide x_k, so that a parameter may be meant where it has its number; none: all.
  std::function<bool(std::size_t)> is_decided{};
};

class ExactPlace {
 public:
  /// Of which nothing is known yet. The problem has to outlive the place.
  explicit ExactPlace(const PlaceProblem& problem) : problem_(&problem), x_(problem.x) {}

  /// sin(x_k) or cos(x_k) is `value`, the other one the root of 1 - value^2, or known as well.
  struct Solved {
    Expression known, other;  ///< which is which
    Expression value;
    std::optional<Expression> other_value;
  };

  /// x^n = value, n > 0.
  struct Powered {
    Expression x;
    Number n;
    Expression value;
  };

  /// x_k is `value`, and what was known by x_k is known by the parameters.
  void settle(std::size_t k, const Expression& value);
  /// x_k is `value`, which is the root or the angle by which expressions are written.
  void settle(std::size_t k, const Expression& value, Powered power);
  void settle(std::size_t k, const Expression& value, Solved angle);
  /// A bracket is known by its power. The last one can be forgotten.
  void take(BracketPower bracket) { brackets_.push_back({std::move(bracket), replacements_.size()}); }
  void forget_bracket() { brackets_.pop_back(); }

  [[nodiscard]] bool is_known(std::size_t k) const { return x_[k] != problem_->x[k]; }
  /// x_k by the parameters.
  [[nodiscard]] const std::vector<Expression>& x() const { return x_; }
  /// The coordinates that no force decides: any value does.
  [[nodiscard]] std::vector<Expression> undecided() const;
  /// e at the place.
  [[nodiscard]] Expression at(const Expression& e) const;

 private:
  void settle_root(std::size_t k, const Expression& value);
  [[nodiscard]] Expression with_powers_taken(const Expression& e) const;
  [[nodiscard]] Expression with_solved_angles(const Expression& e) const;
  [[nodiscard]] Polynomial with_angles_taken(const Polynomial& e, const Solved& angle) const;

  const PlaceProblem* problem_;
  std::vector<Expression> x_;
  std::vector<Replacement> replacements_;
  std::vector<Solved> solved_;
  std::vector<Powered> powers_;
  /// In which so many unknowns were replaced.
  struct KnownBracket {
    BracketPower power;
    std::size_t settled;
  };
  std::vector<KnownBracket> brackets_;
};

}  // namespace qdot
