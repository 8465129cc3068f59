#include <algorithm>
#include <numbers>

#include "api/answers/bounds.hpp"
#include "api/answers/exact_json.hpp"
#include "api/answers/integration_failure.hpp"
#include "api/answers/lost_inertia.hpp"
#include "api/answers/stated.hpp"
#include "api/answers/turning_points/request.hpp"
#include "api/answers/units_of.hpp"
#include "api/json/text.hpp"
#include "core/base/error.hpp"
#include "core/closed/exact_turning.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/notation.hpp"
#include "core/motion/trajectory_extrema.hpp"
#include "core/turning/turning_points.hpp"

namespace qdot::api {
namespace {

const char* name_of(MotionKind motion) {
  switch (motion) {
    case MotionKind::libration:
      return "libration";
    case MotionKind::rotation:
      return "rotation";
    case MotionKind::separatrix:
      return "separatrix";
    case MotionKind::equilibrium:
      return "equilibrium";
    case MotionKind::unbounded:
      break;
  }
  return "unbounded";
}

const char* name_of(InitialPlace place) {
  switch (place) {
    case InitialPlace::minimum:
      return "min";
    case InitialPlace::maximum:
      return "max";
    case InitialPlace::equilibrium:
      return "equilibrium";
    case InitialPlace::between:
      break;
  }
  return "between";
}

/// A request that needs one more field.
Response missing(Call& call, const std::string& field, const std::string& why) {
  const FieldError error = Place(road_of(call)).below(field).error("missing", why);
  return to_response(invalid_request({error}), call.target.path, call.layout);
}

/// What formulas call a constant beside the scene's own symbols, which keep their names.
std::string free_symbol(const Scene& scene, const std::string& usual, const std::string& longer) {
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::find(scene.parameters, name, &Parameter::name) != scene.parameters.end() ||
           std::ranges::find(scene.coordinates, name, &Coordinate::name) != scene.coordinates.end();
  };
  std::string name = is_taken(usual) ? longer : usual;
  for (int i = 2; is_taken(name); ++i) name = longer + "_" + std::to_string(i);
  return name;
}

/// U(x) = E with its symbols: {"text": ..., "latex": ...}.
Json equation_json(const Scene& scene, const Reduction& reduction, const std::string& energy) {
  Reduction own = reduction;
  Graph graph = *reduction.graph;
  const Expression routhian = graph.adopt(reduction.routhian);
  for (auto* symbols : {&own.x_dot, &own.x_ddot}) {
    for (Expression& symbol : *symbols) symbol = graph.adopt(symbol);
  }
  std::vector<Replacement> rest;
  for (const Expression& x_dot : own.x_dot) rest.emplace_back(x_dot, graph.number(0));
  const Expression potential = simplify(Number(-1) * substitute(routhian, rest));
  const Notation notation = notation_of(scene);
  const auto side = [&](Form form) {
    return print(potential, form, notation) + " = " + print(graph.symbol(energy), form, notation);
  };
  return {{"text", side(Form::text)}, {"latex", side(Form::latex)}};
}

class TurningPointsAnswer {
 public:
  TurningPointsAnswer(const Resolved<TurningPointsRequest>& resolved, Call& call, Models& models)
      : request_(resolved.request),
        call_(call),
        models_(models),
        system_(resolved_system(request_.system, resolved.echo, models, request_.t_start)) {}

  Response response() {
    note_lost_inertia(system_, call_);
    const std::vector<std::size_t> candidates = candidate_coordinates();
    if (request_.coordinate.empty() && candidates.size() != 1) {
      return missing(call_, "coordinate",
                     scene().name + " has several coordinates that turn, " + names_of(candidates) +
                         ": give the one that is meant.");
    }
    coordinate_ = request_.coordinate.empty() ? candidates[0] : index_of(request_.coordinate);
    system_.echo["coordinate"] = coordinate().name;
    std::string why_not = why_not_by_energy(dynamics(), system_.state.parameters, coordinate_);
    if (why_not.empty()) why_not = answer_by_energy();
    if (why_not.empty()) {
      note_unused_end();
    } else if (!request_.t_end) {
      return missing(call_, "t_end",
                     "Here " + why_not +
                         ", so the motion has to be followed: give 't_end', the time up to which its extrema "
                         "are wanted.");
    } else if (std::optional<Response> failure = answer_by_trajectory(why_not)) {
      return *failure;
    }
    call_.timing.lap("solve");
    return written();
  }

 private:
  [[nodiscard]] const Dynamics& dynamics() const { return *system_.dynamics; }
  [[nodiscard]] const Scene& scene() const { return system_.scene(); }
  [[nodiscard]] const Coordinate& coordinate() const { return scene().coordinates[coordinate_]; }

  [[nodiscard]] std::size_t index_of(const std::string& name) const {
    const auto& all = scene().coordinates;
    return static_cast<std::size_t>(std::ranges::find(all, name, &Coordinate::name) - all.begin());
  }

  /// Those that are not ignorable; all where the time enters the equations.
  [[nodiscard]] std::string names_of(const std::vector<std::size_t>& coordinates) const {
    std::vector<std::string> names;
    for (const std::size_t i : coordinates) names.push_back(scene().coordinates[i].name);
    return enumerated(names);
  }

  [[nodiscard]] std::vector<std::size_t> candidate_coordinates() const {
    try {
      return dynamics().statics(system_.state.parameters)->reduction.kept;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::not_applicable) throw;
    }
    std::vector<std::size_t> all(scene().coordinates.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
  }

  void put(const std::string& name, const std::optional<double>& value, const std::string& unit) {
    body_[name] = value ? Json(*value) : Json(nullptr);
    units_[name] = unit;
  }

  void put(const std::string& name, const std::optional<Stated>& number, const std::string& unit) {
    put(name, number ? std::optional(number->value) : std::nullopt, unit);
    if (number) put_error(name, *number);
  }

  void put_error(const std::string& name, const Stated& number) {
    errors_[name] = stated_error(number, request_.digits.value_or(shortest_digits));
  }

  void put_time(const std::string& name, double t, const std::optional<double>& error) {
    put(name, t, "s");
    if (error) put_error(name, {t, *error});
  }

  static std::optional<Stated> stated(const Finding& finding) {
    return finding.value ? std::optional(Stated{*finding.value, finding.error}) : std::nullopt;
  }

  static Stated in_degrees(const Stated& angle) {
    const Interval degrees = angle.enclosure() * Interval(180) / enclosed_pi();
    return Stated::within(angle.value * (180 / std::numbers::pi), degrees);
  }

  void put_extremum(const std::string& suffix, const Finding& extremum) {
    const std::string name = coordinate().name + suffix;
    const std::optional<Stated> number = stated(extremum);
    put(name, number, coordinate().unit);
    if (coordinate().unit == "rad")
      put(name + "_deg", number ? std::optional(in_degrees(*number)) : std::nullopt, "deg");
    if (!extremum.reason.empty()) reasons_[name] = extremum.reason;
  }

  void put_extrema(const Finding& maximum, const Finding& minimum, InitialPlace initial) {
    put_extremum("_max", maximum);
    put_extremum("_min", minimum);
    body_["initial_is"] = name_of(initial);
  }

  void put_motion(const std::optional<MotionKind>& motion, const std::string& reason) {
    body_["motion"] = motion ? Json(name_of(*motion)) : Json(nullptr);
    if (!motion) reasons_["motion"] = reason;
  }

  void note_unused_end() {
    if (!request_.t_end) return;
    body_["notes"].push_back(
        "'t_end' is not used: the energy integral tells the turning points of the whole motion, however long it "
        "takes to come to them.");
  }

  /// Or why it does not.
  std::string answer_by_energy() {
    const BesideExtrema beside{
        .period = wants(call_, "period") || wants(call_, "error") || wants(call_, "exact"),
        .along = wants(call_, "validity") || wants(call_, "notes"),
        .impacts = request_.impacts};
    const TurningPoints found = turning_points(dynamics(), system_.state.parameters, system_.state.y, beside);
    if (!found.impact.empty())
      return "the motion comes to the impact '" + found.impact +
             "', or may come to it, of which the energy integral knows nothing";
    body_["coordinate"] = coordinate().name;
    put_motion(found.motion, found.motion_reason);
    body_["method"] = "energy";
    put_extrema(found.maximum, found.minimum, found.initial);
    if (!found.stability.empty()) body_["stability"] = found.stability;
    if (beside.period) put("period", stated(found.period), "s");
    if (!found.period.reason.empty()) reasons_["period"] = found.period.reason;
    put_constants(found);
    if (wants(call_, "exact")) put_exact(found);
    put_validity(found);
    if (!found.notes.empty()) body_["notes"] = found.notes;
    return "";
  }

  void put_constants(const TurningPoints& found) {
    const Reduction& reduction = dynamics().statics(system_.state.parameters)->reduction;
    const auto conserved = dynamics().conserved(system_.state.parameters);
    const bool is_energy = std::ranges::any_of(
        conserved->quantities, [](const ConservedQuantity& quantity) { return quantity.name == "energy"; });
    const std::string energy =
        is_energy ? free_symbol(scene(), "E", "energy") : free_symbol(scene(), "h", "jacobi_integral");
    std::string key = "turning_points";
    for (const double p : system_.state.parameters) key += p == 0 ? '0' : '1';
    body_["equation"] = models_.remembered(*request_.system.scene, key,
                                           [&] { return equation_json(scene(), reduction, energy); });
    Json constants{{energy, *found.energy.value}};
    units_[energy] = "J";
    put_error(energy, *stated(found.energy));
    const std::size_t first = reduction.constants.size() - found.momenta.size();
    for (std::size_t k = 0; k < found.momenta.size(); ++k) {
      const std::string name = std::get<qdot::Symbol>(reduction.constants[first + k].node()).name;
      constants[name] = found.momenta[k];
      put_error(name, {found.momenta[k], found.momenta_errors[k]});
      units_[name] = momentum_unit(scene(), reduction.ignored[k]);
    }
    body_["constants"] = std::move(constants);
  }

  void put_exact(const TurningPoints& found) {
    const Json& constants = body_["constants"];  // the energy, then the momenta
    auto name = constants.items().begin();
    const ExactTurningPoints exact = exact_turning_points(dynamics(), system_.state.parameters,
                                                          written_texts(request_.system), found, name.key());
    Json json = Json::object();
    if (exact.equation) json["equation"] = exact_json(*exact.equation);
    if (exact.maximum) json[coordinate().name + "_max"] = exact_json(*exact.maximum);
    if (exact.minimum) json[coordinate().name + "_min"] = exact_json(*exact.minimum);
    if (exact.period) json["period"] = exact_json(*exact.period);
    if (exact.energy) json[name.key()] = exact_json(*exact.energy);
    for (const std::optional<ClosedForm>& momentum : exact.momenta) {
      ++name;
      if (momentum) json[name.key()] = exact_json(*momentum);
    }
    if (!json.empty()) body_["exact"] = std::move(json);
  }

  static Json exact_json(const ClosedForm& form) { return api::exact_json(form); }
  static Json exact_json(const ExactExtremum& extremum) {
    Json json = api::exact_json(extremum.value);
    if (extremum.cosine) json["cos"] = formula_json(*extremum.cosine);
    if (extremum.sine) json["sin"] = formula_json(*extremum.sine);
    return json;
  }

  /// Whether it holds is said where the least value and its error tell.
  Json validity_json(const ValidityCondition& condition, const ValidityMinimum& least) const {
    if (!least.value) return {{"min", nullptr}, {"holds", nullptr}, {"reason", least.reason}};
    Json json{{"min", *least.value},
              {"at", {{coordinate().name, least.x}, {coordinate().name + "_dot", least.x_dot}}}};
    const double error = least.error.value_or(0);
    if (least.error) {
      json["error"] = stated_error({*least.value, error}, request_.digits.value_or(shortest_digits));
    } else {
      json["reason"] = "The least of the values at some places of the motion: it may be less between them.";
    }
    if (*least.value + error < 0) {
      json["holds"] = false;
      json["message"] = condition.message;
    } else if (least.error && *least.value - error >= 0) {
      json["holds"] = true;
    } else {
      json["holds"] = nullptr;
      if (least.error) json["reason"] = "The least value is zero to within its error.";
    }
    return json;
  }

  void put_validity(const TurningPoints& found) {
    if (found.validity.empty()) return;
    Json validity = Json::object();
    for (const ValidityMinimum& least : found.validity) {
      const ValidityCondition& condition = scene().valid_while[least.condition];
      units_[key_beside(units_, "validity", condition.name)] = condition.unit;
      validity[condition.name] = validity_json(condition, least);
    }
    body_["validity"] = std::move(validity);
  }

  /// The response of a run that failed, if it did.
  std::optional<Response> answer_by_trajectory(const std::string& why) {
    ExtremaRequest core;
    core.parameters = system_.state.parameters;
    core.y_start = system_.state.y;
    core.coordinate = coordinate_;
    core.limits = limits_of_run();
    core.t_start = request_.t_start;
    core.t_start_left_out = request_.start.low;
    core.t_end = *request_.t_end;
    core.t_end_left_out = request_.end.low;
    core.on_invalid = request_.on_invalid;
    core.impacts = request_.impacts ? Impacts::apply : Impacts::ignore;
    const TrajectoryExtrema found = trajectory_extrema(dynamics(), core);
    if (has_failed(found.ending)) {
      return integration_failure(call_, scene(), found.ending, found.t, found.y);
    }
    body_["coordinate"] = coordinate().name;
    put_motion(std::nullopt, "Kinds of motion follow from the energy integral; here " + why + ".");
    body_["method"] = "trajectory";
    put_extrema(found.maximum, found.minimum, found.initial);
    put_time("t_max", found.t_maximum, found.t_maximum_error);
    put_time("t_min", found.t_minimum, found.t_minimum_error);
    put("t_reached", found.t, "s");
    body_["status"] = found.stop ? "stopped" : "complete";
    if (found.stop) {
      body_["stop"] = {
          {"reason", found.stop->reason}, {"t", found.stop->t}, {"message", found.stop->message}};
    }
    return std::nullopt;
  }

  Response written() {
    body_["error"] = std::move(errors_);
    if (!reasons_.empty()) body_["reason"] = std::move(reasons_);
    body_["units"] = std::move(units_);
    return written_answer(call_, scene(), system_.echo, body_, request_.digits);
  }

  const TurningPointsRequest& request_;
  Call& call_;
  Models& models_;
  ResolvedSystem system_;
  std::size_t coordinate_{};
  Json body_ = Json::object();
  Json units_ = Json::object();
  Json errors_ = Json::object();
  Json reasons_ = Json::object();
};

Response answer_turning_points(const Resolved<TurningPointsRequest>& resolved, Call& call, Models& models) {
  return TurningPointsAnswer(resolved, call, models).response();
}

/// About an angle rather than a length.
std::optional<Json> example_of_turning_points(const Scene& scene, const Json&) {
  const auto angle = std::ranges::find(scene.coordinates, "rad", &Coordinate::unit);
  const Coordinate& turning = angle == scene.coordinates.end() ? scene.coordinates.front() : *angle;
  return Json{{"coordinate", turning.name}, {"t_end", 10}};
}

}  // namespace

Endpoint turning_points_endpoint() {
  return {.name = "turning_points",
          .help = "The largest and the least value of a coordinate",
          .question = question(turning_points_table(), answer_turning_points),
          .cost = {.milliseconds = 5, .motion = Cost::Motion::up_to_t_end},
          .example = example_of_turning_points,
          .other_names = {"turning_point", "theta_max", "amplitude", "extrema", "turning"}};
}

}  // namespace qdot::api
