#include "core/closed/exact_degenerate.hpp"

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/exact_roots.hpp"
#include "core/closed/linear_motions.hpp"
#include "core/expr/trigonometry.hpp"
#include "core/steady/factors.hpp"
#include "core/steady/followed_momenta.hpp"

namespace qdot {
namespace {

class DegenerateForm {
 public:
  DegenerateForm(const Dynamics& dynamics, const Statics& statics, const Reals& there, std::size_t index,
                 const WrittenTexts& written)
      : motions_(linear_motions(statics.reduction, dynamics.model().scene)),
        values_(dynamics.model(), motions_.graph, written, there, index),
        p_(values_.symbols()[index]) {}

  [[nodiscard]] std::optional<ClosedForm> at(double value) const {
    for (const Expression& force : motions_.forces)
      if (auto form = root_of(force, value)) return form;
    return motions_.stiffness.size() < 2 || motions_.stiffness.size() > largest_written_system
               ? std::nullopt
               : root_of(determinant(motions_.stiffness), value);
  }

 private:
  /// Of a factor of e near the value that makes e vanish in every position.
  [[nodiscard]] std::optional<ClosedForm> root_of(const Expression& e, double value) const {
    constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();
    for (const Expression& factor : factors_of_parameter(e)) {
      for (const Expression& root : roots_in(factor, p_, values_)) {
        const std::vector<Replacement> there{{p_, root}};
        if (agrees(values_.value(root), value, rounding * std::abs(value)) &&
            rational_function(substitute(e, there)).is_zero())
          return closed_form(values_, root, {});
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<Expression> factors_of_parameter(const Expression& force) const {
    Graph& graph = *motions_.graph;
    const Expression above = to_expression(graph, with_single_angles(graph, rational_function(force).above));
    std::vector<Expression> result;
    for (const Factor& factor : factors_along(above, p_)) {
      if (depends_on(factor.base, p_) && !depends_on(factor.base, motions_.x)) result.push_back(factor.base);
    }
    return result;
  }

  LinearMotions motions_;
  ExactValues values_;
  Expression p_;
};

std::optional<ClosedForm> degenerate_form(const Dynamics& dynamics, const Reals& given, const Reals& y,
                                          std::size_t index, const WrittenTexts& written, double value) {
  Reals there = given;
  there.set(index, value);
  auto statics = dynamics.statics(there);
  if (!momenta_vanish(dynamics, *statics, there, y))
    statics = with_written_momenta(dynamics, there, {given, y});
  if (!statics) return std::nullopt;
  return DegenerateForm(dynamics, *statics, there, index, written).at(value);
}

}  // namespace

std::vector<std::optional<ClosedForm>> exact_degenerate_values(const Dynamics& dynamics,
                                                               const Reals& parameters, const Reals& y,
                                                               std::size_t index, const WrittenTexts& written,
                                                               const Bifurcations& found) {
  std::vector<std::optional<ClosedForm>> result;
  for (const double value : found.degenerate) {
    result.emplace_back();
    if (value == 0 || dynamics.model().has_constraints()) continue;
    try {
      const WorkScope budget(most_algebra);
      result.back() = degenerate_form(dynamics, parameters, y, index, written, value);
    } catch (const Error&) {  // the algebra grows too large, or divides by what vanishes
    }
  }
  return result;
}

}  // namespace qdot
