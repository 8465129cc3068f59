#include "core/steady/free_direction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/zeroness.hpp"

namespace qdot {
namespace {

constexpr double rounding = 1e-9;

bool is_near(double a, double b) { return std::abs(a - b) <= rounding * std::max(1.0, std::abs(b)); }

struct ShortRatio {
  std::int64_t p{}, q{};
};

/// Near x, with a small q.
std::optional<ShortRatio> short_ratio(double x) {
  constexpr std::int64_t largest_denominator = 60;
  for (std::int64_t q = 1; q <= largest_denominator; ++q) {
    const double p = std::round(x * static_cast<double>(q));
    if (is_near(p / static_cast<double>(q), x)) return ShortRatio{static_cast<std::int64_t>(p), q};
  }
  return std::nullopt;
}

/// What components are tried as first.
enum class Ratios { fractions, quotients };

struct Component {
  Expression exact;
  Ball value;
};

class NearDirection {
 public:
  NearDirection(const Statics& statics, const std::vector<Ball>& constants)
      : statics_(statics), constants_(constants), graph_(*statics.reduction.graph) {}

  /// None where a component has no such ratio.
  [[nodiscard]] std::optional<std::vector<Component>> exact(const std::vector<double>& v, Ratios tried) {
    std::vector<Component> result;
    for (const double entry : v) {
      auto ratio = tried == Ratios::fractions ? fraction_near(entry) : quotient_near(entry);
      if (!ratio) ratio = tried == Ratios::fractions ? quotient_near(entry) : fraction_near(entry);
      if (!ratio) return std::nullopt;
      result.push_back(*ratio);
    }
    return result;
  }

  [[nodiscard]] bool is_free(const std::vector<Component>& v) {
    return std::ranges::all_of(statics_.rest, [&](const Expression& force) {
      return zeroness(slope_along(v, force, statics_.reduction.x)) == Zeroness::zero;
    });
  }

  /// D v = 0 and K v parallel to M v, of which the component `along` is not 0; with `place` put in.
  [[nodiscard]] bool is_undamped(const std::vector<Component>& v, std::size_t along,
                                 const std::vector<Replacement>& place) {
    const Reduction& reduction = statics_.reduction;
    std::vector<Expression> k, m;
    for (const Expression& equation : reduction.equations) {
      const auto slope = [&](const std::vector<Expression>& variables) {
        return substitute(substitute(slope_along(v, equation, variables), still()), place);
      };
      if (zeroness(slope(reduction.x_dot)) != Zeroness::zero) return false;
      k.push_back(slope(reduction.x));
      m.push_back(slope(reduction.x_ddot));
    }
    for (std::size_t i = 0; i < k.size(); ++i) {
      if (i != along && zeroness(k[i] * m[along] - k[along] * m[i]) != Zeroness::zero) return false;
    }
    return true;
  }

  /// x = 0, where no force acts there.
  [[nodiscard]] std::vector<Replacement> at_zero() {
    std::vector<Replacement> zeros;
    for (const Expression& x : statics_.reduction.x) zeros.emplace_back(graph_.adopt(x), graph_.number(0));
    for (const Expression& force : statics_.rest)
      if (zeroness(substitute(graph_.adopt(force), zeros)) != Zeroness::zero) return {};
    return zeros;
  }

 private:
  [[nodiscard]] std::optional<Component> fraction_near(double x) {
    const std::optional<ShortRatio> fraction = short_ratio(x);
    if (!fraction) return std::nullopt;
    const auto [p, q] = *fraction;
    return Component{graph_.number(Number::ratio(p, q)),
                     Ball(static_cast<double>(p)) / Ball(static_cast<double>(q))};
  }
  [[nodiscard]] std::optional<Component> quotient_near(double x) {
    for (std::size_t a = 0; a < constants_.size(); ++a) {
      for (std::size_t b = 0; b < constants_.size(); ++b) {
        const double ratio = constants_[a].value() / constants_[b].value();
        if (a == b || !is_near(std::abs(ratio), std::abs(x))) continue;
        const int sign = ratio * x < 0 ? -1 : 1;
        return Component{Number(sign) * (constant(a) / constant(b)),
                         Ball(sign) * constants_[a] / constants_[b]};
      }
    }
    return std::nullopt;
  }
  [[nodiscard]] Expression constant(std::size_t k) { return graph_.adopt(statics_.reduction.constants[k]); }

  /// x' = x'' = 0.
  [[nodiscard]] std::vector<Replacement> still() {
    std::vector<Replacement> zeros;
    for (const auto* symbols : {&statics_.reduction.x_dot, &statics_.reduction.x_ddot}) {
      for (const Expression& symbol : *symbols) zeros.emplace_back(graph_.adopt(symbol), graph_.number(0));
    }
    return zeros;
  }

  /// sum_j v_j de/dz_j.
  [[nodiscard]] Expression slope_along(const std::vector<Component>& v, const Expression& e,
                                       const std::vector<Expression>& z) {
    Expression slope = graph_.number(0);
    for (std::size_t j = 0; j < v.size(); ++j) {
      if (v[j].exact.is_zero()) continue;
      slope = slope + v[j].exact * differentiate(graph_.adopt(e), graph_.adopt(z[j]));
    }
    return slope;
  }

  const Statics& statics_;
  const std::vector<Ball>& constants_;
  Graph graph_;
};

/// v over its largest component; empty where that is 0.
std::vector<double> ratios_of(const Shape& v) {
  double largest = 0;
  for (const ComplexBall& entry : v) {
    const double x = entry.re.value();
    if (std::abs(x) > (1 + rounding) * std::abs(largest)) largest = x;
  }
  std::vector<double> ratios;
  for (const ComplexBall& entry : v) {
    if (largest != 0) ratios.push_back(entry.re.value() / largest);
  }
  return ratios;
}

/// Row i of a v.
Ball product(const SquareMatrix<Ball>& a, std::size_t i, const std::vector<Component>& v) {
  Ball sum(0);
  for (std::size_t j = 0; j < v.size(); ++j) sum = sum + a(i, j) * v[j].value;
  return sum;
}

std::optional<Ball> eigenvalue_along(const Linearization& at, NearDirection& direction,
                                     const std::vector<Component>& v) {
  const SmallMotions& motions = at.reduced;
  std::size_t along = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (!product(motions.rates, i, v).contains_zero()) return std::nullopt;
    if (product(motions.mass, i, v).magnitude() > product(motions.mass, along, v).magnitude()) along = i;
  }
  const Ball mass = product(motions.mass, along, v);
  if (mass.contains_zero()) return std::nullopt;
  const bool may_be_zero = at.place.isolated && std::ranges::all_of(at.place.x, &Ball::contains_zero);
  const auto zeros = may_be_zero ? direction.at_zero() : std::vector<Replacement>{};
  if (!direction.is_undamped(v, along, zeros)) return std::nullopt;
  return product(motions.stiffness, along, v) / mass;
}

/// What `find` makes of the first direction near v for which it has a value.
template <class Find>
auto of_directions_near(const Statics& statics, const std::vector<Ball>& constants, const Shape& v,
                        const Find& find) -> decltype(find(std::declval<NearDirection&>(), {})) {
  const std::vector<double> ratios = ratios_of(v);
  if (ratios.empty()) return {};
  try {
    NearDirection direction(statics, constants);
    for (const Ratios tried : {Ratios::fractions, Ratios::quotients}) {
      const auto exact = direction.exact(ratios, tried);
      if (!exact) continue;
      if (auto found = find(direction, *exact)) return found;
    }
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
  }
  return {};
}

}  // namespace

bool is_free(const Statics& statics, const std::vector<Ball>& constants, const Shape& v) {
  return !statics.rest.empty() &&
         of_directions_near(statics, constants, v,
                            [](NearDirection& direction, const std::vector<Component>& exact) {
                              return direction.is_free(exact);
                            });
}

std::optional<Ball> undamped_along(const Linearization& at, const Shape& v) {
  if (!at.allowed.empty()) return std::nullopt;
  const auto largest = std::ranges::max_element(
      v, [](const ComplexBall& a, const ComplexBall& b) { return magnitude(a) < magnitude(b); });
  Shape in_step;
  for (const ComplexBall& entry : v) {
    in_step.push_back(entry / *largest);
    if (!in_step.back().im.contains_zero()) return std::nullopt;
  }
  return of_directions_near(at.statics, at.constants, in_step,
                            [&](NearDirection& direction, const std::vector<Component>& exact) {
                              return eigenvalue_along(at, direction, exact);
                            });
}

bool has_linear_equations(const Statics& statics) {
  const Reduction& reduction = statics.reduction;
  Graph graph(*reduction.graph);
  std::vector<Expression> variables;
  for (const auto* group : {&reduction.x, &reduction.x_dot, &reduction.x_ddot}) {
    for (const Expression& z : *group) variables.push_back(graph.adopt(z));
  }
  return std::ranges::all_of(reduction.equations, [&](const Expression& equation) {
    return std::ranges::all_of(variables, [&](const Expression& z) {
      return !depends_on(simplify(differentiate(graph.adopt(equation), z)), variables);
    });
  });
}

}  // namespace qdot
