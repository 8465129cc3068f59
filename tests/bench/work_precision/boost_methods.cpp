#include <boost/numeric/odeint/integrate/integrate_times.hpp>
#include <boost/numeric/odeint/integrate/max_step_checker.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer_dense_out.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <stdexcept>

#include "tests/bench/work_precision/right_hand_sides.hpp"

namespace qdot::bench {
namespace {

namespace odeint = boost::numeric::odeint;

/// integrate_times fits the steps of methods without dense output to the samples.
template <class Equations, class Stepper>
Outcome solve(const Problem& problem, Equations equations, Stepper stepper) {
  using State = std::array<double, Equations::dimension>;
  State y;
  std::copy_n(problem.y_start.begin(), y.size(), y.begin());
  Outcome outcome;
  outcome.states.reserve(samples * y.size());
  std::uint64_t calls = 0;
  const auto system = [&equations, &calls](const State& x, State& f, double t) {
    ++calls;
    evaluate(equations, x, f, t);
  };
  const auto keep = [&outcome](const State& x, double) {
    outcome.states.insert(outcome.states.end(), x.begin(), x.end());
  };
  try {
    odeint::integrate_times(stepper, system, y, problem.grid.begin(), problem.grid.end(),
                            problem.grid[1] / 10, keep);
  } catch (const std::runtime_error&) {
    outcome.states.clear();  // no step was small enough
  }
  outcome.evaluations = calls;
  return outcome;
}

}  // namespace

std::vector<Contestant> boost_methods(const Problem& problem) {
  std::vector<Contestant> all;
  for_all_equations(problem, [&](const char* kind, const auto& equations) {
    using State = std::array<double, std::remove_cvref_t<decltype(equations)>::dimension>;
    all.push_back(
        {"boost_dopri5", kind, [&problem, equations](double tolerance) {
           return solve(problem, equations,
                        odeint::make_dense_output(tolerance, tolerance, odeint::runge_kutta_dopri5<State>()));
         }});
    all.push_back({"boost_fehlberg78", kind, [&problem, equations](double tolerance) {
                     return solve(problem, equations,
                                  odeint::make_controlled(tolerance, tolerance,
                                                          odeint::runge_kutta_fehlberg78<State>()));
                   }});
    all.push_back({"boost_bulirsch_stoer", kind, [&problem, equations](double tolerance) {
                     return solve(problem, equations,
                                  odeint::bulirsch_stoer_dense_out<State>(tolerance, tolerance));
                   }});
  });
  return all;
}

}  // namespace qdot::bench
