#include "core/closed/place_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/closed/exact_roots.hpp"
#include "core/closed/one_unknown.hpp"
#include "core/closed/place_algebra.hpp"
#include "core/closed/place_angles.hpp"
#include "core/closed/place_balances.hpp"
#include "core/closed/place_brackets.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/trigonometry.hpp"
#include "core/steady/exponential_form.hpp"

namespace qdot {
namespace {

constexpr double widest_place = 1e-9;
constexpr double widest_special_place = 1e-7;  ///< where curves meet, places are known less well

bool is_near(const Interval& x, double value) {
  const double rounding = 4e-16 * std::abs(value);
  return x.lower - rounding <= value && value <= x.upper + rounding;
}

Polynomial numerator(const Expression& e) { return rational_function(e).above; }

class PlaceSearch {
 public:
  explicit PlaceSearch(const PlaceProblem& problem)
      : problem_(problem), place_(problem), equations_(problem.forces) {}

  [[nodiscard]] const ExactPlace& place() const { return place_; }

  void take_special_values() {
    Graph& graph = problem_.x.empty() ? problem_.forces[0].graph() : problem_.x[0].graph();
    const Expression pi = graph.symbol("pi");
    constexpr std::array quarters{0, 2, 1, -1, -2};
    for (std::size_t k = 0; k < problem_.x.size(); ++k) {
      const Interval& near = problem_.near[k];
      if (!(near.width() < widest_special_place)) continue;
      std::vector<PlaceProblem::Known> offsets{{graph.number(0), 0}};
      if (problem_.is_angle[k])
        offsets.insert(offsets.end(), problem_.alike[k].begin(), problem_.alike[k].end());
      for (std::size_t i = 0; i < offsets.size() && !place_.is_known(k); ++i) {
        for (std::size_t q = 0; q < quarters.size(); ++q) {
          if (!is_near(near, offsets[i].value + quarters[q] * (std::numbers::pi / 2))) continue;
          if (i > 0 && !is_decided(k)) continue;
          place_.settle(k, offsets[i].symbol + Number::ratio(quarters[q], 2) * pi);
          break;
        }
      }
    }
  }

  /// Proposes that all start where they rest, as the corners of a triangle do.
  void take_starts() {
    for (std::size_t k = 0; k < problem_.x.size(); ++k) {
      const auto& start = problem_.starts[k];
      if (start && problem_.near[k].width() < widest_place && is_near(problem_.near[k], start->value))
        place_.settle(k, start->symbol);
    }
  }

  [[nodiscard]] bool solve_one() {
    for (std::size_t k = 0; k < problem_.x.size(); ++k) {
      if (place_.is_known(k)) continue;
      for (const Expression& force : equations_) {
        const Expression here = place_.at(force);
        if (!depends_on(here, problem_.x[k])) continue;
        if (solve_angle(problem_, place_, k, here) || solve(k, here) || solve_bracket(k, here)) return true;
      }
    }
    return false;
  }

  /// What two brackets are, once.
  [[nodiscard]] bool take_brackets() {
    const std::size_t before = equations_.size();
    if (before == problem_.forces.size()) {
      std::vector<Expression> here;
      for (const Expression& force : problem_.forces) here.push_back(place_.at(force));
      for (Expression& e : equations_of_brackets(here, place_.undecided(), problem_.sign))
        equations_.push_back(std::move(e));
    }
    return equations_.size() > before;
  }

  /// Proposes that two unknowns are equal or opposite, as two ions in a trap.
  [[nodiscard]] bool take_mirror() {
    for (std::size_t k = 0; k < problem_.x.size(); ++k) {
      if (!may_be_proposed(k)) continue;
      for (std::size_t j = 0; j < k; ++j) {
        if (!may_be_proposed(j)) continue;
        for (const int side : {-1, 1}) {
          const Interval difference = problem_.near[k] - Interval(side) * problem_.near[j];
          if (!is_near(difference, 0)) continue;
          place_.settle(k, Number(side) * problem_.x[j]);
          return true;
        }
      }
    }
    return false;
  }

  /// Proposes a parameter; whether the forces vanish there is seen later. Of several with the same number one
  /// at which a force vanishes at once.
  [[nodiscard]] bool take_parameter() {
    for (std::size_t k = 0; k < problem_.x.size(); ++k) {
      if (!may_be_proposed(k) || problem_.is_angle[k]) continue;
      const std::vector<Expression> alike = alike_at(k);
      if (alike.empty() || !is_decided(k)) continue;
      const auto fits = [&](const Expression& value) { return alike.size() == 1 || ends_a_force(k, value); };
      const auto best = std::ranges::find_if(alike, fits);
      place_.settle(k, best == alike.end() ? alike.front() : *best);
      return true;
    }
    return false;
  }

 private:
  /// The parameters, and what is opposite to them, that have the number of x_k.
  [[nodiscard]] std::vector<Expression> alike_at(std::size_t k) const {
    std::vector<Expression> found;
    for (const PlaceProblem::Known& p : problem_.alike[k]) {
      for (const int side : {1, -1}) {
        if (is_near(problem_.near[k], side * p.value)) found.push_back(Number(side) * p.symbol);
      }
    }
    return found;
  }

  /// Whether a force vanishes where x_k has the value.
  [[nodiscard]] bool ends_a_force(std::size_t k, const Expression& value) const {
    ExactPlace there = place_;
    there.settle(k, value);
    return std::ranges::any_of(equations_, [&](const Expression& force) {
      return depends_on(force, problem_.x[k]) && rational_function(there.at(force)).is_zero();
    });
  }

  [[nodiscard]] bool may_be_proposed(std::size_t k) const {
    return !place_.is_known(k) && problem_.near[k].width() < widest_place;
  }

  [[nodiscard]] bool is_decided(std::size_t k) const {
    return !problem_.is_decided || problem_.is_decided(k);
  }

  [[nodiscard]] bool solve(std::size_t k, const Expression& force) {
    Graph& graph = force.graph();
    const Expression& x = problem_.x[k];
    if (const auto linear = balance_of_powers(problem_, k, force)) return solve(k, *linear);
    const Polynomial above = without_lasting_factors(graph, without_factor(numerator(force), x));
    if (const auto inside = without_logarithm(graph, above, x)) return solve(k, *inside);
    const int n = highest_power(above, x);
    const auto parts = n > 0 ? linear_in(graph, above, x, x, n) : std::nullopt;
    if (!parts) {
      return (n == 2 && solve_quadratic(k, above)) || solve_exponential(k, force) || solve_power(k, above) ||
             solve_root(k, above);
    }
    const RationalFunction value = -in_lowest_terms(parts->rest, parts->slope);
    if (n == 1) {
      place_.settle(k, to_expression(graph, value));
      return true;
    }
    const Expression power = to_expression(graph, value);
    if (depends_on(power, problem_.x)) return false;
    const auto principal = root(k, n, value);
    if (!principal) return false;
    if (n == 2 && square_root(value).is_rational()) {
      place_.settle(k, *principal);
      return true;
    }
    place_.settle(k, *principal, ExactPlace::Powered{x, Number(n), power});
    return true;
  }

  /// The value of x^n: the one that is near.
  [[nodiscard]] bool solve_power(std::size_t k, const Polynomial& force) {
    const Expression& x = problem_.x[k];
    const auto e = quadratic_in_power(x.graph(), force, x);
    if (!e || std::ranges::any_of(e->c, [&](const Expression& c) { return depends_on(c, problem_.x); }))
      return false;
    for (const Expression& value : roots_of(e->c[0], e->c[1], e->c[2], problem_.sign)) {
      if (problem_.sign(multiplied_out(value)) <= 0) continue;
      const Expression size = root_of_power(value, e->n, problem_.sign);
      const Expression place = problem_.near[k].middle() < 0 ? -size : size;
      if (!is_at(problem_, k, place)) continue;
      place_.settle(k, place, ExactPlace::Powered{x, e->n, value});
      return true;
    }
    return false;
  }

  /// The root of a sum goes when it is squared.
  [[nodiscard]] bool solve_root(std::size_t k, const Polynomial& force) {
    const auto squared = without_square_root(problem_.x[k].graph(), force, problem_.x[k]);
    return squared && solve_power(k, *squared);
  }

  /// A bracket that is known by its power, and then x by the bracket.
  [[nodiscard]] bool solve_bracket(std::size_t k, const Expression& force) {
    Graph& graph = force.graph();
    const Expression& x = problem_.x[k];
    Polynomial e = numerator(force);
    for (const Expression& factor : {x, sin(x), cos(x)}) e = without_factor(std::move(e), factor);
    const auto bracket = bracket_in(graph, e, x, problem_.sign);
    if (!bracket || depends_on(to_expression(graph, bracket->value), problem_.x)) return false;
    const auto value = raised(graph, *bracket, Number(1), problem_.sign);
    if (!value) return false;
    place_.take(*bracket);
    const Expression left = bracket->base - *value;
    if (solve_angle(problem_, place_, k, left) || solve(k, left)) return true;
    place_.forget_bracket();
    return false;
  }

  /// c0 + c1 x + c2 x^2 = 0: the root at which the slope c1 + 2 c2 x has the sign that it has at x_k.
  [[nodiscard]] bool solve_quadratic(std::size_t k, const Polynomial& force) {
    const Expression& x = problem_.x[k];
    Graph& graph = x.graph();
    const auto c = quadratic_in(to_expression(graph, force), x);
    if (!c || std::ranges::any_of(*c, [&](const Expression& e) { return depends_on(e, problem_.x); }))
      return false;
    const auto sign_at = [&](const Expression& place) {
      const RationalFunction slope = rational_function((*c)[1] + Number(2) * (*c)[2] * place);
      return problem_.sign(slope.above) * problem_.sign(slope.below);
    };
    const int near = sign_at(x);
    for (const Expression& root : roots_of((*c)[0], (*c)[1], (*c)[2], problem_.sign)) {
      if (near == 0 || sign_at(root) != near) continue;
      place_.settle(k, root);
      return true;
    }
    return false;
  }

  /// c0 + c1 w + c2 w^2 = 0 of w = exp(s x + r): the root as in solve_quadratic.
  [[nodiscard]] bool solve_exponential(std::size_t k, const Expression& force) {
    const Expression& x = problem_.x[k];
    Graph& graph = x.graph();
    const auto found = by_exponential(force, {&x, 1});
    if (!found) return false;
    const ByExponential by_w = in_powers_apart(*found);
    const Expression slope = differentiate(by_w.argument, x);
    const auto c = quadratic_in(to_expression(graph, by_w.e), by_w.w);
    if (!c || depends_on(slope, problem_.x) ||
        std::ranges::any_of(*c, [&](const Expression& e) { return depends_on(e, problem_.x); }))
      return false;
    const auto sign_at = [&](const Expression& w) {
      const RationalFunction rate = rational_function((*c)[1] + Number(2) * (*c)[2] * w);
      return problem_.sign(rate.above) * problem_.sign(rate.below);
    };
    const int near = sign_at(graph.call(Function::exp, by_w.argument));
    const Replacement origin{x, graph.number(0)};
    const Expression offset = substitute(by_w.argument, {&origin, 1});
    for (const Expression& root : roots_of((*c)[0], (*c)[1], (*c)[2], problem_.sign)) {
      const RationalFunction w = rational_function(root);
      if (problem_.sign(w.above) * problem_.sign(w.below) <= 0 || near == 0 || sign_at(root) != near)
        continue;
      const Expression inverse = graph.number(1) / root;
      const bool turned = written_length(inverse) < written_length(root);
      const Expression logarithm =
          turned ? -graph.call(Function::log, inverse) : graph.call(Function::log, root);
      place_.settle(k, (logarithm - offset) / slope);
      return true;
    }
    return false;
  }

  /// The root of x^n = value near x_k.
  [[nodiscard]] std::optional<Expression> root(std::size_t k, int n, const RationalFunction& value) const {
    Graph& graph = problem_.x[k].graph();
    const bool is_below_zero = problem_.near[k].middle() < 0;
    const RationalFunction size = is_below_zero && n % 2 != 0 ? -value : value;
    const auto found = n == 2 ? std::optional(positive_root(graph, size, problem_.sign))
                              : root_of_product(graph, size, n, problem_.sign);
    if (!found) return std::nullopt;
    return is_below_zero ? -*found : *found;
  }

  const PlaceProblem& problem_;
  ExactPlace place_;
  std::vector<Expression> equations_;  ///< the forces, and what follows from them
};

}  // namespace

namespace {

bool rests(const PlaceProblem& problem, const ExactPlace& place) {
  return std::ranges::all_of(
      problem.forces, [&](const Expression& force) { return rational_function(place.at(force)).is_zero(); });
}

}  // namespace

/// Unknowns that are equal are written so before the forces are solved, where they are so for all parameters.
std::optional<ExactPlace> exact_place(const PlaceProblem& problem) {
  for (const bool from_starts : {false, true}) {
    for (const bool mirrored : {true, false}) {
      PlaceSearch search(problem);
      if (from_starts) search.take_starts();
      search.take_special_values();
      if (mirrored && !search.take_mirror()) continue;
      while (search.solve_one() || search.take_brackets() || search.take_mirror() ||
             search.take_parameter()) {
      }
      if (rests(problem, search.place())) return search.place();
    }
  }
  return std::nullopt;
}

std::optional<Expression> solved_for(const Expression& e, const Expression& u, const Interval& near,
                                     const SignOf& sign) {
  const PlaceProblem problem{{u}, {false}, {{}}, {std::nullopt}, {e}, {near}, sign};
  const auto place = exact_place(problem);
  return place && place->is_known(0) ? std::optional(place->x()[0]) : std::nullopt;
}

ExactPlace special_place(const PlaceProblem& problem) {
  PlaceSearch search(problem);
  search.take_special_values();
  return search.place();
}

}  // namespace qdot
