#include <algorithm>

#include "core/compile/taylor/expansion.hpp"
#include "core/integrate/integrate.hpp"
#include "core/motion/simulation.hpp"
#include "tests/bench/work_precision/motions.hpp"

namespace qdot::bench {
namespace {

constexpr double atol_over_rtol = 1e-3;

RightHandSide right_hand_side(const Problem& problem, Method method) {
  const CompiledFunction& accelerations = problem.dynamics.accelerations();
  const std::size_t n = accelerations.outputs();
  RightHandSide system;
  system.dimension = 2 * n;
  system.derivative = [&accelerations, n, workspace = accelerations.bind(problem.parameters)](
                          double t, std::span<const double> y, std::span<double> derivative) mutable {
    std::copy_n(y.begin() + static_cast<std::ptrdiff_t>(n), n, derivative.begin());
    return accelerations.evaluate(t, y, workspace, derivative.subspan(n));
  };
  if (method == Method::bdf) {
    const CompiledFunction& jacobian = problem.dynamics.jacobian();
    system.jacobian = [&jacobian, workspace = jacobian.bind(problem.parameters)](
                          double t, std::span<const double> y, std::span<double> out) mutable {
      return jacobian.evaluate(t, y, workspace, out);
    };
  }
  if (method == Method::taylor) {
    const auto expansion = std::make_shared<TaylorExpansion>(accelerations, problem.parameters);
    system.expansion = [expansion](double t, std::span<const double> y, unsigned order, std::span<double> c) {
      return expansion->expand(t, y, order, c);
    };
  }
  return system;
}

Outcome solve(const Problem& problem, Method method, double rtol, unsigned order) {
  RunRequest request;
  request.y_start = problem.y_start;
  request.t_end = problem.grid.back();
  request.grid = problem.grid;
  request.method = method;
  request.taylor_order = order;
  request.tolerances = {rtol, rtol * atol_over_rtol};
  const RightHandSide system = right_hand_side(problem, method);
  Run run = integrate(system, request);
  return {std::move(run.states), run.evaluations, run.steps};
}

/// With all of simulate() around it, which is little beside the method itself.
Outcome solve_by_gauss(const Problem& problem, double h) {
  SimulationRequest request = problem.request();
  request.method = Method::gauss;
  request.h = h;
  Simulation simulation = simulate(problem.dynamics, request);
  return {std::move(simulation.states), simulation.evaluations, simulation.steps};
}

}  // namespace

std::vector<Contestant> own_methods(const Problem& problem) {
  std::vector<Contestant> all;
  const auto add = [&](const char* name, Method method) {
    all.push_back({name, "tape",
                   [&problem, method](double tolerance) { return solve(problem, method, tolerance, 0); }});
  };
  add("taylor", Method::taylor);
  add("erk", Method::erk);
  add("adams", Method::adams);
  add("bdf", Method::bdf);
  all.push_back({"gauss", "tape", [&problem](double h) { return solve_by_gauss(problem, h); }});
  return all;
}

std::vector<double> tightest_motion(const Problem& problem) {
  return solve(problem, Method::taylor, 1e-16, TaylorExpansion::highest_order).states;
}

}  // namespace qdot::bench
