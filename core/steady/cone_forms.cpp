#include "core/steady/cone_forms.hpp"

#include <algorithm>
#include <optional>

#include "core/compile/tape_builder.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// What has a root in the equations, or stands below.
std::vector<Expression> radicands(std::span<const Expression> equations, std::span<const Expression> x) {
  std::vector<Expression> found;
  for (const Expression& e : equations) {
    const NodeId root = e.id();
    for (const NodeId id : reachable(e.graph(), {&root, 1})) {
      const auto* power = std::get_if<Power>(&e.graph().node(id));
      if (power == nullptr) continue;
      const bool is_below = power->exponent.is_integer() && power->exponent.is_negative();
      if (!is_below && power->exponent.denominator() != Number(2)) continue;
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
    std::vector<Polynomial> by_r;
    int order = 1;
    for (const Expression& g : equations_) {
      by_r.push_back(by_distance(g, radicand));
      for (const auto& term : by_r.back()) order = std::max(order, -exponent_of(term.first, r_.id()));
    }
    std::vector<Expression> slopes, along_r;
    for (const Polynomial& terms : by_r) {
      const Expression h = to_expression(graph_, scaled(terms, {{r_.id(), order, 1}}, Number(1)));
      if (!vanishes_at_cone(h)) return std::nullopt;
      for (const Expression& x : unknowns_) slopes.push_back(differentiate(h, x));
      along_r.push_back(differentiate(h, r_));
    }
    slopes.insert(slopes.end(), along_r.begin(), along_r.end());
    std::vector<Expression> place = place_;
    place.insert(place.end(), weights_.begin(), weights_.end());
    return ConeForms{compiled(place), compiled(slopes), order > 1};
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

  /// With powers of r for those of the radicand.
  [[nodiscard]] Polynomial by_distance(const Expression& g, const Expression& radicand) const {
    std::vector<Replacement> powers;
    const NodeId root = g.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      const auto* power = std::get_if<Power>(&graph_.node(id));
      if (power != nullptr && power->base == radicand.id())
        powers.emplace_back(Expression(graph_, id), pow(r_, Number(2) * power->exponent));
    }
    return multiplied_out(substitute(g, powers));
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

}  // namespace qdot
