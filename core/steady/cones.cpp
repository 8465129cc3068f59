#include "core/steady/cones.hpp"

#include <algorithm>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/enclosed_system.hpp"
#include "core/steady/inertia.hpp"

namespace qdot {
namespace {

/// How far about a cone its forces are looked at, as parts of 1 or of where it is; the first that decides.
constexpr double reaches[]{1e-3, 1e-6, 1e-9};

/// Of the signs of C, where the forces are the slope of a potential.
AtCone by_definiteness(const Box& c, std::size_t n) {
  const Inertia signs = inertia_of(c, n);
  return signs.positive == n ? AtCone::held : signs.negative == n ? AtCone::pushed : AtCone::undecided;
}

class ConeDecision {
 public:
  ConeDecision(const SteadyProblem& problem, const ConeForms& forms)
      : problem_(problem), forms_(forms), n_(problem.forces->unknowns.size()) {
    const Box values = at(forms.place, {}, Interval(0));
    place_.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n_));
    weights_.assign(values.begin() + static_cast<std::ptrdiff_t>(n_), values.end());
  }

  Cone within(double reach) const {
    Cone cone{place_, {}, AtCone::undecided};
    Interval square_of_r(0);
    for (std::size_t j = 0; j < n_; ++j) {
      const double far = reach * std::max(1.0, place_[j].magnitude());
      cone.about.push_back(place_[j] + Interval(-far, far));
      square_of_r = square_of_r + weights_[j] * square(cone.about[j] - place_[j]);
    }
    const bool is_distance = std::ranges::all_of(weights_, [](const Interval& a) { return a.lower > 0; });
    if (is_distance) cone.what = decided(cone.about, Interval(0, sqrt(square_of_r).upper));
    return cone;
  }

 private:
  [[nodiscard]] Box at(const CompiledFunction& function, const Box& unknowns, const Interval& r) const {
    Box variables(problem_.statics->reduction.x.size() + 1), values(function.outputs());
    for (std::size_t j = 0; j < unknowns.size(); ++j) variables[problem_.forces->unknowns[j]] = unknowns[j];
    variables.back() = r;
    TapeEvaluator<Interval>(function, problem_.constants)(variables, values);
    return values;
  }

  [[nodiscard]] AtCone decided(const Box& about, const Interval& r) const {
    const Box values = at(forms_.slopes, about, r);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(n_ * n_);
    const Box c(values.begin(), middle);
    Box n(middle, values.end());
    solve_linear(n_, c, n);
    Interval length(0);
    for (std::size_t j = 0; j < n_; ++j) length = length + weights_[j] * square(n[j]);
    if (length.lower > 1 || (length.upper < 1 && forms_.is_pole)) return AtCone::nothing;
    if (forms_.is_pole) return AtCone::undecided;
    if (!(length.upper < 1) || !problem_.forces->symmetric) return AtCone::undecided;
    return by_definiteness(c, n_);
  }

  const SteadyProblem& problem_;
  const ConeForms& forms_;
  std::size_t n_;
  Box place_, weights_;
};

}  // namespace

std::vector<Cone> cones_of(const SteadyProblem& problem) {
  std::vector<Cone> result;
  for (const ConeForms& forms : problem.forces->cones) {
    const ConeDecision decision(problem, forms);
    Cone cone;
    for (const double reach : reaches) {
      cone = decision.within(reach);
      if (cone.what != AtCone::undecided) break;
    }
    const bool is_unknown_pole = forms.is_pole && cone.what == AtCone::undecided;
    if (!is_unknown_pole) result.push_back(std::move(cone));  // the search comes to it itself
  }
  return result;
}

}  // namespace qdot
