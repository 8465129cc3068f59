#include "core/steady/growth_condition.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/simplify.hpp"
#include "core/steady/growing_oscillations.hpp"
#include "core/steady/numerator.hpp"

namespace qdot {
namespace {

/// The condition of a body that spins freely has thousands of terms: what else is found need not wait for it.
constexpr std::uint64_t most_algebra_of_growth = 1'000'000;

class GrowthDerivation {
 public:
  GrowthDerivation(const Reduction& reduction, const SteadyForces& forces, Graph& graph,
                   const std::vector<Expression>& x, std::span<const Replacement> linear)
      : reduction_(reduction), forces_(forces), graph_(graph), x_(x), linear_(linear) {}

  void derive() {
    std::vector<Expression> equations, x_dot, x_ddot, g;
    for (std::size_t i = 0; i < reduction_.x.size(); ++i) {
      equations.push_back(graph_.adopt(reduction_.equations[i]));
      x_dot.push_back(graph_.adopt(reduction_.x_dot[i]));
      x_ddot.push_back(graph_.adopt(reduction_.x_ddot[i]));
      g.push_back(graph_.adopt(forces_.rest[i]));
      for (const Expression& rate : {x_dot.back(), x_ddot.back()})
        at_rest_.emplace_back(rate, graph_.number(0));
    }
    if (equations.size() > largest_written_system) {
      found_.is_unknown = !forces_.symmetric || !rest_without_rates(equations, x_dot);
      return;
    }
    const Matrix rates = slopes_at_rest(equations, x_dot);
    const auto vanishes = [](const std::vector<Expression>& row) {
      return std::ranges::all_of(row, &Expression::is_zero);
    };
    if (forces_.symmetric && std::ranges::all_of(rates, vanishes)) return;
    const auto growing =
        growing_oscillations(slopes_at_rest(equations, x_ddot), rates, slopes_at_rest(g, x_));
    if (!growing) return;
    found_.condition = simplify(numerator_of(simplify(growing->condition), x_));
    found_.is_collision = growing->is_collision;
    if (growing->square) found_.square = simplify(*growing->square);
  }

  [[nodiscard]] GrowthCondition found() && { return std::move(found_); }

 private:
  /// de_i/dv_j at rest, where the unknowns are what is left of them.
  [[nodiscard]] Matrix slopes_at_rest(const std::vector<Expression>& e,
                                      const std::vector<Expression>& variables) const {
    Matrix result;
    for (const Expression& row : e) {
      result.emplace_back();
      for (const Expression& v : variables)
        result.back().push_back(simplify(substitute(substitute(differentiate(row, v), at_rest_), linear_)));
    }
    return result;
  }

  /// No equation has a term that is linear in a velocity, as its derivatives at rest show without algebra.
  [[nodiscard]] bool rest_without_rates(const std::vector<Expression>& equations,
                                        const std::vector<Expression>& x_dot) const {
    return std::ranges::all_of(equations, [&](const Expression& e) {
      return std::ranges::all_of(
          x_dot, [&](const Expression& v) { return substitute(differentiate(e, v), at_rest_).is_zero(); });
    });
  }

  const Reduction& reduction_;
  const SteadyForces& forces_;
  Graph& graph_;
  const std::vector<Expression>& x_;
  std::span<const Replacement> linear_;
  std::vector<Replacement> at_rest_;
  GrowthCondition found_;
};

}  // namespace

GrowthCondition derive_growth_condition(const Reduction& reduction, const SteadyForces& forces, Graph& graph,
                                        const std::vector<Expression>& x,
                                        std::span<const Replacement> linear) try {
  const WorkScope budget(std::min(most_algebra_of_growth, work_left()));
  GrowthDerivation derivation(reduction, forces, graph, x, linear);
  derivation.derive();
  return std::move(derivation).found();
} catch (const Error& error) {
  if (error.code() != ErrorCode::too_large) throw;
  return {.condition = {}, .square = {}, .is_collision = false, .is_unknown = true};
}

}  // namespace qdot
