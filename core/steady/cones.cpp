#include "core/steady/cones.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/compile/tape_builder.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/numerics/enclosed_system.hpp"
#include "core/steady/inertia.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {
namespace {

/// How far about a cone its forces are looked at, as parts of 1 or of where it is; the first that decides.
constexpr double reaches[]{1e-3, 1e-6, 1e-9};

/// What has a root in the equations.
std::vector<Expression> radicands(std::span<const Expression> equations, std::span<const Expression> x) {
  std::vector<Expression> found;
  for (const Expression& e : equations) {
    const NodeId root = e.id();
    for (const NodeId id : reachable(e.graph(), {&root, 1})) {
      const auto* power = std::get_if<Power>(&e.graph().node(id));
      if (power == nullptr || !(power->exponent.denominator() == Number(2))) continue;
      const Expression base(e.graph(), power->base);
      if (depends_on(base, x) && std::ranges::find(found, base) == found.end()) found.push_back(base);
    }
  }
  return found;
}

class ConeDerivation {
 public:
  ConeDerivation(std::span<const Expression> constants, std::span<const Expression> x,
                 std::span<const Expression> unknowns, std::span<const Expression> equations)
      : graph_(equations[0].graph()),
        constants_(constants),
        variables_(x.begin(), x.end()),
        unknowns_(unknowns),
        equations_(equations),
        r_(graph_.symbol("distance to a cone")) {
    variables_.push_back(r_);
  }

  std::optional<ConeForms> at(const Expression& radicand) {
    if (!locate(radicand)) return std::nullopt;
    std::vector<Expression> slopes, along_r;
    for (const Expression& g : equations_) {
      const std::optional<Expression> h = times_distance(g, radicand);
      if (!h) return std::nullopt;
      for (const Expression& x : unknowns_) slopes.push_back(differentiate(*h, x));
      along_r.push_back(differentiate(*h, r_));
    }
    slopes.insert(slopes.end(), along_r.begin(), along_r.end());
    std::vector<Expression> place = place_;
    place.insert(place.end(), weights_.begin(), weights_.end());
    return ConeForms{compiled(place), compiled(slopes)};
  }

 private:
  /// p and a of sum_j a_j (x_j - p_j)^2, where the radicand is one.
  bool locate(const Expression& radicand) {
    place_.clear();
    weights_.clear();
    at_cone_ = {{r_, graph_.number(0)}};
    for (const Expression& x : unknowns_) {
      const Expression slope = differentiate(radicand, x);
      for (const Expression& other : unknowns_) {
        const Expression second = simplify(differentiate(slope, other));
        if (other == x ? second.is_zero() || depends_on(second, variables_) : !second.is_zero()) return false;
        if (other == x) weights_.push_back(simplify(Number::ratio(1, 2) * second));
      }
      place_.push_back(simplify(expand(x - slope / (Number(2) * weights_.back()))));
      if (depends_on(place_.back(), variables_)) return false;
      at_cone_.emplace_back(x, place_.back());
    }
    return vanishes_at_cone(radicand);
  }

  [[nodiscard]] bool vanishes_at_cone(const Expression& e) const {
    return simplify(expand(substitute(e, at_cone_))).is_zero();
  }

  /// h of g, where it vanishes at the cone.
  std::optional<Expression> times_distance(const Expression& g, const Expression& radicand) {
    std::vector<Replacement> by_distance;
    const NodeId root = g.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      const auto* power = std::get_if<Power>(&graph_.node(id));
      if (power != nullptr && power->base == radicand.id())
        by_distance.emplace_back(Expression(graph_, id), pow(r_, Number(2) * power->exponent));
    }
    const Polynomial terms = multiplied_out(substitute(g, by_distance));
    const Monomial distance{{r_.id(), 1, 1}};
    for (const auto& [monomial, coefficient] : terms) {
      if (exponent_of(monomial, r_.id()) < -1) return std::nullopt;
    }
    const Expression h = to_expression(graph_, scaled(terms, distance, Number(1)));
    return vanishes_at_cone(h) ? std::optional(h) : std::nullopt;
  }

  [[nodiscard]] CompiledFunction compiled(const std::vector<Expression>& expressions) {
    TapeBuilder tape(graph_, constants_, graph_.symbol("t"), variables_);
    for (const Expression& e : expressions) tape.output(e);
    return tape.finish();
  }

  Graph& graph_;
  std::span<const Expression> constants_;
  std::vector<Expression> variables_;  ///< x, then r
  std::span<const Expression> unknowns_, equations_;
  Expression r_;
  std::vector<Expression> place_, weights_;
  std::vector<Replacement> at_cone_;
};

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
    if (length.lower > 1) return AtCone::nothing;
    if (!(length.upper < 1) || !problem_.forces->symmetric) return AtCone::undecided;
    return by_definiteness(c, n_);
  }

  const SteadyProblem& problem_;
  const ConeForms& forms_;
  std::size_t n_;
  Box place_, weights_;
};

}  // namespace

std::vector<ConeForms> derive_cones(std::span<const Expression> constants, std::span<const Expression> x,
                                    std::span<const Expression> unknowns,
                                    std::span<const Expression> equations) {
  std::vector<ConeForms> result;
  if (unknowns.size() < 2 || equations.size() != unknowns.size()) return result;
  ConeDerivation derivation(constants, x, unknowns, equations);
  for (const Expression& radicand : radicands(equations, unknowns)) {
    if (auto forms = derivation.at(radicand)) result.push_back(std::move(*forms));
  }
  return result;
}

std::vector<Cone> cones_of(const SteadyProblem& problem) {
  std::vector<Cone> result;
  for (const ConeForms& forms : problem.forces->cones) {
    const ConeDecision decision(problem, forms);
    Cone cone;
    for (const double reach : reaches) {
      cone = decision.within(reach);
      if (cone.what != AtCone::undecided) break;
    }
    result.push_back(std::move(cone));
  }
  return result;
}

}  // namespace qdot
