#include "core/motion/conditions_at_stop.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/integrate/events.hpp"

namespace qdot {
namespace {

/// All states within that time of the stop.
std::vector<Interval> states_around(const ComputedMotion& motion, const EventError& error, double time) {
  const std::vector<double>& y = motion.simulation.y;
  const std::size_t n = y.size() / 2;
  const CompiledFunction& accelerations = motion.dynamics.accelerations();
  std::vector<double> rates(y.begin() + static_cast<std::ptrdiff_t>(n), y.end());
  rates.resize(2 * n);
  Workspace workspace = accelerations.bind(motion.request.parameters);
  const bool is_known =
      accelerations.evaluate(motion.simulation.t, y, workspace, std::span(rates).last(n)) == Evaluation::ok;
  std::vector<Interval> box;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double rate = k < n || is_known ? std::abs(rates[k]) : infinity;
    const double away = (error.state.empty() ? 0 : error.state[k]) + rate * time;
    box.emplace_back(y[k] - away, y[k] + away);
  }
  return box;
}

}  // namespace

OtherConditions other_conditions_at_stop(const ComputedMotion& motion, const EventError& error) {
  const Stop& stop = *motion.simulation.stop;
  const std::vector<Watch> all = watches(motion.dynamics, {.parameters = motion.request.parameters,
                                                           .on_invalid = motion.request.on_invalid,
                                                           .impacts = Impacts::ignore});
  const bool is_condition = std::ranges::any_of(all, [&](const Watch& w) { return w.reason == stop.reason; });
  OtherConditions found{std::max(error.time, one_instant * time_round_off(stop.t)), ""};
  if (!is_condition || all.size() < 2) return found;
  const std::vector<Interval> states = states_around(motion, error, found.time);
  for (const Watch& watch : all) {
    if (watch.reason.empty() || watch.reason == stop.reason) continue;
    const Interval values = watch.enclosure(Interval(stop.t - found.time, stop.t + found.time), states);
    const std::string name = "'" + watch.name + "'";
    if (!values.contains(0.0) || found.names.find(name) != std::string::npos) continue;
    found.names += (found.names.empty() ? "" : ", ") + name;
  }
  return found;
}

}  // namespace qdot
