#include "api/answers/lost_inertia.hpp"

#include "api/json/text.hpp"
#include "core/dynamics/lost_inertia.hpp"
#include "core/expr/print/print.hpp"
#include "core/mechanics/notation.hpp"
#include "core/mechanics/partial_quantities.hpp"

namespace qdot::api {
namespace {

[[noreturn]] void refuse(const Scene& scene, const LostInertia& lost) {
  std::vector<std::string> zeros, still;
  for (const std::size_t i : lost.zeros) zeros.push_back(scene.parameters[i].name + " = 0");
  for (const std::size_t i : lost.fault->coordinates) still.push_back("'" + scene.coordinates[i].name + "'");
  const std::string what =
      still.empty()
          ? "some motion of the coordinates moves no mass, wherever they are: the mass matrix has no "
            "inverse, so the accelerations are undetermined."
          : "nothing that has mass moves with " + enumerated(still, "and") +
                ", so no acceleration of it follows from the equations.";
  throw Error(ErrorCode::invalid_parameters, "With " + enumerated(zeros, "and") + " " + what);
}

}  // namespace

void refuse_parts_without_value(const ResolvedSystem& system, std::optional<std::size_t> varied) {
  const Model& model = system.model();
  const auto missing =
      part_without_value(model.partial, model.parsed.symbols, system.state.parameters, varied);
  if (!missing) return;
  throw Error(ErrorCode::invalid_parameters,
              "With these parameters there is no finite value of " + missing->name + " in any state: " +
                  print(missing->part, Form::text, notation_of(model.scene)) + " has none.");
}

void note_limits(const Scene& scene, const std::vector<std::size_t>& limits, Limit limit, Call& call) {
  const std::string what =
      limit == Limit::moves
          ? " vanishes. Its limit stands for it, in matrices, too: the equation divided by the factor that vanishes."
          : " vanishes. Its limit, the equation divided by the factor that vanishes, tells where forces vanish, "
            "but no acceleration follows from it.";
  for (const std::size_t i : limits)
    call.notes.push_back("With these parameters the equation of " + scene.coordinates[i].name + what);
}

void note_lost_inertia(const ResolvedSystem& system, Call& call, std::optional<std::size_t> varied) {
  refuse_parts_without_value(system, varied);
  const LostInertia lost = lost_inertia(system.model(), system.state.parameters, varied);
  if (lost.fault) refuse(system.scene(), lost);
  note_limits(system.scene(), lost.limits, Limit::moves, call);
}

}  // namespace qdot::api
