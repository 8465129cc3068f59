#include "core/motion/section_run.hpp"

#include <algorithm>
#include <cmath>

#include "core/dynamics/watch.hpp"
#include "core/integrate/integrate.hpp"

namespace qdot {
namespace {

void shorten(RunRequest& run, double step) {
  run.method = Method::erk;
  run.t_end = std::min(run.t_end, run.t_start + step);
  const auto rows = std::ranges::upper_bound(run.grid, run.t_end) - run.grid.begin();
  run.grid = run.grid.first(static_cast<std::size_t>(rows));
}

}  // namespace

SectionRun::SectionRun(const Dynamics& dynamics, const SimulationRequest& request,
                       const MotionSections& sections, const ApartAlong& apart, const EventSides& sides)
    : request_(request), sections_(sections), apart_(apart), sides_(sides), from_rest_(dynamics, request) {}

Run SectionRun::from(const Simulation& so_far) const {
  RunRequest run = request_from(so_far);
  const std::optional<double> step = from_rest_.length(run.t_start, run.y_start, sections_.system());
  if (step) shorten(run, *step);
  Run done = integrate(sections_.system(), run);
  if (step) enclose(run, done);
  return done;
}

bool SectionRun::leaves_rest(const Run& done) const {
  if (done.ending == Ending::event || done.ending == Ending::given_up) return false;
  if (done.ending == Ending::reached_end) return done.t < request_.t_end;
  return done.steps > 0 && from_rest_.length(done.t, done.y, sections_.system()).has_value();
}

RunRequest SectionRun::request_from(const Simulation& so_far) const {
  RunRequest run;
  run.t_start = so_far.t;
  run.y_start = so_far.y;
  run.t_end = request_.t_end;
  run.grid = std::span(request_.grid).subspan(so_far.rows);
  if (request_.goes_on) {
    run.goes_on = [this, before = so_far.rows](std::size_t first, std::span<const double> rows) {
      return request_.goes_on(before + first, rows);
    };
  }
  run.method = request_.method;
  run.taylor_order = request_.taylor_order;
  run.is_reference = request_.is_reference;
  run.notes_approaches = request_.notes_approaches;
  apart_.ask(run, sections_.originals());
  run.tolerances = request_.tolerances;
  run.h = request_.h;
  run.limits = request_.limits;
  run.limits.max_steps -= std::min(run.limits.max_steps, so_far.steps);
  run.limits.max_evaluations -= std::min(run.limits.max_evaluations, so_far.evaluations);
  run.events = events_from(so_far);
  return run;
}

/// What is watched, and then the kinks.
std::vector<EventFunction> SectionRun::events_from(const Simulation& so_far) const {
  std::vector<EventFunction> events;
  for (const Watch& watch : sections_.watches()) {
    events.push_back(watch.event());
    if (so_far.t > request_.t_start) continue;  // the state is off by more than that
    events.back().rounding_at_start = [&] { return watch.rounding(request_.t_start, request_.y_start); };
  }
  const bool begins_by_impact = !so_far.sections.empty() && so_far.sections.back().t == so_far.t;
  sides_.mark(so_far.t, so_far.y, begins_by_impact ? &so_far.sections.back() : nullptr, events);
  for (EventFunction& end : sections_.ends()) {
    end.ends_where_hidden = end.ends_where_hidden && so_far.hidden_kinks < most_hidden;
    events.push_back(std::move(end));
  }
  return events;
}

/// A step away from rest is not Taylor's; what it may be off by is known otherwise.
void SectionRun::enclose(const RunRequest& run, Run& done) const {
  const auto off = from_rest_.bound(run.t_start, run.y_start, done.t - run.t_start);
  done.bounded = off.has_value();
  if (!off) return;
  done.unseen_at_end = *off;
  done.unseen.resize(done.states.size());
  for (std::size_t i = 0; i < done.unseen.size(); ++i) done.unseen[i] = (*off)[i % off->size()];
}

void append(Run& done, Simulation& to) {
  to.bounded = to.bounded && done.bounded;
  to.accelerations.insert(to.accelerations.end(), done.accelerations.begin(), done.accelerations.end());
  to.rows += done.rows;
  if (to.states.empty()) {
    to.states = std::move(done.states);
  } else {
    to.states.insert(to.states.end(), done.states.begin(), done.states.end());
  }
  to.steps += done.steps;
  to.evaluations += done.evaluations;
  to.ending = done.ending;
  to.t = done.t;
  to.y = done.y;
}

}  // namespace qdot
