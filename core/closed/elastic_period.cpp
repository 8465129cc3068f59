#include "core/closed/elastic_period.hpp"

#include "core/expr/calculus.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class ElasticPeriods {
 public:
  ElasticPeriods(const QuadratureProblem& problem, const ExactValues& values)
      : problem_(problem), values_(values), slope_(simplify(differentiate(problem.potential, problem.x))) {}

  [[nodiscard]] std::optional<Expression> between(const Expression& below, const Expression& above) const {
    if (slope_.is_zero()) {  // (b - a) sqrt(A/(2 F))
      const Expression way = above - below;
      return root(Number(2) * way * way * problem_.inertia / remaining(below));
    }
    if (depends_on(slope_, problem_.x)) return std::nullopt;
    const Expression last = at_wall(below), first = at_wall(above);
    return values_.sign(slope_) > 0 ? last - first : first - last;
  }

  /// From a turning point, which lies beyond the start.
  [[nodiscard]] std::optional<Expression> from_wall(const Expression& wall, int side) const {
    if (slope_.is_zero()) return std::nullopt;
    if (!depends_on(slope_, problem_.x)) return at_wall(wall);
    const Expression stiffness = simplify(differentiate(slope_, problem_.x));
    if (depends_on(stiffness, problem_.x) || values_.sign(stiffness) <= 0) return std::nullopt;
    const Replacement there{problem_.x, wall};
    const Expression pull = simplify(substitute(slope_, {&there, 1}));  // k (b - c)
    const Expression quarter = root(problem_.inertia / stiffness);
    if (pull.is_zero()) return problem_.x.graph().symbol("pi") * quarter;
    // The amplitude is sqrt((b - c)^2 + 2 F/k).
    const Expression share =
        Number(side) * pull / root(pull * pull + Number(2) * stiffness * remaining(wall));
    return Number(2) * quarter * problem_.x.graph().call(Function::acos, share);
  }

 private:
  [[nodiscard]] Expression remaining(const Expression& x) const {
    const Replacement there{problem_.x, x};
    return problem_.energy - substitute(problem_.potential, {&there, 1});
  }
  /// There and back to where F vanishes, 2 sqrt(2 A F)/|U'|.
  [[nodiscard]] Expression at_wall(const Expression& x) const {
    return root(Number(8) * problem_.inertia * remaining(x) / (slope_ * slope_));
  }
  [[nodiscard]] Expression root(const Expression& square) const {
    return positive_root(square.graph(), rational_function(simplify(square)), values_.sign_of());
  }

  const QuadratureProblem& problem_;
  const ExactValues& values_;
  Expression slope_;
};

}  // namespace

std::vector<Expression> elastic_periods(const QuadratureProblem& problem,
                                        const std::optional<Expression>& below,
                                        const std::optional<Expression>& above, const ExactValues& values) {
  if (depends_on(problem.inertia, problem.x)) return {};
  const ElasticPeriods periods(problem, values);
  const auto found = below && above ? periods.between(*below, *above)
                     : below        ? periods.from_wall(*below, 1)
                                    : periods.from_wall(*above, -1);
  return found ? std::vector{*found} : std::vector<Expression>{};
}

}  // namespace qdot
