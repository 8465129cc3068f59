#include "core/closed/place_angles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/closed/exact_roots.hpp"
#include "core/closed/joined_roots.hpp"
#include "core/closed/one_unknown.hpp"
#include "core/closed/place_algebra.hpp"
#include "core/closed/place_balances.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

class AngleSearch {
 public:
  AngleSearch(const PlaceProblem& problem, ExactPlace& place) : problem_(problem), place_(place) {}

  [[nodiscard]] bool solve(std::size_t k, const Expression& force) {
    Graph& graph = force.graph();
    const Expression& x = problem_.x[k];
    const Expression sine = sin(x), cosine = cos(x);
    Polynomial e = rational_function(with_tangents_written(force)).above;
    if (trigonometric_arguments(graph, e).empty()) return false;
    e = without_lasting_factors(graph, e);
    if (solve_power_of_tangent(k, e)) return true;
    e = with_single_angles(graph, e);
    e = without_factor(without_factor(std::move(e), sine), cosine);
    if (solve_tangent(k, e)) return true;
    for (const auto& [known, other] : {std::pair(cosine, sine), std::pair(sine, cosine)}) {
      const auto parts = linear_in(graph, e, known, x);
      if (!parts) continue;
      const Expression value = to_expression(graph, -in_lowest_terms(parts->rest, parts->slope));
      const double near = problem_.near[k].middle();
      const bool is_cosine = known == cosine;
      const bool is_negative = is_cosine ? near < 0 : std::abs(near) > std::numbers::pi / 2;
      const ExactPlace::Solved solved{known, other, value, root_beside(value, is_negative)};
      const Expression principal = graph.call(is_cosine ? Function::acos : Function::asin, value);
      if (is_cosine) {
        place_.settle(k, near < 0 ? -principal : principal, solved);
      } else {
        const bool beyond = std::abs(near) > std::numbers::pi / 2;
        const Expression angle =
            beyond ? Number(near < 0 ? -1 : 1) * graph.symbol("pi") - principal : principal;
        place_.settle(k, angle, solved);
      }
      return true;
    }
    return solve_cosine(k, e) || solve_power_of_cosine(k, e);
  }

 private:
  /// p + q cos(x)^n = 0, n > 2.
  [[nodiscard]] bool solve_power_of_cosine(std::size_t k, const Polynomial& e) {
    const Expression& x = problem_.x[k];
    Graph& graph = x.graph();
    const Expression sine = sin(x), cosine = cos(x);
    const double near = problem_.near[k].middle();
    const bool is_beyond = std::abs(near) > std::numbers::pi / 2;
    const int n = highest_power(e, cosine);
    const auto parts = n > 2 ? linear_in(graph, e, cosine, x, n) : std::nullopt;
    if (!parts) return false;
    RationalFunction power = -in_lowest_terms(parts->rest, parts->slope);
    if (is_beyond && n % 2 != 0) power = -power;
    const Expression size = to_expression(graph, power);
    if (depends_on(size, problem_.x) || problem_.sign(power.above) * problem_.sign(power.below) <= 0)
      return false;
    const Expression value = Number(is_beyond ? -1 : 1) * root_of_power(size, Number(n), problem_.sign);
    const Expression principal = graph.call(Function::acos, with_joined_roots(value, problem_.sign));
    const Expression angle = near < 0 ? -principal : principal;
    if (!is_at(problem_, k, angle)) return false;
    place_.settle(k, angle, ExactPlace::Solved{cosine, sine, value, root_beside(value, near < 0)});
    return true;
  }

  /// c0 + c1 cos(x) + c2 cos(x)^2 = 0, or the same of a sine.
  [[nodiscard]] bool solve_cosine(std::size_t k, const Polynomial& e) {
    const Expression& x = problem_.x[k];
    Graph& graph = x.graph();
    const double near = problem_.near[k].middle();
    const bool is_beyond = std::abs(near) > std::numbers::pi / 2;
    for (const bool is_cosine : {true, false}) {
      const Expression known = is_cosine ? cos(x) : sin(x), other = is_cosine ? sin(x) : cos(x);
      const auto c =
          quadratic_in(to_expression(graph, is_cosine ? e : without_cosine_squares(graph, e, x)), known);
      if (!c || std::ranges::any_of(*c, [&](const Expression& part) { return depends_on(part, problem_.x); }))
        continue;
      for (const Expression& value : roots_of((*c)[0], (*c)[1], (*c)[2], problem_.sign)) {
        const Expression principal = graph.call(is_cosine ? Function::acos : Function::asin, value);
        Expression angle = principal;
        if (is_cosine && near < 0) angle = -principal;
        if (!is_cosine && is_beyond) angle = Number(near < 0 ? -1 : 1) * graph.symbol("pi") - principal;
        if (!is_at(problem_, k, angle)) continue;
        const bool is_negative = is_cosine ? near < 0 : is_beyond;
        place_.settle(k, angle, ExactPlace::Solved{known, other, value, root_beside(value, is_negative)});
        return true;
      }
    }
    return false;
  }

  /// +-sqrt(1 - value^2).
  [[nodiscard]] Expression root_beside(const Expression& value, bool is_negative) const {
    Graph& graph = value.graph();
    const Expression root = sqrt(to_expression(graph, rational_function(graph.number(1) - value * value)));
    return is_negative ? -root : root;
  }

  /// a sin(x) + b cos(x) = 0.
  [[nodiscard]] bool solve_tangent(std::size_t k, const Polynomial& force) {
    const Expression& x = problem_.x[k];
    Graph& graph = x.graph();
    const Expression sine = sin(x), cosine = cos(x);
    const auto by_sine = linear_in(graph, force, sine, sine);
    const auto by_cosine = linear_in(graph, force, cosine, cosine);
    if (!by_sine || !by_cosine || by_sine->rest != scaled(by_cosine->slope, times({}, cosine.id(), 1), 1))
      return false;
    const RationalFunction tangent = -in_lowest_terms(by_cosine->slope, by_sine->slope);
    if (depends_on(to_expression(graph, tangent), x)) return false;
    if (solve_known_tangent(k, tangent)) return true;
    const double near = problem_.near[k].middle();
    const int half_turns = std::abs(near) > std::numbers::pi / 2 ? 1 : 0;
    const int sign = problem_.sign(tangent.below) * (half_turns == 0 ? 1 : -1);
    if (sign == 0) return false;
    const Expression above = to_expression(graph, tangent.above), below = to_expression(graph, tangent.below);
    const Expression length = Number(sign) * sqrt(expand(simplify(above * above + below * below)));
    const ExactPlace::Solved solved{cosine, sine, below / length, above / length};
    const Expression angle = graph.call(Function::atan, factored_tangent(graph, tangent)) +
                             Number(near < 0 ? -half_turns : half_turns) * graph.symbol("pi");
    place_.settle(k, angle, solved);
    return true;
  }

  /// p sin(x)^n + q cos(x)^n = 0, n > 1, times what they share.
  [[nodiscard]] bool solve_power_of_tangent(std::size_t k, const Polynomial& force) {
    const Expression& x = problem_.x[k];
    Graph& graph = x.graph();
    const Expression sine = sin(x), cosine = cos(x), one = graph.number(1);
    Polynomial e = without_factor(without_factor(force, sine), cosine);
    const Polynomial square = multiplied_out(pow(sine, Number(2)) + pow(cosine, Number(2)));
    while (auto quotient = exact_quotient(e, square)) e = *std::move(quotient);
    const int n = highest_power(e, sine);
    if (n < 2 || n != highest_power(e, cosine)) return false;
    Polynomial of_sine, of_cosine;
    for (const auto& [monomial, coefficient] : e) {
      const int above = exponent_of(monomial, sine.id()), below = exponent_of(monomial, cosine.id());
      if (above + below != n || (above != 0 && below != 0)) return false;
      add(above == n ? of_sine : of_cosine, times(times(monomial, sine.id(), -above), cosine.id(), -below),
          coefficient);
    }
    RationalFunction power = -in_lowest_terms(of_cosine, of_sine);
    const double near = problem_.near[k].middle();
    const int half_turns = std::abs(near) > std::numbers::pi / 2 ? 1 : 0;
    const int side = (near < 0 ? -1 : 1) * (half_turns == 0 ? 1 : -1);
    if (problem_.sign(power.above) * problem_.sign(power.below) < 0) power = -power;
    const Expression size = to_expression(graph, power);
    if (depends_on(size, problem_.x)) return false;
    const Expression tangent = Number(side) * root_of_power(size, Number(n), problem_.sign);
    const Expression length = sqrt(to_expression(graph, rational_function(one + tangent * tangent)));
    const Expression value = Number(half_turns == 0 ? 1 : -1) * one / length;
    const Expression angle = graph.call(Function::atan, with_joined_roots(tangent, problem_.sign)) +
                             Number(near < 0 ? -half_turns : half_turns) * graph.symbol("pi");
    place_.settle(k, angle, ExactPlace::Solved{cosine, sine, value, tangent * value});
    return true;
  }

  /// tan(x) = tan(u): x is u and any number of half turns.
  [[nodiscard]] bool solve_known_tangent(std::size_t k, const RationalFunction& tangent) {
    const auto u = angle_of_tangent(problem_.x[k].graph(), tangent);
    if (!u) return false;
    constexpr double reach = 1e-6;
    const Expression pi = u->graph().symbol("pi");
    const auto sign_beside = [&](const Expression& e, double place) {
      return problem_.sign(multiplied_out(e - u->graph().number(Number::real(place))));
    };
    for (const int half_turns : {0, 1, -1, 2, -2}) {
      const Expression x = *u + Number(half_turns) * pi;
      const double near = problem_.near[k].middle();
      if (sign_beside(x, near - reach) <= 0 || sign_beside(x, near + reach) >= 0) continue;
      place_.settle(k, x);
      return true;
    }
    return false;
  }

  const PlaceProblem& problem_;
  ExactPlace& place_;
};

}  // namespace

bool is_at(const PlaceProblem& problem, std::size_t k, const Expression& place) {
  constexpr double reach = 1e-6;
  const double near = problem.near[k].middle(), beside = reach * std::abs(near);
  const auto sign_beside = [&](double x) {
    return problem.sign(multiplied_out(place - place.graph().number(Number::real(x))));
  };
  return sign_beside(near - beside) > 0 && sign_beside(near + beside) < 0;
}

bool solve_angle(const PlaceProblem& problem, ExactPlace& place, std::size_t k, const Expression& force) {
  return AngleSearch(problem, place).solve(k, force);
}

}  // namespace qdot
