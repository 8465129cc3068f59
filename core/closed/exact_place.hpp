#pragma once
// An equilibrium as expressions of the parameters: angles that are multiples of pi/2, or have a sine, a
// cosine or a tangent that solves a linear equation; coordinates that solve one, l = l0 + m*g/k, or a
// quadratic one, of which a power, an exponential or a length solves one, r^6 = 2*s^6, exp(-a*x) = 1/2,
// sqrt(x^2 + l^2) = l0, or that are a parameter. It is proven by putting
// it into the forces, which have to vanish identically.

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
  /// A parameter and its value.
  struct Known {
    Expression symbol;
    double value;
  };
  std::vector<Expression> x;
  std::vector<bool> is_angle;
  std::vector<std::vector<Known>> alike;  ///< for each x the parameters of its unit
  std::vector<Expression> forces;         ///< g
  std::vector<Interval> near;             ///< encloses x
  SignOf sign;                            ///< also of what holds x
};

class ExactPlace {
 public:
  /// No value where none of these forms solves g = 0. The problem has to outlive the place.
  [[nodiscard]] static std::optional<ExactPlace> of(const PlaceProblem& problem);

  /// With the known angles and zeros alone, whether forces vanish there or not.
  [[nodiscard]] static ExactPlace special(const PlaceProblem& problem);

  /// x_k by the parameters.
  [[nodiscard]] const std::vector<Expression>& x() const { return x_; }
  /// The coordinates that no force decides: any value does.
  [[nodiscard]] std::vector<Expression> undecided() const;
  /// e at the place.
  [[nodiscard]] Expression at(const Expression& e) const;

 private:
  /// sin(x_k) or cos(x_k) is `value`, the other one the root of 1 - value^2, or known as well.
  struct Solved {
    Expression known, other;  ///< which is which
    Expression value;
    std::optional<Expression> other_value;
  };

  /// x^n = value.
  struct Powered {
    Expression x;
    int n;
    Expression value;
  };

  explicit ExactPlace(const PlaceProblem& problem) : problem_(&problem), x_(problem.x) {}
  void take_special_values();
  void settle(std::size_t k, const Expression& value);
  [[nodiscard]] bool solve_one();
  [[nodiscard]] bool take_parameter();
  [[nodiscard]] bool solve(std::size_t k, const Expression& force);
  [[nodiscard]] bool solve_bracket(std::size_t k, const Expression& force);
  [[nodiscard]] bool solve_quadratic(std::size_t k, const Polynomial& force);
  [[nodiscard]] bool solve_exponential(std::size_t k, const Expression& force);
  [[nodiscard]] std::optional<Expression> root(std::size_t k, int n, const RationalFunction& value) const;
  [[nodiscard]] Expression with_powers_taken(const Expression& e) const;
  [[nodiscard]] bool solve_angle(std::size_t k, const Expression& force);
  [[nodiscard]] bool solve_tangent(std::size_t k, const Polynomial& force);
  [[nodiscard]] bool solve_known_tangent(std::size_t k, const RationalFunction& tangent);
  [[nodiscard]] bool is_known(std::size_t k) const { return x_[k] != problem_->x[k]; }

  const PlaceProblem* problem_;
  std::vector<Expression> x_;
  std::vector<Replacement> replacements_;
  std::vector<Solved> solved_;
  std::vector<Powered> powers_;
  std::vector<BracketPower> brackets_;
};

}  // namespace qdot
