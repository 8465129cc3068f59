#include "core/steady/balance_problem.hpp"

#include <cmath>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

/// A number that was written in decimals stands for its neighbours too.
Interval with_neighbours(double x) {
  return x == 0 ? Interval(0) : Interval(std::nextafter(x, -infinity), std::nextafter(x, infinity));
}

BalanceKinks derive_balance_kinks(const Statics& statics, const std::string& unknown) {
  Graph graph(*statics.reduction.graph);
  const Expression u = graph.symbol(unknown);
  std::vector<Expression> rest;
  for (const Expression& g : statics.rest) rest.push_back(graph.adopt(g));
  return {!unfolded(rest, {&u, 1}).arguments.empty(), derive_smooth_forces(statics)};
}

std::shared_ptr<const BalanceKinks> kinks_of(const Dynamics& dynamics, const PositionStatics& position,
                                             const Reals& parameters, const std::string& unknown) {
  if (position.surface)
    return std::make_shared<const BalanceKinks>(derive_balance_kinks(*position.statics, unknown));
  return dynamics.derived<BalanceKinks>("kinks beside " + unknown, parameters, [&](const Statics& statics) {
    return derive_balance_kinks(statics, unknown);
  });
}

void place_position(BalanceProblem& problem) {
  for (const std::size_t i : problem.reduction().kept) {
    if (problem.is_multiplier(i)) {  // no force has it
      problem.x.emplace_back(0);
      problem.near.emplace_back(0);
      continue;
    }
    problem.x.push_back(Interval::literal(problem.y.exact(i)));
    problem.near.push_back(hull(problem.x.back(), with_neighbours(problem.y[i])));
  }
}

}  // namespace

std::shared_ptr<const SteadyPolynomial> polynomial_of(const Dynamics& dynamics,
                                                      const PositionStatics& position,
                                                      const Reals& parameters, const std::string& unknown) {
  if (position.surface)
    return std::make_shared<const SteadyPolynomial>(
        derive_steady_polynomial(position.surface->dynamics->model(), *position.statics,
                                 *position.on_surface->graph, position.on_surface->rest, unknown));
  return dynamics.derived<SteadyPolynomial>("solve for " + unknown, parameters, [&](const Statics& statics) {
    return derive_steady_polynomial(dynamics.model(), statics, *statics.reduction.graph, statics.rest,
                                    unknown);
  });
}

BalanceProblem balance_problem(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                               const std::string& unknown) {
  const Reals with = with_unknown(dynamics.model().scene, parameters, unknown);
  PositionStatics position = position_statics(dynamics, with);
  auto polynomial = polynomial_of(dynamics, position, with, unknown);
  auto kinks = kinks_of(dynamics, position, with, unknown);
  BalanceProblem problem{.dynamics = dynamics,
                         .unknown = unknown,
                         .parameters = with,
                         .y = y,
                         .position = std::move(position),
                         .polynomial = std::move(polynomial),
                         .kinks = std::move(kinks),
                         .x = {},
                         .near = {},
                         .constants = with.as<Interval>(),
                         .domain = {}};
  place_position(problem);
  for (const std::size_t c : problem.reduction().ignored)
    problem.constants.push_back(Interval::literal(y.exact(y.size() / 2 + c)));
  if (problem.solves_for_parameter())
    problem.domain = problem.scene().parameters[problem.polynomial->place].domain;
  return problem;
}

}  // namespace qdot
