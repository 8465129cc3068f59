#include "api/answers/equilibria/solution.hpp"

#include <algorithm>

#include "api/answers/exact_json.hpp"
#include "api/answers/stated.hpp"
#include "api/answers/steady_json.hpp"
#include "api/json/text.hpp"
#include "core/closed/exact_solution.hpp"
#include "core/dynamics/consistent_state.hpp"
#include "core/steady/position_statics.hpp"
#include "core/steady/solve_for.hpp"

namespace qdot::api {
namespace {

class SolutionAnswer {
 public:
  SolutionAnswer(const Dynamics& dynamics, const ResolvedState& state, const EquilibriaRequest& request,
                 int digits)
      : dynamics_(dynamics),
        scene_(dynamics.model().scene),
        state_(state),
        unknown_(*request.solve_for),
        written_(written_texts(request.system)),
        digits_(digits) {}

  Json body() {
    const Solution solution = solve_for(dynamics_, state_.parameters, state_.y, unknown_);
    exact_ = exact_solutions(dynamics_, state_.parameters, state_.y, unknown_, written_, solution);
    Json body = Json::object();
    if (solution.values.empty()) {
      body[unknown_] = nullptr;
      body["error"] = nullptr;
      body["reason"] = solution.reason;
    } else {
      const SolvedValue& first = solution.values.front();
      body[unknown_] = first.value;
      body["error"] = stated_error({first.value, first.error}, digits_);
      put_exact(body, exact_[0]);
      put_stability(body, first.stability, digits_);
    }
    put_all(body, solution);
    put_notes(body, solution);
    if (solution.ranges) put_ranges(body, *solution.ranges);
    body["units"] = units();
    return body;
  }

 private:
  static void put_exact(Json& json, const ExactSolution& exact) {
    if (exact.value) json["exact"] = exact_json(*exact.value);
    if (exact.rate2) json["exact_rate2"] = exact_json(*exact.rate2);
  }

  void put_all(Json& body, const Solution& solution) const {
    body["all"] = Json::array();
    for (std::size_t i = 0; i < solution.values.size(); ++i) {
      const SolvedValue& solved = solution.values[i];
      Json json{{unknown_, solved.value}, {"error", stated_error({solved.value, solved.error}, digits_)}};
      put_exact(json, exact_[i]);
      put_stability(json, solved.stability, digits_);
      body["all"].push_back(std::move(json));
    }
  }

  void put_notes(Json& body, const Solution& solution) const {
    for (const SolvedValue& solved : solution.values) {
      if (solved.is_one) continue;
      body["notes"].push_back(
          "Within the error of " + unknown_ + " = " + short_number(solved.value, 6) +
          " there may be several values, one or none: rounding does not tell them apart.");
    }
  }

  void put_ranges(Json& body, const std::vector<SolvableRange>& ranges) const {
    body["ranges"] = Json::array();
    for (const SolvableRange& range : ranges) {
      body["ranges"].push_back({{"from", range.from},
                                {"to", range.to},
                                {"from_included", range.from_included},
                                {"to_included", range.to_included},
                                {"from_error", stated_error({range.from, range.from_error}, digits_)},
                                {"to_error", stated_error({range.to, range.to_error}, digits_)}});
    }
    body["ranges_reason"] =
        "Positions for which a value of " + unknown_ +
        " in its domain exists; an end that is not included is where it grows without bound, or leaves the "
        "domain.";
  }

  [[nodiscard]] Json units() const {
    Json units = steady_units(scene_);
    for (const Symbol& p : symbols(scene_, SymbolRole::parameter)) units[p.name] = p.unit;
    units["error"] = units[unknown_];
    if (scene_.coordinates.size() == 1) {
      for (const char* name : {"from", "to", "from_error", "to_error"})
        units[name] = scene_.coordinates[0].unit;
    }
    return units;
  }

  const Dynamics& dynamics_;
  const Scene& scene_;
  const ResolvedState& state_;
  std::string unknown_;
  WrittenTexts written_;
  int digits_;
  std::vector<ExactSolution> exact_;
};

/// The position as the constraints want it; an error where they do not hold at what is given.
std::optional<FieldError> put_on_surface(const Dynamics& dynamics, const std::string& unknown,
                                         const std::vector<bool>& given, const Place& root,
                                         ResolvedState& state) {
  try {
    state.y = position_on_surface(dynamics, state.parameters, state.y, given, unknown);
    return std::nullopt;
  } catch (const InconsistentState& error) {
    std::string near;
    for (std::size_t i = 0; i < given.size() && !error.nearest().empty(); ++i) {
      const auto& [name, value] = error.nearest()[i];
      near += (i == 0 ? " Near it does " : ", ") + name + " = " + short_number(value, 15);
    }
    return root.below("at").error("inconsistent_state", "This position does not obey the constraints." +
                                                            near + (near.empty() ? "" : "."));
  }
}

}  // namespace

std::vector<FieldError> take_position(const Dynamics& dynamics, const EquilibriaRequest& request,
                                      const Place& root, ResolvedState& state, Json& echo) {
  const Scene& scene = dynamics.model().scene;
  const std::vector<std::string> names = solvable_names(dynamics, state.parameters);
  if (std::ranges::find(names, *request.solve_for) == names.end()) {
    FieldError error =
        root.below("solve_for")
            .error(
                "not_applicable",
                *request.solve_for +
                    " is zero in every equilibrium: its coordinate is not ignorable, or has a momentum that "
                    "is not linear in the velocities.");
    error.allowed = names;
    return {error};
  }
  std::vector<FieldError> errors;
  const std::vector<std::size_t> needed = needed_coordinates(dynamics, state.parameters, *request.solve_for);
  std::vector<bool> given(scene.coordinates.size());
  for (std::size_t i = 0; i < scene.coordinates.size(); ++i) {
    const std::string& name = scene.coordinates[i].name;
    const auto given_in = [&](const auto& values) {
      return std::ranges::find(values, name, &std::pair<std::string, Real>::first);
    };
    const auto at = given_in(request.system.position);
    if (at != request.system.position.end()) state.y.set(i, at->second);
    given[i] = at != request.system.position.end() ||
               given_in(request.system.initial) != request.system.initial.end();
    if (!given[i] && std::ranges::find(needed, i) != needed.end())
      errors.push_back(
          root.below("at").below(name).error("missing", "'at' needs " + name + ", on which forces depend."));
  }
  // What constraints determine may be left out.
  if (errors.size() > dependent_coordinates(dynamics, *request.solve_for)) return errors;
  const bool complete = errors.empty();
  std::vector<bool> stays = given;
  for (std::size_t i = 0; i < stays.size(); ++i)
    stays[i] = given[i] || std::ranges::find(needed, i) == needed.end();
  if (auto error = put_on_surface(dynamics, *request.solve_for, stays, root, state)) return {*error};
  Json position = Json::object();
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] || (!complete && !stays[i])) position[scene.coordinates[i].name] = state.y[i];
  }
  echo["at"] = std::move(position);
  return {};
}

Json solution_body(const Dynamics& dynamics, const ResolvedState& state, const EquilibriaRequest& request,
                   int digits) {
  return SolutionAnswer(dynamics, state, request, digits).body();
}

}  // namespace qdot::api
