#pragma once
// y' = f(y) as other libraries want it, with a count of the calls.

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/compile/compiled_function.hpp"
#include "tests/bench/work_precision/equations.hpp"

namespace qdot::bench {

/// The tape's accelerations for a state of D numbers.
template <std::size_t D>
class TapeEquations {
 public:
  static constexpr std::size_t dimension = D;
  explicit TapeEquations(const Problem& problem)
      : accelerations_(&problem.dynamics.accelerations()),
        workspace_(accelerations_->bind(problem.parameters)) {}

  void operator()(const std::array<double, D>& y, std::array<double, D>& f, double t) {
    std::copy_n(y.begin() + D / 2, D / 2, f.begin());
    (void)accelerations_->evaluate(t, y, workspace_, std::span(f).subspan(D / 2));
  }

 private:
  const CompiledFunction* accelerations_;
  Workspace workspace_;
};

/// Calls `use` with the name of a kind of equations and equations of this kind, for each kind there is.
template <class Use>
void for_all_equations(const Problem& problem, const Use& use) {
  switch (problem.y_start.size()) {
    case 2:
      use("tape", TapeEquations<2>(problem));
      break;
    case 4:
      use("tape", TapeEquations<4>(problem));
      break;
    default:
      use("tape", TapeEquations<6>(problem));
  }
  with_equations(problem, [&](const auto& equations) { use("hand", equations); });
}

template <class Equations, class State>
void evaluate(Equations& equations, const State& y, State& f, double t) {
  if constexpr (requires { equations(y, f, t); }) {
    equations(y, f, t);
  } else {
    equations(y, f);
  }
}

}  // namespace qdot::bench
