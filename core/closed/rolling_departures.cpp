#include "core/closed/rolling_departures.hpp"

#include <algorithm>

#include "core/closed/closed_form.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/special_angles.hpp"

namespace qdot {
namespace {

/// M, D, K, A and B of core/steady/steady_rolling.hpp at the motion, by the parameters and the symbols of
/// what is written as a number.
class RollingMatrices {
 public:
  RollingMatrices(const Lagrangian& own, ExactValues& values, const Modes& found, GivenRates rates)
      : own_(own), graph_(*own.graph), values_(values), n_(own.symbols.coordinates.value.size()) {
    write_motion(found, rates);
    follow_constraints();
  }

  [[nodiscard]] const std::vector<Expression>& given() const { return given_; }

  /// R, a row for each departure; empty where the equations do not say that the motion is steady.
  [[nodiscard]] RationalRows matrix() {
    write_matrices();
    const SolvedRows of_rates = solved_rows(slope_, n_);
    if (!settle_multipliers(of_rates)) return {};
    RationalRows holonomic;
    for (std::size_t j = 0; j < slope_.size(); ++j) {
      if (own_.constraints[j].position) holonomic.push_back(slope_[j]);
    }
    return first_order(of_rates, solved_rows(holonomic, n_));
  }

 private:
  void write_motion(const Modes& found, GivenRates rates) {
    const Symbols::Varying& q = own_.symbols.coordinates;
    const Expression zero = graph_.number(0);
    for (std::size_t i = 0; i < n_; ++i) {
      write(q.value[i], values_.coordinate(i), found.y[i]);
      write(q.rate[i], rates == GivenRates::as_written ? values_.velocity(i) : std::nullopt, found.y[n_ + i]);
      there_.emplace_back(q.second_rate[i], zero);
    }
  }

  /// What is 0, an angle by pi, or given by the parameters, as it is; else it stays as its symbol.
  void write(const Expression& symbol, const std::optional<Expression>& text, double value) {
    values_.set(symbol, Real(value));
    const auto is_read = [&] {
      constexpr double rounding = 1e-12;
      return text && text->number() == nullptr &&
             agrees(values_.value(*text), value, rounding * std::abs(value));
    };
    if (value == 0) {
      there_.emplace_back(symbol, graph_.number(0));
    } else if (is_read()) {
      there_.emplace_back(symbol, *text);
    } else {
      given_.push_back(symbol);
    }
  }

  /// A rate that stands as its symbol, and that a constraint gives by the others: x_dot = r*phi_dot.
  void follow_constraints() {
    for (const ConstraintEquation& constraint : own_.constraints) {
      const Expression left = with_special_angles(substitute(constraint.rate, there_));
      const auto gives = [&](const Expression& rate) {
        const Expression slope = differentiate(left, rate);
        return !slope.is_zero() && !depends_on(slope, rate);
      };
      const auto& rates = own_.symbols.coordinates.rate;
      const auto found = std::ranges::find_if(given_, [&](const Expression& e) {
        return std::ranges::find(rates, e) != rates.end() && gives(e);
      });
      if (found == given_.end()) continue;
      const Replacement none{*found, graph_.number(0)};
      const Expression value = -substitute(left, {&none, 1}) / differentiate(left, *found);
      const Replacement follows{*found, to_expression(graph_, rational_function(value))};
      for (auto& [symbol, e] : there_) e = substitute(e, {&follows, 1});
      there_.push_back(follows);
      given_.erase(found);
    }
  }

  [[nodiscard]] RationalFunction at(const Expression& e) const {
    return rational_function(with_special_angles(substitute(e, there_)));
  }

  [[nodiscard]] RationalRows slopes_of(const std::vector<Expression>& rows,
                                       const std::vector<Expression>& along) const {
    RationalRows result;
    for (const Expression& row : rows) {
      result.emplace_back();
      for (const Expression& v : along) result.back().push_back(at(differentiate(row, v)));
    }
    return result;
  }

  void write_matrices() {
    const Symbols::Varying& q = own_.symbols.coordinates;
    const Expression zero = graph_.number(0);
    std::vector<Expression> rates;
    std::vector<Replacement> free;
    for (const Expression& lambda : own_.symbols.multipliers) free.emplace_back(lambda, zero);
    for (const ConstraintEquation& constraint : own_.constraints) rates.push_back(constraint.rate);
    for (std::size_t i = 0; i < n_; ++i) {
      const Expression momentum = differentiate(own_.lagrangian, q.rate[i]);
      with_multipliers_.push_back(total_derivative(momentum, own_.symbols.rates()) -
                                  differentiate(own_.lagrangian, q.value[i]) - own_.generalized_forces[i]);
      equations_.push_back(substitute(with_multipliers_.back(), free));
    }
    mass_ = slopes_of(equations_, q.second_rate);
    damping_ = slopes_of(equations_, q.rate);
    slope_ = slopes_of(rates, q.rate);
    drift_ = slopes_of(rates, q.value);
  }

  /// lambda from E = A^T lambda, which has to hold in all its rows, and K with it.
  [[nodiscard]] bool settle_multipliers(const SolvedRows& of_rates) {
    RationalRows force;
    for (const Expression& e : equations_) force.push_back({at(e)});
    RationalRows held;
    for (const std::size_t d : of_rates.dependent) held.push_back(force[d]);
    const RationalRows lambda = multiplied(transposed(of_rates.inverse), held);
    const RationalRows rest =
        added(force, rational_function(graph_.number(-1)), multiplied(transposed(slope_), lambda));
    if (!std::ranges::all_of(rest, [](const auto& row) { return row[0].is_zero(); })) return false;
    for (const ConstraintEquation& constraint : own_.constraints) {
      if (!at(constraint.rate).is_zero()) return false;
    }
    std::vector<Replacement> multipliers;
    for (std::size_t j = 0; j < lambda.size(); ++j)
      multipliers.emplace_back(own_.symbols.multipliers[j], to_expression(graph_, lambda[j][0]));
    for (const Expression& e : with_multipliers_) {
      stiffness_.emplace_back();
      for (const Expression& v : own_.symbols.coordinates.value)
        stiffness_.back().push_back(at(substitute(differentiate(e, v), multipliers)));
    }
    return true;
  }

  /// Y u, the rates that constraints ask for: -A_D^-1 B u where they are dependent.
  [[nodiscard]] RationalRows held_back(const SolvedRows& of_rates, const RationalRows& u) const {
    const RationalRows asked = multiplied(of_rates.inverse, multiplied(drift_, u));
    RationalRows result(n_, std::vector<RationalFunction>(u[0].size()));
    for (std::size_t k = 0; k < asked.size(); ++k) {
      for (std::size_t i = 0; i < asked[k].size(); ++i) result[of_rates.dependent[k]][i] = -asked[k][i];
    }
    return result;
  }

  [[nodiscard]] RationalRows first_order(const SolvedRows& of_rates, const SolvedRows& of_places) const {
    const RationalFunction one = rational_function(graph_.number(1));
    const std::size_t places = of_places.free.size(), d = places + of_rates.free.size();
    RationalRows place(n_, std::vector<RationalFunction>(d)), rate;
    for (std::size_t i = 0; i < n_; ++i) std::ranges::copy(of_places.allowed[i], place[i].begin());
    rate = held_back(of_rates, place);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t k = places; k < d; ++k) rate[i][k] = of_rates.allowed[i][k - places];
    }
    const RationalRows forces =
        added(added(multiplied(mass_, held_back(of_rates, rate)), one, multiplied(damping_, rate)), one,
              multiplied(stiffness_, place));
    const RationalRows z = transposed(of_rates.allowed);
    const RationalRows inertia = multiplied(z, multiplied(mass_, of_rates.allowed));
    RationalRows result;
    for (const std::size_t i : of_places.free) result.push_back(rate[i]);
    for (auto& row : multiplied(inverse(inertia), multiplied(z, forces))) {
      for (RationalFunction& entry : row) entry = -entry;
      result.push_back(std::move(row));
    }
    return result;
  }

  /// By the rows' own unknowns in the order in which they are taken.
  [[nodiscard]] static RationalRows inverse(const RationalRows& a) {
    const SolvedRows solved = solved_rows(a, a.size());
    RationalRows result(a.size());
    for (std::size_t k = 0; k < a.size(); ++k) result[solved.dependent[k]] = solved.inverse[k];
    return result;
  }

  const Lagrangian& own_;
  Graph& graph_;
  ExactValues& values_;
  std::size_t n_;
  std::vector<Replacement> there_;
  std::vector<Expression> given_, equations_, with_multipliers_;
  RationalRows mass_, damping_, stiffness_, slope_, drift_;
};

}  // namespace

RollingDepartures rolling_departures(const Lagrangian& own, ExactValues& values, const Modes& found,
                                     GivenRates rates) {
  RollingMatrices matrices(own, values, found, rates);
  RationalRows r = matrices.matrix();
  return {std::move(r), matrices.given()};
}

}  // namespace qdot
