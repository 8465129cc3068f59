#include "core/motion/vanishing_speed.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/short_number.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/print/print.hpp"
#include "core/mechanics/notation.hpp"

namespace qdot {
namespace {

constexpr double vanished = 1e-9;  ///< of what it was; its square is far smaller

/// What the forces divide by, all that depends on velocities.
std::vector<Expression> divisors(const Lagrangian& lagrangian) {
  std::vector<NodeId> roots;
  for (const Expression& force : lagrangian.generalized_forces) roots.push_back(force.id());
  std::vector<Expression> found;
  for (const NodeId id : reachable(*lagrangian.graph, roots)) {
    const auto* power = std::get_if<Power>(&lagrangian.graph->node(id));
    if (power == nullptr || !power->exponent.is_negative()) continue;
    const Expression base(*lagrangian.graph, power->base);
    if (depends_on(base, lagrangian.symbols.coordinates.rate)) found.push_back(base);
  }
  return found;
}

/// The velocities that the motion had, by size: at its start, at its rows and on the way between its ends.
std::vector<double> largest_rates(std::span<const double> start, const Simulation& failed) {
  const std::size_t n = start.size() / 2;
  std::vector<double> largest(n);
  for (std::size_t i = 0; i < n; ++i) {
    largest[i] = std::abs(start[n + i]);
    for (std::size_t row = 0; row < failed.rows; ++row)
      largest[i] = std::max(largest[i], std::abs(failed.states[row * 2 * n + n + i]));
  }
  return largest;
}

}  // namespace

std::string speed_that_vanished(const Dynamics& dynamics, const Reals& parameters,
                                std::span<const double> start, const Simulation& failed) {
  const Model& model = dynamics.model();
  const Lagrangian lagrangian = copied(model.lagrangian);
  const Symbols& symbols = lagrangian.symbols;
  const std::vector<double> rates = largest_rates(start, failed);
  const std::size_t n = rates.size();
  std::vector<Assignment> there{{symbols.t, failed.t}}, before;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    there.emplace_back(symbols.parameters[i], parameters[i]);
  for (std::size_t i = 0; i < n; ++i) there.emplace_back(symbols.coordinates.value[i], failed.y[i]);
  before = there;
  for (std::size_t i = 0; i < n; ++i) {
    there.emplace_back(symbols.coordinates.rate[i], failed.y[n + i]);
    before.emplace_back(symbols.coordinates.rate[i], rates[i]);
  }
  for (const Expression& speed : divisors(lagrangian)) {
    const double now = std::abs(evaluate(speed, there)), was = std::abs(evaluate(speed, before));
    if (!(now <= vanished * was) || !(was > 0)) continue;
    return "At t = " + short_number(failed.t, 10) + " " + print(speed, Form::text, notation_of(model.scene)) +
           " comes to 0, and a force divides by it: what slid comes to rest there, and a force against the "
           "velocity has no direction. The motion up to that instant can be asked for; on a line, friction "
           "that is written with sign() of the velocity holds it at rest.";
  }
  return {};
}

}  // namespace qdot
