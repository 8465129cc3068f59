#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <memory>

#include "tests/bench/work_precision/right_hand_sides.hpp"

namespace qdot::bench {
namespace {

constexpr unsigned long most_steps_a_sample = 100'000;

template <class Equations>
struct Counted {
  Equations equations;
  std::uint64_t calls{};
};

template <class Equations>
int derivative(double t, const double y[], double f[], void* context) {
  auto& counted = *static_cast<Counted<Equations>*>(context);
  using State = std::array<double, Equations::dimension>;
  State state, slope;
  std::copy_n(y, state.size(), state.begin());
  ++counted.calls;
  evaluate(counted.equations, state, slope, t);
  std::copy_n(slope.begin(), slope.size(), f);
  return GSL_SUCCESS;
}

template <class Equations>
Outcome solve(const Problem& problem, const Equations& equations, const gsl_odeiv2_step_type* type,
              double tolerance) {
  Counted<Equations> counted{equations};
  gsl_odeiv2_system system{derivative<Equations>, nullptr, Equations::dimension, &counted};
  const std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> driver(
      gsl_odeiv2_driver_alloc_y_new(&system, type, problem.grid[1] / 10, tolerance, tolerance),
      gsl_odeiv2_driver_free);
  gsl_odeiv2_driver_set_nmax(driver.get(), most_steps_a_sample);
  std::vector<double> y = problem.y_start;
  Outcome outcome;
  outcome.states.reserve(samples * y.size());
  double t = 0;
  for (const double next : problem.grid) {
    if (next > t && gsl_odeiv2_driver_apply(driver.get(), &t, next, y.data()) != GSL_SUCCESS) break;
    outcome.states.insert(outcome.states.end(), y.begin(), y.end());
  }
  outcome.evaluations = counted.calls;
  return outcome;
}

}  // namespace

std::vector<Contestant> gsl_methods(const Problem& problem) {
  gsl_set_error_handler_off();
  std::vector<Contestant> all;
  for_all_equations(problem, [&](const char* kind, const auto& equations) {
    const auto add = [&](const char* name, const gsl_odeiv2_step_type* type) {
      all.push_back({name, kind, [&problem, equations, type](double tolerance) {
                       return solve(problem, equations, type, tolerance);
                     }});
    };
    add("gsl_rk8pd", gsl_odeiv2_step_rk8pd);
    add("gsl_rkf45", gsl_odeiv2_step_rkf45);
    add("gsl_msadams", gsl_odeiv2_step_msadams);
  });
  return all;
}

}  // namespace qdot::bench
