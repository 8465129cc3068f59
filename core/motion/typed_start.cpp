#include "core/motion/typed_start.hpp"

#include <cmath>
#include <vector>

namespace qdot {

Reals start_as_typed(const Dynamics& dynamics, const SimulationRequest& request) {
  Reals start = request.y_start;
  const double left_out = request.t_start_left_out;
  const std::size_t n = start.size() / 2;
  std::vector<double> acceleration(n);
  const CompiledFunction& function = dynamics.accelerations();
  Workspace workspace = function.bind(request.parameters);
  if (left_out == 0 ||
      function.evaluate(request.t_start, request.y_start, workspace, acceleration) != Evaluation::ok)
    return start;
  const auto move = [&](std::size_t i, double rate) {
    const Real& typed = request.y_start.exact(i);
    const DoubleDouble moved = typed.double_double() - DoubleDouble(left_out * rate);
    start.set(i, {moved.high, moved.low, typed.error});
  };
  for (std::size_t i = 0; i < n; ++i) {
    move(i, request.y_start[n + i]);
    move(n + i, acceleration[i]);
  }
  return start;
}

SidedMotions::Typed typed_start(const SimulationRequest& request) {
  if (request.originals)
    return {request.originals->asked.parameters, request.t_start, request.originals->asked.y_start};
  const double left_out = request.t_start_left_out;
  const Real t(request.t_start, left_out, 0x1p-52 * std::abs(left_out));
  return {request.parameters, t, request.y_start};
}

}  // namespace qdot
