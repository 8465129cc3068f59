#include "core/motion/running_motion.hpp"

#include <utility>

#include "core/base/error.hpp"
#include "core/integrate/events.hpp"
#include "core/motion/conditions_after_impact.hpp"

namespace qdot {

RunningMotion::RunningMotion(const Dynamics& all, const SimulationRequest& asked)
    : dynamics(all), request(asked), sections(all, asked), apart(asked), sides(all, asked, sections) {
  result.t = request.t_start;
  result.y = request.y_start;
  result.method = request.method;
  is_determined = sections.begin(result.t, result.y);
  doubt_kinks(sections.doubt_of_begin());
  result.begins_beside_kink = sections.begins_beside_kink();
  result.symplectic = sections.system().canonical.has_value();
}

void RunningMotion::doubt_kinks(std::span<const double> off) {
  apart.doubt(off);
  result.kinks_in_doubt = result.kinks_in_doubt || !off.empty();
}

void RunningMotion::note_unclear() {
  if (!result.unclear_from) result.unclear_from = result.t;
}

void RunningMotion::record_event(EventRecord event) {
  result.events.push_back(std::move(event));
  if (result.events.size() > most_occurrences)
    throw Error(ErrorCode::too_large, "the motion meets more events than one answer may hold");
}

void RunningMotion::stop_by(const Watch& watch) {
  result.stop = Stop{watch.reason, result.t, watch.message};
  meet_condition(watch.name, result.t, result.approaches);
}

SectionEnd RunningMotion::ending_by(decltype(EventFunction::value) g) const {
  return {.t = result.t,
          .before = result.y,
          .slopes_before = sections.slopes(result.t, result.y),
          .after = {},
          .slopes_after = {},
          .g = std::move(g)};
}

void RunningMotion::complete(SectionEnd& end) const {
  end.after = result.y;
  end.slopes_after = sections.slopes(result.t, result.y);
}

}  // namespace qdot
