#include "core/closed/exact_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/expr/rational_function.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/special_angles.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

constexpr double widest_place = 1e-9;

/// e = slope * u + rest, rest and slope without u; no value where it is no such function.
struct LinearIn {
  Polynomial slope, rest;
};
std::optional<LinearIn> linear_in(Graph& graph, const Polynomial& e, const Expression& u,
                                  const Expression& symbol) {
  LinearIn parts;
  for (const auto& [monomial, coefficient] : e) {
    const int power = exponent_of(monomial, u.id());
    if (power != 0 && power != 1) return std::nullopt;
    const Monomial rest = times(monomial, u.id(), -power);
    if (depends_on(to_expression(graph, rest), symbol)) return std::nullopt;
    add(power == 1 ? parts.slope : parts.rest, rest, coefficient);
  }
  if (parts.slope.empty()) return std::nullopt;
  return parts;
}

Polynomial numerator(const Expression& e) { return rational_function(e).above; }

/// With roots of squares taken, sqrt(h^2) = h where h > 0.
Expression with_roots_taken(const Expression& e, const SignOf& sign) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph, root)) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr || power->exponent.denominator() != Number(2)) continue;
    const Expression base(graph, power->base);
    const Number twice = power->exponent * Number(2);
    const Expression half = positive_root(graph, rational_function(base), sign);
    if (written_length(half) < written_length(sqrt(base)))
      taken.emplace_back(Expression(graph, id), pow(half, twice));
  }
  return taken.empty() ? e : substitute(e, taken);
}

/// Without the factors u, which do not vanish.
Polynomial without_factor(Polynomial e, const Expression& u) {
  if (e.empty()) return e;
  int common = 64;
  for (const auto& [monomial, coefficient] : e) common = std::min(common, exponent_of(monomial, u.id()));
  return scaled(e, times({}, u.id(), -common), Number(1));
}

}  // namespace

std::optional<ExactPlace> ExactPlace::of(const PlaceProblem& problem) {
  ExactPlace place(problem);
  place.take_special_values();
  while (place.solve_one()) {
  }
  for (const Expression& force : problem.forces) {
    if (!rational_function(place.at(force)).is_zero()) return std::nullopt;
  }
  return place;
}

ExactPlace ExactPlace::special(const PlaceProblem& problem) {
  ExactPlace place(problem);
  place.take_special_values();
  return place;
}

void ExactPlace::take_special_values() {
  Graph& graph = problem_->x.empty() ? problem_->forces[0].graph() : problem_->x[0].graph();
  const Expression pi = graph.symbol("pi");
  std::vector<Expression> offsets{graph.number(0)};
  std::vector<double> values{0};
  offsets.insert(offsets.end(), problem_->offsets.begin(), problem_->offsets.end());
  values.insert(values.end(), problem_->offset_values.begin(), problem_->offset_values.end());
  constexpr std::array quarters{0, 2, 1, -1, -2};
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const Interval& near = problem_->near[k];
    if (!(near.width() < widest_place)) continue;
    const std::size_t kinds = problem_->is_angle[k] ? quarters.size() : 1;
    for (std::size_t i = 0; i < (problem_->is_angle[k] ? offsets.size() : 1) && !is_known(k); ++i) {
      for (std::size_t q = 0; q < kinds; ++q) {
        const double value = values[i] + quarters[q] * (std::numbers::pi / 2);
        if (near.lower - 4e-16 * std::abs(value) > value || near.upper + 4e-16 * std::abs(value) < value)
          continue;
        x_[k] = offsets[i] + Number::ratio(quarters[q], 2) * pi;
        replacements_.emplace_back(problem_->x[k], x_[k]);
        break;
      }
    }
  }
}

bool ExactPlace::solve_one() {
  for (std::size_t k = 0; k < x_.size(); ++k) {
    if (is_known(k)) continue;
    for (const Expression& force : problem_->forces) {
      const Expression here = at(force);
      if (!depends_on(here, problem_->x[k])) continue;
      if ((problem_->is_angle[k] && solve_angle(k, here)) || solve(k, here)) return true;
    }
  }
  return false;
}

bool ExactPlace::solve(std::size_t k, const Expression& force) {
  Graph& graph = force.graph();
  const Expression& x = problem_->x[k];
  const auto parts = linear_in(graph, numerator(force), x, x);
  if (!parts) return false;
  x_[k] = to_expression(graph, -in_lowest_terms(parts->rest, parts->slope));
  replacements_.emplace_back(x, x_[k]);
  return true;
}

bool ExactPlace::solve_angle(std::size_t k, const Expression& force) {
  Graph& graph = force.graph();
  const Expression& x = problem_->x[k];
  const Expression sine = sin(x), cosine = cos(x);
  Polynomial e = with_single_angles(graph, numerator(force));
  e = without_factor(without_factor(std::move(e), sine), cosine);
  if (solve_tangent(k, e)) return true;
  for (const auto& [known, other] : {std::pair(cosine, sine), std::pair(sine, cosine)}) {
    const auto parts = linear_in(graph, e, known, x);
    if (!parts) continue;
    const Expression value = to_expression(graph, -in_lowest_terms(parts->rest, parts->slope));
    solved_.push_back({known, other, value, std::nullopt});
    const double near = problem_->near[k].middle();
    const bool is_cosine = known == cosine;
    const Expression principal = graph.call(is_cosine ? Function::acos : Function::asin, value);
    if (is_cosine) {
      x_[k] = near < 0 ? -principal : principal;
    } else {
      const bool beyond = std::abs(near) > std::numbers::pi / 2;
      x_[k] = beyond ? Number(near < 0 ? -1 : 1) * graph.symbol("pi") - principal : principal;
    }
    return true;
  }
  return false;
}

/// a sin(x) + b cos(x) = 0.
bool ExactPlace::solve_tangent(std::size_t k, const Polynomial& force) {
  const Expression& x = problem_->x[k];
  Graph& graph = x.graph();
  const Expression sine = sin(x), cosine = cos(x);
  const auto by_sine = linear_in(graph, force, sine, sine);
  const auto by_cosine = linear_in(graph, force, cosine, cosine);
  if (!by_sine || !by_cosine || by_sine->rest != scaled(by_cosine->slope, times({}, cosine.id(), 1), 1))
    return false;
  const RationalFunction tangent = -in_lowest_terms(by_cosine->slope, by_sine->slope);
  if (depends_on(to_expression(graph, tangent), x)) return false;
  const double near = problem_->near[k].middle();
  const int half_turns = std::abs(near) > std::numbers::pi / 2 ? 1 : 0;
  const int sign = problem_->sign(tangent.below) * (half_turns == 0 ? 1 : -1);
  if (sign == 0) return false;
  const Expression above = to_expression(graph, tangent.above), below = to_expression(graph, tangent.below);
  const Expression length = Number(sign) * sqrt(expand(simplify(above * above + below * below)));
  solved_.push_back({cosine, sine, below / length, above / length});
  x_[k] = graph.call(Function::atan, above / below) +
          Number(near < 0 ? -half_turns : half_turns) * graph.symbol("pi");
  return true;
}

Expression ExactPlace::at(const Expression& e) const {
  Expression result = with_roots_taken(with_special_angles(substitute(e, replacements_)), problem_->sign);
  if (solved_.empty()) return result;
  Graph& graph = e.graph();
  Polynomial opened = with_single_angles(graph, multiplied_out(result));
  for (const Solved& angle : solved_) {
    Polynomial next;
    for (const auto& [monomial, coefficient] : opened) {
      const int known = exponent_of(monomial, angle.known.id()),
                other = exponent_of(monomial, angle.other.id());
      if (known < 0 || other < 0) {
        add(next, monomial, coefficient);
        continue;
      }
      const int replaced = angle.other_value ? other : other - other % 2;
      const Monomial rest = times(times(monomial, angle.known.id(), -known), angle.other.id(), -replaced);
      const Expression square = graph.number(1) - angle.value * angle.value;
      const Expression factor =
          pow(angle.value, Number(known)) *
          (angle.other_value ? pow(*angle.other_value, Number(other)) : pow(square, Number(other / 2)));
      add(next, scaled(multiplied_out(factor), rest, coefficient));
    }
    opened = std::move(next);
  }
  return to_expression(graph, opened);
}

}  // namespace qdot
