#pragma once
// What the answers of all computing endpoints share.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "api/answers/models.hpp"
#include "api/contract/system_choice.hpp"
#include "api/http/routes.hpp"
#include "api/json/json.hpp"
#include "api/json/writer.hpp"
#include "core/closed/written_texts.hpp"

namespace qdot::api {

/// The parameters and the initial state of a request, defaults filled in.
struct ResolvedState {
  Reals parameters;
  Reals y;
};

/// Throws Error(invalid_state) where a default has no finite value.
[[nodiscard]] ResolvedState resolved_state(const Model& model, const SystemChoice& choice);

/// What the request writes of parameters and initial state, as expressions in SI.
[[nodiscard]] WrittenTexts written_texts(const SystemChoice& choice);

/// The system of a request, with everything resolved that the request left open.
struct ResolvedSystem {
  std::shared_ptr<const Dynamics> dynamics;
  ResolvedState state;
  Json echo;  ///< of the request, with every parameter and the whole state

  [[nodiscard]] const Model& model() const { return dynamics->model(); }
  [[nodiscard]] const Scene& scene() const { return model().scene; }
};

/// Where events that are typed raise something to a power: with the values of parameters that are exponents.
void put_in_exponents(ResolvedSystem& system, const SystemChoice& choice,
                      std::span<const std::string> events);

/// With the state at time t, which obeys the constraints; without one it is where a search begins, and need
/// not. Parameters that are exponents are put in, except `varied`, of which the answer has many values.
/// Throws as resolved_state, consistent_state and Models::of do.
[[nodiscard]] ResolvedSystem resolved_system(const SystemChoice& choice, Json echo, Models& models,
                                             std::optional<double> t = 0.0, const std::string& varied = {});

/// {"q": ..., "q_dot": ...}: a state by name, in the scene's order.
[[nodiscard]] Json state_json(const Scene& scene, std::span<const double> y);

/// {"q": "rad", "q_dot": "rad/s"}: the units of a state by name.
[[nodiscard]] Json state_units(const Scene& scene);

/// The beginning of every answer: system, versions, the resolved request, and the notes on it if there are
/// any.
void write_head(JsonWriter& writer, const Scene& scene, const Json& echo,
                const std::vector<std::string>& notes = {});

/// A whole answer: the head, then the members of `body`, its floating-point numbers to so many digits (all
/// without it). Ends the part "encode" of the timing.
[[nodiscard]] Response written_answer(Call& call, const Scene& scene, const Json& echo, const Json& body,
                                      std::optional<int> digits = {});

/// Whether a part of the answer is read: a member of it by its name, or formulas, "exact", anywhere in it.
/// What is not need not be computed.
[[nodiscard]] bool wants(const Call& call, std::string_view part);

/// How the call's request came: errors of a body have pointers, those of a query parameters.
[[nodiscard]] Road road_of(const Call& call);

/// What core throws while `answer` runs, as a problem.
[[nodiscard]] Response guarded(Call& call, const std::function<Response()>& answer);

}  // namespace qdot::api
