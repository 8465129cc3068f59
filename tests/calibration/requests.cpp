#include "tests/calibration/requests.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/integrate/methods.hpp"
#include "tests/calibration/random_motion.hpp"
#include "tests/support/motions.hpp"

namespace qdot::test {
namespace {

/// Up to 100 periods of one of the rates, and of none more than 100.
double span_of(Draw& draw, const std::vector<double>& rates) {
  double fastest = 0;
  std::vector<double> moving;
  for (const double rate : rates) {
    if (rate > 0) moving.push_back(rate);
    fastest = std::max(fastest, rate);
  }
  if (moving.empty()) return draw.decades(-1, 2);
  const auto which = static_cast<std::size_t>(draw.uniform(0, static_cast<double>(moving.size())));
  return std::min(2 * pi / moving[which] * draw.decades(-1.3, 2), 2 * pi / fastest * 100);
}

void choose_times(Draw& draw, double span, SimulationRequest& request) {
  const double kind = draw.uniform(0, 1);
  request.t_start = kind < 0.7   ? 0
                    : kind < 0.8 ? -span * draw.uniform(0, 2)
                                 : draw.sign() * span * draw.decades(0, 3);
  request.t_end = request.t_start + span;
  const int rows = static_cast<int>(draw.chance(0.2) ? draw.uniform(2, 6) : draw.decades(0.5, 2.6));
  request.grid = {request.t_start};
  const bool even = draw.chance(0.8);
  for (int i = 1; i < rows; ++i) {
    request.grid.push_back(even ? request.t_start + span * i / rows
                                : request.t_start + span * draw.uniform(0, 1));
  }
  request.grid.push_back(request.t_end);
  std::sort(request.grid.begin(), request.grid.end());
  request.grid.erase(std::unique(request.grid.begin(), request.grid.end()), request.grid.end());
}

void choose_goal(Draw& draw, double fastest, Asked& asked) {
  asked.request.method =
      draw.chance(0.4) ? Method::taylor : draw.one_of({Method::adams, Method::bdf, Method::erk});
  const double kind = draw.uniform(0, 1);
  if (kind < 0.35) {
    const double rtol = draw.decades(-14, -2);
    const double atol = draw.chance(0.4) ? 1e-12 : draw.chance(0.5) ? rtol * 1e-3 : draw.decades(-14, -2);
    asked.request.tolerances = draw.chance(0.3) ? Tolerances{1e-9, 1e-12} : Tolerances{rtol, atol};
    if (draw.chance(0.15)) {
      const double span = asked.request.t_end - asked.request.t_start;
      const double time = fastest > 0 ? 2 * pi / fastest : span;
      asked.request.method = Method::gauss;
      asked.request.h = std::min(span / 2, time * draw.decades(-2.5, -0.8));
    }
  } else if (kind < 0.6) {
    asked.goal = {AccuracyGoal::Kind::relative, draw.one_of({1e-3, 1e-6, 1e-9}), 0};
  } else if (kind < 0.85) {
    asked.goal = {AccuracyGoal::Kind::absolute, draw.decades(-13, -3), 0};
  } else {
    asked.goal = {AccuracyGoal::Kind::work, 0, static_cast<std::uint64_t>(draw.decades(3, 6))};
  }
}

}  // namespace

std::vector<std::string> Asked::inputs() const {
  if (model_of(system)->scene.inputs.empty()) return {};
  return {force.text()};
}

QuadProblem Asked::problem() const {
  const auto model = model_of(system);
  QuadProblem problem{system, {}, request.y_start, request.t_start, request.grid, force, false};
  for (std::size_t i = 0; i < request.parameters.size(); ++i) {
    problem.parameters.emplace_back(model->scene.parameters[i].name, request.parameters[i]);
  }
  problem.impacts = model->scene.impact && request.impacts == Impacts::apply;
  return problem;
}

std::string Asked::words() const {
  std::ostringstream out;
  out.precision(17);
  out << system;
  const auto model = model_of(system);
  for (const auto& [name, value] : problem().parameters) out << ' ' << name << '=' << value;
  const std::size_t n = model->degrees_of_freedom();
  for (std::size_t i = 0; i < 2 * n; ++i) {
    out << ' ' << model->scene.coordinates[i % n].name << (i < n ? "=" : "_dot=") << request.y_start[i];
  }
  if (force.amplitude != 0) out << " F=" << force.text();
  out << " t_start=" << request.t_start << " t_end=" << request.t_end << " rows=" << request.grid.size()
      << " method=" << record_of(request.method).name;
  switch (goal.kind) {
    case AccuracyGoal::Kind::tolerances:
      if (record_of(request.method).has_fixed_step()) {
        out << " h=" << request.h;
        break;
      }
      out << " rtol=" << request.tolerances.rtol << " atol=" << request.tolerances.atol;
      break;
    case AccuracyGoal::Kind::absolute:
      out << " max_error=" << goal.value;
      break;
    case AccuracyGoal::Kind::relative:
      out << " preset=" << goal.value;
      break;
    case AccuracyGoal::Kind::work:
      out << " max_evaluations=" << goal.evaluations;
      break;
  }
  if (request.on_invalid == OnInvalid::go_on) out << " on_invalid=continue";
  if (request.impacts == Impacts::ignore) out << " impacts=false";
  return out.str();
}

Asked asked_for(const std::string& system, const Values& given, double t_end, int samples) {
  Asked asked;
  asked.system = system;
  asked.request = request_for(*model_of(system), given, instants(t_end, samples - 1));
  asked.request.method = Method::taylor;
  asked.request.tolerances = {1e-9, 1e-12};
  return asked;
}

Asked random_request(std::uint64_t seed, std::uint64_t number) {
  Draw draw(seed * 1'000'003 + number);
  draw.choose_wildness();
  const auto& [system, make] = motion_makers()[number % motion_makers().size()];
  const Motion motion = make(draw);
  Asked asked = asked_for(system, motion.given, 1, 2);
  asked.force = motion.force;
  choose_times(draw, span_of(draw, motion.rates), asked.request);
  choose_goal(draw, *std::ranges::max_element(motion.rates), asked);
  if (draw.chance(0.6)) asked.request.on_invalid = OnInvalid::go_on;
  if (draw.chance(0.3)) asked.request.impacts = Impacts::ignore;
  return asked;
}

}  // namespace qdot::test
