#include "core/steady/bifurcations.hpp"

#include <algorithm>

#include "api/answers/bifurcations/request.hpp"
#include "api/answers/exact_json.hpp"
#include "api/answers/gait/request.hpp"
#include "api/answers/lost_inertia.hpp"
#include "api/answers/stated.hpp"
#include "api/answers/steady_json.hpp"
#include "core/closed/critical_values.hpp"
#include "core/closed/exact_degenerate.hpp"
#include "core/closed/exact_ends.hpp"
#include "core/gait/gait_continuation.hpp"
#include "core/mechanics/followers.hpp"

namespace qdot::api {
namespace {

constexpr const char* method_of_bifurcations =
    "Critical points are the zeros of square systems in the coordinates and the parameter, all of them found "
    "by interval arithmetic; errors are proven bounds. A kind is proven by the signs of enclosed derivatives, "
    "else it is 'unresolved'.";
constexpr const char* cluster =
    "Not proven to be one point: round-off hides what happens within the error, and a kind other than "
    "'unresolved' follows from the numbers of equilibria beside it.";

const char* kind_name(CriticalGait::Kind kind) {
  switch (kind) {
    case CriticalGait::Kind::period_doubling:
      return "period_doubling";
    case CriticalGait::Kind::fold:
      return "fold";
    case CriticalGait::Kind::neimark_sacker:
      break;
  }
  return "neimark_sacker";
}

std::size_t number_of(const Scene& scene, const std::string& parameter) {
  const auto found = std::ranges::find(scene.parameters, parameter, &Parameter::name);
  return static_cast<std::size_t>(found - scene.parameters.begin());
}

class BifurcationsAnswer {
 public:
  BifurcationsAnswer(const Dynamics& dynamics, const ResolvedState& state, const BifurcationsRequest& request)
      : dynamics_(dynamics),
        scene_(dynamics.model().scene),
        state_(state),
        request_(request),
        digits_(request.digits.value_or(shortest_digits)),
        index_(number_of(scene_, request.parameter)) {}

  Json body() {
    units_ = steady_units(scene_);
    for (const char* name : {"value", "error"}) units_[name] = scene_.parameters[index_].unit;
    units_[request_.parameter] = scene_.parameters[index_].unit;
    Json body = dynamics_.model().parsed.impacts.size() == 1 ? of_gaits() : of_equilibria();
    body["units"] = std::move(units_);
    return body;
  }

 private:
  Json of_equilibria() {
    const Bifurcations found =
        bifurcations(dynamics_, state_.parameters, state_.y, index_, request_.from, request_.to);
    Json body{{"of", "equilibria"}, {"critical", Json::array()}, {"complete", found.complete}};
    const auto exact = exact_critical_values(dynamics_, state_.parameters, state_.y, index_,
                                             written_texts(request_.system), found);
    for (std::size_t i = 0; i < found.critical.size(); ++i) {
      body["critical"].push_back(critical(found.critical[i]));
      if (exact[i]) body["critical"].back()["exact"] = exact_json(*exact[i]);
    }
    if (!found.reason.empty()) body["reason"] = found.reason;
    if (!found.degenerate.empty()) {
      body["degenerate"] = found.degenerate;
      put_forms(body, "degenerate_exact",
                exact_degenerate_values(dynamics_, state_.parameters, state_.y, index_,
                                        written_texts(request_.system), found));
      body["degenerate_reason"] =
          "At these values a force, or what the others leave of it, vanishes in every position, so equilibria are "
          "not isolated points.";
    }
    if (!found.at_ends.empty()) {
      body["at_ends"] = found.at_ends;
      put_forms(body, "at_ends_exact",
                exact_end_values(dynamics_, state_.parameters, state_.y, index_,
                                 written_texts(request_.system), found));
    }
    body["branches"] = Json::array();
    for (std::size_t i = 0; i < found.branches.size(); ++i)
      body["branches"].push_back(branch(i, found.branches[i]));
    body["method"] = method_of_bifurcations;
    return body;
  }

  static void put_forms(Json& body, const char* name, const std::vector<std::optional<ClosedForm>>& forms) {
    if (!std::ranges::all_of(forms, [](const auto& form) { return form.has_value(); })) return;
    Json& exact = body[name] = Json::array();
    for (const auto& form : forms) exact.push_back(exact_json(*form));
  }

  [[nodiscard]] Json critical(const CriticalValue& c) {
    Json json{{"value", c.value},
              {"kind", name(c.kind)},
              {"state", state_json(scene_, c.y)},
              {"error", stated_error({c.value, c.error}, digits_)},
              {"state_error", state_json(scene_, c.errors)}};
    std::size_t i = 0;
    for (auto& [name, error] : json["state_error"].items()) {
      error = stated_error(Stated{c.y[i], c.errors[i]}.as_typed(state_.y.exact(i)), digits_);
      ++i;
    }
    if (c.omega > 0) {
      json["omega"] = c.omega;
      json["omega_error"] = stated_error({c.omega, c.omega_error}, digits_);
      units_["omega"] = units_["omega_error"] = "rad/s";
    }
    if (!c.reason.empty()) json["reason"] = c.reason;
    if (!c.proven) json["note"] = cluster;
    return json;
  }

  [[nodiscard]] Json branch(std::size_t id, const EquilibriumBranch& branch) const {
    Json json{{"id", id}, {request_.parameter, branch.parameter}};
    for (std::size_t i = 0; i < scene_.coordinates.size(); ++i) {
      Json& column = json[scene_.coordinates[i].name] = Json::array();
      for (const std::vector<double>& x : branch.x) column.push_back(x[i]);
    }
    json["stability"] = Json::array();
    for (const Stability stability : branch.stability) json["stability"].push_back(name(stability));
    return json;
  }

  Json of_gaits() {
    const GaitBifurcations found =
        critical_gaits(dynamics_, state_.parameters, index_, request_.from, request_.to);
    Json body{{"of", "gaits"}, {"critical", Json::array()}};
    for (const CriticalGait& c : found.critical) {
      body["critical"].push_back({{"value", c.value},
                                  {"kind", kind_name(c.kind)},
                                  {"state", state_json(scene_, c.state)},
                                  {"error", stated_error({c.value, c.error}, digits_)},
                                  {"step_time", c.step_time},
                                  {"multipliers", multipliers(c.multipliers)}});
    }
    if (!found.reason.empty()) {
      body["reason"] = found.reason;
    } else if (found.critical.empty()) {
      body["reason"] = "No gait that was followed changes its stability or meets another in this range.";
    }
    body["branches"] = Json::array();
    for (std::size_t i = 0; i < found.branches.size(); ++i)
      body["branches"].push_back(branch(i, found.branches[i]));
    units_["step_time"] = "s";
    units_["re"] = units_["im"] = "1";
    return body;
  }

  static Json multipliers(const std::vector<std::complex<double>>& values) {
    Json json = Json::array();
    for (const auto& m : values) json.push_back({{"re", m.real()}, {"im", m.imag()}});
    return json;
  }

  [[nodiscard]] Json branch(std::size_t id, const GaitBranch& branch) const {
    Json json{{"id", id}, {"kind", name(branch.kind)}, {request_.parameter, Json::array()}};
    const std::vector<Symbol> names = symbols(scene_, SymbolRole::initial);
    for (const GaitPoint& point : branch.points) {
      json[request_.parameter].push_back(point.parameter);
      for (std::size_t i = 0; i < names.size(); ++i) json[names[i].name].push_back(point.state[i]);
      json["step_time"].push_back(point.step_time);
      json["stability"].push_back(point.stable ? "stable" : "unstable");
    }
    return json;
  }

  const Dynamics& dynamics_;
  const Scene& scene_;
  const ResolvedState& state_;
  const BifurcationsRequest& request_;
  int digits_;
  std::size_t index_;
  Json units_;
};

/// "While m moves, M = 2*m and k = 2*m*g/l follow it."; empty where none does.
std::string note_on_followers(const Model& model, const SystemChoice& choice, const std::string& parameter) {
  std::vector<std::string> names;
  for (const Parameter& p : model.scene.parameters) names.push_back(p.name);
  const DefaultValues defaults{*model.parsed.graph, names, model.parsed.parameter_defaults};
  std::string text;
  const WrittenTexts written = written_texts(choice);
  const Followers followers = followers_of(defaults, written, parameter);
  for (const Parameter& p : model.scene.parameters) {
    if (!followers.contains(p.name)) continue;
    const auto given = written.find(p.name);
    text += (text.empty() ? "" : ", ") + p.name + " = " +
            (given != written.end() ? given->second : p.default_value);
  }
  return text.empty() ? text
                      : "While " + parameter + " moves, " + text +
                            (followers.size() == 1 ? " follows it." : " follow it.");
}

Response answer_bifurcations(const Resolved<BifurcationsRequest>& resolved, Call& call, Models& models) {
  const auto& [request, echo] = resolved;
  const ResolvedSystem system = resolved_system(request.system, echo, models, 0.0, request.parameter);
  if (std::string note = note_on_followers(system.model(), request.system, request.parameter); !note.empty())
    call.notes.push_back(std::move(note));
  if (system.model().parsed.impacts.size() != 1)
    std::ranges::copy(notes_on_rates(*system.dynamics, request.system, system.state),
                      std::back_inserter(call.notes));
  note_lost_inertia(system, call, number_of(system.scene(), request.parameter));
  const Json body = BifurcationsAnswer(*system.dynamics, system.state, request).body();
  call.timing.lap("solve");
  return written_answer(call, system.scene(), system.echo, body, request.digits);
}

/// A parameter moves around its default: a speed of rotation where there is one.
std::optional<Json> example_of_bifurcations(const Scene& scene, const Json& parameters) {
  const Parameter* moving = nullptr;
  for (const Parameter& parameter : scene.parameters) {
    if (parameters.value(parameter.name, 0.0) == 0) continue;
    if (moving == nullptr || parameter.unit == "rad/s") moving = &parameter;
  }
  if (moving == nullptr) return std::nullopt;
  const double value = parameters[moving->name];
  return Json{{"parameter", moving->name}, {"from", value / 2}, {"to", 2 * value}};
}

}  // namespace

Endpoint bifurcations_endpoint() {
  return {.name = "bifurcations",
          .help = "Critical values of a parameter",
          .question = question(bifurcations_table(), answer_bifurcations),
          .cost = {.milliseconds = 100},
          .example = example_of_bifurcations,
          .other_names = {"bifurcation", "critical", "branches"}};
}

}  // namespace qdot::api
