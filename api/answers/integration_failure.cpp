#include "api/answers/integration_failure.hpp"

#include "api/answers/motion_fields.hpp"

namespace qdot::api {
namespace {

/// The explanation of a run that failed.
struct Failure {
  const char* reason;
  std::string detail;
};

constexpr const char* no_forces =
    "The motion came to where the constraints depend on each other, or determine no forces: the accelerations "
    "are undetermined there.";

Failure failure_of(Ending ending) {
  switch (ending) {
    case Ending::step_limit:
      return {"step-limit",
              "The motion needs more steps than a request may take; ask for a shorter one, for less "
              "accuracy, or with method " +
                  methods_of_fixed_step() + " for a longer h."};
    case Ending::nonfinite:
      return {
          "nonfinite",
          "The equations of motion, their derivatives, or a condition that has to hold became infinite or undefined."};
    case Ending::singular_mass:
      return {"singular-mass", "The mass matrix lost its inverse, so the accelerations are undetermined."};
    case Ending::tolerance:
      return {"tolerance", "The tolerances, or the step h of method " + methods_of_fixed_step() +
                               ", ask for more than double precision holds; choose larger ones."};
    case Ending::blow_up:
      return {"blow-up", "The motion grew beyond all bounds, or met a singularity that no step can pass."};
    case Ending::undetermined:
      return {"undetermined",
              "At this state the argument of an abs or a sign is zero, and the equations of motion do not "
              "tell how the motion goes on: to no side, to more than one of them, or held by several dry "
              "frictions that may share the load in more than one way."};
    case Ending::no_convergence:
      return {"no-convergence",
              "Method " + methods_of_fixed_step() +
                  " found no solution for the equations of its next step: the step h is too long at "
                  "this place, or the motion has a singularity there. A shorter h may do, or method taylor."};
    case Ending::reached_end:
    case Ending::event:
    case Ending::given_up:
      break;
  }
  return {};
}

}  // namespace

bool has_failed(Ending ending) { return ending != Ending::reached_end && ending != Ending::event; }

Response integration_failure(Call& call, const Scene& scene, Ending ending, double t,
                             std::span<const double> y, const std::string& detail) {
  Failure why = failure_of(ending);
  if (ending == Ending::singular_mass && !scene.constraints.empty()) why.detail = no_forces;
  Json members{{"reason", why.reason}, {"t_reached", t}, {"last_state", state_json(scene, y)}};
  return to_response({.kind = ProblemKind::integration_failed,
                      .detail = detail.empty() ? why.detail : detail,
                      .errors = {},
                      .members = std::move(members)},
                     call.target.path, call.layout);
}

}  // namespace qdot::api
