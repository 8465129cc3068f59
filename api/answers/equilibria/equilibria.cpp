#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "api/answers/equilibria/request.hpp"
#include "api/answers/equilibria/solution.hpp"
#include "api/answers/equilibria/walls.hpp"
#include "api/answers/exact_json.hpp"
#include "api/answers/lost_inertia.hpp"
#include "api/answers/stated.hpp"
#include "api/answers/steady_json.hpp"
#include "api/answers/units_of.hpp"
#include "core/closed/exact_equilibrium.hpp"
#include "core/dynamics/lost_inertia.hpp"
#include "core/steady/constrained_equilibria.hpp"
#include "core/steady/model_conditions.hpp"
#include "core/steady/search_region.hpp"

namespace qdot::api {
namespace {

constexpr const char* method_of_equilibria =
    "Interval arithmetic: branch and bound with Krawczyk's operator over one turn of each angle and the "
    "whole domain of each other coordinate. 'complete' means that no other equilibrium exists there; errors "
    "are proven bounds.";
constexpr std::size_t most_with_formulas = 12;
constexpr const char* multiple =
    "A multiple zero of the forces, several too close to be told apart in double precision, or none where "
    "the forces only come as near to zero as rounding: all of them lie within the error. Given is the place "
    "where the forces are least.";

/// The sizes of the coordinates, in millionths: the same where places differ in signs, and in which
/// coordinate is where. Empty where one is large.
std::vector<std::int64_t> family_of(std::span<const double> place) {
  constexpr double part = 1e6, largest = 1e6;
  std::vector<std::int64_t> sizes;
  for (const double q : place) {
    if (std::abs(q) > largest) return {};
    sizes.push_back(std::llround(std::abs(q) * part));
  }
  std::ranges::sort(sizes);
  return sizes;
}

/// All where they are few, else of each family the place with the largest sum; none where families are many.
std::vector<std::size_t> places_with_formulas(const std::vector<SteadyState>& states) {
  std::vector<std::size_t> chosen(states.size());
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  if (states.size() <= most_with_formulas) return chosen;
  const auto place = [&](std::size_t i) { return std::span(states[i].y).first(states[i].y.size() / 2); };
  const auto sum = [&](std::size_t i) { return std::accumulate(place(i).begin(), place(i).end(), 0.0); };
  std::map<std::vector<std::int64_t>, std::size_t> families;
  for (const std::size_t i : chosen) {
    const auto [family, is_new] = families.try_emplace(family_of(place(i)), i);
    if (!is_new && sum(i) > sum(family->second)) family->second = i;
  }
  chosen.clear();
  if (families.size() > most_with_formulas || families.contains({})) return chosen;
  for (const auto& [sizes, i] : families) chosen.push_back(i);
  return chosen;
}

class EquilibriaAnswer {
 public:
  /// `written`: what formulas are made of; none where they are not asked for.
  EquilibriaAnswer(const Dynamics& dynamics, const ResolvedState& state, std::optional<WrittenTexts> written,
                   int digits)
      : dynamics_(dynamics),
        scene_(dynamics.model().scene),
        state_(state),
        written_(std::move(written)),
        digits_(digits) {}

  Json body() {
    const ConstrainedEquilibria all = found_places();
    const Equilibria& found = all.found;
    Json body = Json::object();
    body["equilibria"] = Json::array();
    for (std::size_t i = 0; i < found.states.size(); ++i) {
      body["equilibria"].push_back(entry(found.states[i]));
      if (!all.multipliers.empty()) put_multipliers(body["equilibria"].back(), all.multipliers[i]);
      put_validity(body["equilibria"].back(), found.states[i]);
    }
    if (written_) put_formulas(body, found);
    body["complete"] = found.complete;
    if (!found.reason.empty()) body["reason"] = found.reason;
    body["searched"] = searched(found);
    if (!found.free.empty()) put_free(body, found);
    if (!found.momenta.empty()) put_momenta(body, found);
    body["method"] = method_of_equilibria;
    if (const std::string note = note_on_walls(dynamics_.model()); !note.empty())
      body["notes"].push_back(note);
    if (scene_.without_units && found.problem.forces) note_turns(body, found.problem);
    body["units"] = units(found);
    return body;
  }

 private:
  /// Of coordinates that are not zero, and of the square of the rate.
  void put_formulas(Json& body, const Equilibria& found) const {
    std::vector<Real> momenta;
    if (!found.momenta.empty()) {
      const auto& constants = found.problem.constants;
      for (const Interval& p : std::span(constants).last(found.momenta.size()))
        momenta.emplace_back(p.middle(), 0, p.width());
    }
    const std::vector<std::size_t> chosen = places_with_formulas(found.states);
    if (!chosen.empty() && chosen.size() < found.states.size())
      body["notes"].push_back(
          "Places that differ only in signs, and in which coordinate is where, have their formulas once.");
    Json& entries = body["equilibria"];
    for (const std::size_t i : chosen) {
      const ExactEquilibrium exact =
          exact_equilibrium(dynamics_, state_.parameters, *written_, found.states[i], momenta);
      for (std::size_t k = 0; k < exact.state.size(); ++k) {
        if (exact.state[k] && exact.state[k]->text != "0")
          entries[i]["exact"][scene_.coordinates[k].name] = exact_json(*exact.state[k]);
      }
      if (exact.rate2) entries[i]["exact_rate2"] = exact_json(*exact.rate2);
    }
  }

  [[nodiscard]] ConstrainedEquilibria found_places() const {
    if (dynamics_.model().has_constraints())
      return constrained_equilibria(dynamics_, state_.parameters, state_.y);
    return {equilibria(dynamics_, state_.parameters, state_.y), {}};
  }

  /// Of coordinates without units, which are not known to be angles.
  void note_turns(Json& body, const SteadyProblem& problem) const {
    for (const std::size_t k : problem.forces->unknowns) {
      if (!problem.forces->turns[k]) continue;
      const std::string& name = scene_.coordinates[problem.statics->reduction.kept[k]].name;
      body["notes"].push_back(
          "All forces are the same where " + name +
          " is 2*pi more, so it is taken for an angle: equilibria are those of one turn.");
    }
  }

  void put_multipliers(Json& json, const std::optional<std::vector<Ball>>& multipliers) const {
    const std::vector<qdot::Column> columns = multiplier_columns(dynamics_.model());
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const std::string& name = columns[j].name;
      json["multipliers"][name] = multipliers ? Json((*multipliers)[j].value()) : Json(nullptr);
      json["error"][name] = Json(nullptr);
      if (multipliers)
        json["error"][name] = stated_error({(*multipliers)[j].value(), (*multipliers)[j].error()}, digits_);
    }
  }

  [[nodiscard]] Json entry(const SteadyState& steady) const {
    Json json{{"state", state_json(scene_, steady.y)}, {"error", errors(steady)}};
    put_stability(json, steady.stability, digits_);
    json["residual"] = std::isfinite(steady.residual) ? Json(steady.residual) : Json(nullptr);
    if (!steady.simple) json["note"] = multiple;
    if (const std::string wall = wall_before(dynamics_, state_.parameters, steady.y); !wall.empty())
      json["note"] = (steady.simple ? "" : multiple + std::string(" ")) + wall;
    return json;
  }

  [[nodiscard]] Json errors(const SteadyState& steady) const {
    const Json names = state_json(scene_, steady.y);
    Json json = Json::object();
    std::size_t i = 0;
    for (const auto& [name, value] : names.items()) {
      json[name] = stated_error(Stated{steady.y[i], steady.errors[i]}.as_typed(state_.y.exact(i)), digits_);
      ++i;
    }
    return json;
  }

  /// Whether the conditions of the model hold there, such as that a string is taut. What may be zero is.
  void put_validity(Json& json, const SteadyState& steady) const {
    if (scene_.valid_while.empty()) return;
    const std::vector<qdot::Column> columns = validity_columns(dynamics_.model());
    try {
      const std::vector<Ball> values =
          model_conditions(dynamics_, state_.parameters.as<Ball>(), state_of(steady));
      const auto is_open = [&](const Ball& c) {
        return !steady.simple && c.contains_zero() && c.error() > 0;
      };
      const bool open = conditions_hold(values) && std::ranges::any_of(values, is_open);
      json["valid"] = open ? Json(nullptr) : Json(conditions_hold(values));
      for (std::size_t i = 0; i < values.size(); ++i) {
        Stated stated = condition(values[i]);
        if (steady.at_kink) stated.error = infinity;
        json["validity"][columns[i].name] = stated.value;
        json["error"][key_beside(json["error"], "validity", columns[i].name)] = stated_error(stated, digits_);
      }
    } catch (const Error&) {  // nothing is known of a condition that has no value there
      json["valid"] = nullptr;
    }
  }

  /// Where it may be at a kink, its number stands for the kink itself.
  [[nodiscard]] static std::vector<Ball> state_of(const SteadyState& steady) {
    std::vector<Ball> y;
    for (std::size_t i = 0; i < steady.y.size(); ++i)
      y.emplace_back(DoubleDouble(steady.y[i]), steady.at_kink ? 0 : steady.errors[i]);
    return y;
  }

  [[nodiscard]] static Stated condition(const Ball& c) {
    if (c.is_finite() && c.contains_zero()) return {0, c.magnitude()};
    return {c.value(), c.error()};
  }

  [[nodiscard]] Json searched(const Equilibria& found) const {
    const Box region = search_region(dynamics_.model(), found.problem);
    Json json = Json::object();
    for (std::size_t k = 0; k < region.size(); ++k) {
      const std::size_t j = found.problem.forces->unknowns[k];
      const Coordinate& q = scene_.coordinates[found.problem.statics->reduction.kept[j]];
      json[q.name] =
          found.problem.forces->turns[j] ? Json("one turn") : Json{region[k].lower, region[k].upper};
    }
    return json;
  }

  void put_free(Json& body, const Equilibria& found) const {
    std::string names;
    body["free"] = Json::array();
    for (const std::size_t i : found.free) {
      body["free"].push_back(scene_.coordinates[i].name);
      names += (names.empty() ? "" : ", ") + scene_.coordinates[i].name;
    }
    body["free_reason"] =
        "No force depends on " + names +
        (found.states.empty() ? ", so where nothing is in balance, nothing is for any other value either."
                              : ": every value belongs to an equilibrium; given are those of 'initial'.");
  }

  void put_momenta(Json& body, const Equilibria& found) const {
    const std::vector<std::size_t>& ignored = found.problem.statics->reduction.ignored;
    for (std::size_t k = 0; k < ignored.size(); ++k) {
      const std::string name = "p_" + scene_.coordinates[ignored[k]].name;
      body["momenta"][name] = found.momenta[k];
    }
    body["momenta_reason"] =
        "These are steady motions: the ignorable coordinates move uniformly, with the momenta of 'initial'.";
  }

  [[nodiscard]] Json units(const Equilibria& found) const {
    Json units = steady_units(scene_);
    const auto put = [&](const std::string& place, const std::vector<qdot::Column>& columns) {
      for (const qdot::Column& column : columns) units[key_beside(units, place, column.name)] = column.unit;
    };
    if (!found.states.empty()) {
      put("multipliers", multiplier_columns(dynamics_.model()));
      put("validity", validity_columns(dynamics_.model()));
    }
    if (!found.momenta.empty())
      put("momenta", momentum_columns(dynamics_.model(), found.problem.statics->reduction.ignored));
    units[key_beside(units, "equilibria", "residual")] = "SI unit of the generalized forces";
    return units;
  }

  const Dynamics& dynamics_;
  const Scene& scene_;
  const ResolvedState& state_;
  std::optional<WrittenTexts> written_;
  int digits_;
};

/// The initial state matters where ignorable coordinates move, or where a coordinate is free. Elsewhere what
/// is said of it would be ignored.
std::vector<FieldError> unread_initial(const Json& body, const EquilibriaRequest& request,
                                       const Place& root) {
  std::vector<FieldError> errors;
  if (request.solve_for || body.contains("momenta") || body.contains("free")) return errors;
  const bool is_query = root.road() == Road::query;
  const Place initial = is_query ? root : root.below("initial");
  for (const auto& [name, value] : request.system.initial) {
    errors.push_back(initial.below(name).error(
        "not_applicable", "All equilibria are found, whatever the initial state: leave " + name +
                              " out. The parameter that makes a position an equilibrium is asked for by "
                              "'solve_for' and 'at'."));
  }
  return errors;
}

/// Coordinates whose equation vanishes with these parameters, so that its limit tells where they rest.
std::vector<std::size_t> limits_of_forces(const ResolvedSystem& system) {
  if (system.model().has_constraints()) return {};
  return system.dynamics->statics(system.state.parameters)->reduction.limits;
}

Response answer_equilibria(const Resolved<EquilibriaRequest>& resolved, Call& call, Models& models) {
  const EquilibriaRequest& request = resolved.request;
  ResolvedSystem system =
      resolved_system(request.system, resolved.echo, models, std::nullopt, request.solve_for.value_or(""));
  const Dynamics& dynamics = *system.dynamics;
  const int digits = request.digits.value_or(shortest_digits);
  if (request.solve_for) {
    auto errors = take_position(dynamics, request, Place(road_of(call)), system.state, system.echo);
    if (!errors.empty())
      return to_response(invalid_request(std::move(errors)), call.target.path, call.layout);
  } else {
    refuse_parts_without_value(system);
    system.echo.erase("at");
  }
  std::optional<WrittenTexts> written;
  if (wants(call, "exact") || wants(call, "exact_rate2")) written = written_texts(request.system);
  const Json body = request.solve_for
                        ? solution_body(dynamics, system.state, request, digits)
                        : EquilibriaAnswer(dynamics, system.state, std::move(written), digits).body();
  call.timing.lap("solve");
  if (auto errors = unread_initial(body, request, Place(road_of(call))); !errors.empty())
    return to_response(invalid_request(std::move(errors)), call.target.path, call.layout);
  if (!request.solve_for)
    std::ranges::copy(notes_on_rates(dynamics, request.system, system.state), std::back_inserter(call.notes));
  const std::vector<std::size_t> limits = limits_of_forces(system);
  if (!limits.empty()) {
    const bool has_mass = !lost_inertia(system.model(), system.state.parameters).fault;
    note_limits(system.scene(), limits, has_mass ? Limit::moves : Limit::has_no_mass, call);
  }
  return written_answer(call, system.scene(), system.echo, body, digits);
}

}  // namespace

Endpoint equilibria_endpoint() {
  return {.name = "equilibria",
          .help = "All equilibria, or the parameter that makes a position one",
          .question = question(equilibria_table(), answer_equilibria),
          .cost = {.milliseconds = 1},
          .other_names = {"equilibrium", "fixed_points", "statics", "steady"}};
}

}  // namespace qdot::api
