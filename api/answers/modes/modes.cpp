#include "api/answers/modes/request.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "api/answers/exact_json.hpp"
#include "api/answers/lost_inertia.hpp"
#include "api/answers/stated.hpp"
#include "core/base/short_number.hpp"
#include "core/closed/exact_modes.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"
#include "core/mechanics/units.hpp"
#include "core/steady/constrained_modes.hpp"
#include "core/steady/steady_rolling.hpp"

namespace qdot::api {
namespace {

constexpr const char* coinciding =
    "Eigenvalues coincide here, and no bound of the error could be proven; about half of the digits are "
    "good.";
constexpr const char* not_isolated =
    "The equilibrium is not isolated to first order, so no bound of its error could be proven.";

/// The place that a request names, what it leaves out taken from the initial state.
Reals place_of(const Scene& scene, const SystemChoice& choice, const Reals& y) {
  Reals place;
  for (std::size_t i = 0; i < scene.coordinates.size(); ++i) {
    place.push_back(y.exact(i));
    for (const auto& [name, value] : choice.equilibrium) {
      if (scene.coordinates[i].name == name) place.set(i, value);
    }
  }
  return place;
}

/// The value of an expression of the parameters.
double value_of(const Model& model, std::span<const double> parameters, const std::string& text) {
  Graph graph;
  std::vector<std::string> names;
  for (const Parameter& p : model.scene.parameters) names.push_back(p.name);
  const Expression e = parse(text, graph, names);
  std::vector<Assignment> values;
  for (std::size_t i = 0; i < names.size(); ++i) values.emplace_back(graph.symbol(names[i]), parameters[i]);
  return evaluate(e, values);
}

class ModesAnswer {
 public:
  ModesAnswer(const Model& model, std::span<const double> parameters, const Reals& place, const Modes& modes,
              const ExactModes& exact, int digits)
      : scene_(model.scene), place_(place), modes_(modes), exact_(exact), digits_(digits) {
    for (const Coordinate& q : scene_.coordinates) {
      scales_.push_back(q.scale.empty() ? 1 : value_of(model, parameters, q.scale));
      scaled_units_.push_back(q.scale.empty() ? q.unit : "m");
    }
    if (scene_.scales) unit_of_time_ = value_of(model, parameters, scene_.scales->time);
  }

  Json body() {
    Json body = Json::object();
    body["equilibrium"] = equilibrium();
    body["coordinates"] = Json::array();
    for (const Coordinate& q : scene_.coordinates) body["coordinates"].push_back(q.name);
    body["mass_matrix"] = matrix(modes_.mass);
    body["stiffness_matrix"] = matrix(modes_.stiffness);
    body["gyroscopic_matrix"] = matrix(modes_.gyroscopic);
    if (!modes_.damping.empty()) body["damping_matrix"] = matrix(modes_.damping);
    body["modes"] = Json::array();
    for (std::size_t i = 0; i < modes_.modes.size(); ++i) {
      body["modes"].push_back(mode_json(modes_.modes[i]));
      if (exact_.modes[i]) body["modes"].back()["exact"] = exact_mode_json(modes_.modes[i], *exact_.modes[i]);
    }
    body["units"] = units();
    return body;
  }

 private:
  [[nodiscard]] std::size_t size() const { return scene_.coordinates.size(); }

  /// The error of a value as it is written.
  [[nodiscard]] Json written_error(double value, const std::optional<double>& error) const {
    return error ? stated_error({value, *error}, digits_) : Json(nullptr);
  }

  /// A coordinate that nothing decides is where it was typed.
  [[nodiscard]] Json state_error(std::size_t i) const {
    if (!modes_.y_error[i]) return nullptr;
    const Stated number{modes_.y[i], *modes_.y_error[i]};
    return stated_error(i < size() ? number.as_typed(place_.exact(i)) : number, digits_);
  }

  /// Frequency and period, from omega with what their own rounding adds to its error.
  void put_cycle(Json& json, double omega, const std::optional<double>& error) const {
    const Interval turn = Interval(2) * enclosed_pi();
    json["f"] = omega / (2 * std::numbers::pi);
    if (omega == 0) return;
    json["period"] = 2 * std::numbers::pi / omega;
    if (!error) return;
    const Interval enclosed = Stated{omega, *error}.enclosure();
    if (!(enclosed.lower > 0)) return;
    json["f_error"] = stated_error(Stated::within(json["f"], enclosed / turn), digits_);
    json["period_error"] = stated_error(Stated::within(json["period"], turn / enclosed), digits_);
  }

  [[nodiscard]] Json equilibrium() const {
    Json json{{"state", state_json(scene_, modes_.y)}, {"stability", name(modes_.stability)}};
    if (!modes_.undecided.empty()) json["nonlinear"] = modes_.undecided;
    Json error = state_json(scene_, modes_.y);
    std::size_t i = 0;
    bool proven = true;
    for (auto& [coordinate, value] : error.items()) {
      value = state_error(i);
      proven = proven && modes_.y_error[i].has_value();
      ++i;
    }
    json["error"] = std::move(error);
    if (!proven) json["reason"] = not_isolated;
    if (Json exact = exact_state_json(); !exact.empty()) json["exact"] = std::move(exact);
    return json;
  }

  /// Formulas of the coordinates that are not zero.
  [[nodiscard]] Json exact_state_json() const {
    Json json = Json::object();
    for (std::size_t i = 0; i < size(); ++i) {
      if (exact_.state[i] && exact_.state[i]->text != "0")
        json[scene_.coordinates[i].name] = exact_json(*exact_.state[i]);
    }
    return json;
  }

  [[nodiscard]] Json matrix(const std::vector<double>& entries) const {
    Json rows = Json::array();
    for (std::size_t i = 0; i < size(); ++i) {
      Json row = Json::array();
      for (std::size_t j = 0; j < size(); ++j) row.push_back(entries.empty() ? 0 : entries[i * size() + j]);
      rows.push_back(std::move(row));
    }
    return rows;
  }

  [[nodiscard]] Json mode_json(const Mode& mode) const {
    const bool swings = mode.omega != 0;
    Json json{{"kind", name(mode.kind)}, {"omega", mode.omega}};
    put_cycle(json, mode.omega, mode.omega_error);
    const bool has_rate = mode.kind == ModeKind::growth || mode.kind == ModeKind::decay;
    if (has_rate) json["rate"] = mode.rate;
    const bool about_rate = has_rate && !swings;
    json["error"] =
        about_rate ? written_error(mode.rate, mode.rate_error) : written_error(mode.omega, mode.omega_error);
    if (swings && (has_rate || mode.rate_error))
      json["rate_error"] = written_error(mode.rate, mode.rate_error);
    if (json["error"].is_null()) json["reason"] = coinciding;
    if (unit_of_time_ && std::isfinite(*unit_of_time_) && mode.lambda)
      json["lambda"] = *mode.lambda * *unit_of_time_ * *unit_of_time_;
    if (mode.multiplicity > 1) json["multiplicity"] = mode.multiplicity;
    json["shape"] = shape_json(mode.shape);
    if (!mode.shape_error.empty()) json["shape_error"] = shape_errors(mode);
    if (has_one_unit()) json["shape_scaled"] = shape_json(scaled(mode.shape));
    return json;
  }

  /// The formula of omega^2 or of rate^2, of the rate where friction makes it creep, and what follows from
  /// it.
  [[nodiscard]] Json exact_mode_json(const Mode& mode, const ExactMode& exact) const {
    const std::string name = mode.omega != 0 ? "omega" : "rate";
    Json json{{"of", exact.creeps ? name : name + "^2"}};
    json.update(exact_json(exact.square));
    if (exact.rate) json[name] = formula_json(*exact.rate);
    if (exact.damping) json["rate"] = formula_json(*exact.damping);
    if (exact.period) json["period"] = formula_json(*exact.period);
    if (exact.lambda) json["lambda"] = formula_json(*exact.lambda);
    if (!exact.shape.empty()) json["shape"] = exact_shape_json(exact.shape);
    if (!exact.scaled_shape.empty()) json["shape_scaled"] = exact_shape_json(exact.scaled_shape);
    if (exact.general) json["general"] = exact_json(*exact.general);
    return json;
  }

  [[nodiscard]] Json exact_shape_json(const std::vector<ClosedForm>& shape) const {
    Json json = Json::object();
    for (std::size_t i = 0; i < shape.size(); ++i) json[scene_.coordinates[i].name] = formula_json(shape[i]);
    return json;
  }

  [[nodiscard]] bool has_one_unit() const {
    return std::all_of(scaled_units_.begin(), scaled_units_.end(),
                       [&](const std::string& unit) { return unit == scaled_units_[0]; });
  }

  [[nodiscard]] std::vector<std::complex<double>> scaled(std::vector<std::complex<double>> shape) const {
    for (std::size_t i = 0; i < shape.size(); ++i) shape[i] *= scales_[i];
    const auto first = std::find_if(shape.begin(), shape.end(), [](const auto& c) { return c != 0.0; });
    const double unit = first == shape.end() ? 1 : first->real();
    for (auto& component : shape) component /= unit;
    return shape;
  }

  [[nodiscard]] Json shape_json(const std::vector<std::complex<double>>& shape) const {
    const bool in_step =
        std::all_of(shape.begin(), shape.end(), [](const auto& component) { return component.imag() == 0; });
    Json json = Json::object();
    for (std::size_t i = 0; i < shape.size(); ++i) {
      Json& component = json[scene_.coordinates[i].name];
      component = shape[i].real();
      if (!in_step) component = {{"re", shape[i].real()}, {"im", shape[i].imag()}};
    }
    return json;
  }

  [[nodiscard]] Json shape_errors(const Mode& mode) const {
    Json json = Json::object();
    for (std::size_t i = 0; i < mode.shape.size(); ++i)
      json[scene_.coordinates[i].name] = stated_error(mode.shape[i], mode.shape_error[i], digits_);
    return json;
  }

  /// J s^power over the units of two coordinates.
  [[nodiscard]] Json matrix_units(int power) const {
    Json rows = Json::array();
    for (const Coordinate& a : scene_.coordinates) {
      Json row = Json::array();
      for (const Coordinate& b : scene_.coordinates) {
        const Dimension action = parse_unit("J")->dimension * pow(parse_unit("s")->dimension, power);
        row.push_back(to_text(action / (parse_unit(a.unit)->dimension * parse_unit(b.unit)->dimension)));
      }
      rows.push_back(std::move(row));
    }
    return rows;
  }

  [[nodiscard]] Json units() const {
    Json units = state_units(scene_);
    units["mass_matrix"] = matrix_units(2);
    units["stiffness_matrix"] = matrix_units(0);
    units["gyroscopic_matrix"] = matrix_units(1);
    if (!modes_.damping.empty()) units["damping_matrix"] = matrix_units(1);
    units.update(Json{{"omega", "rad/s"}, {"f", "Hz"}, {"period", "s"}, {"rate", "1/s"}, {"lambda", "1"}});
    return units;
  }

  const Scene& scene_;
  const Reals& place_;  ///< as it was typed
  const Modes& modes_;
  const ExactModes& exact_;
  int digits_;
  std::vector<double> scales_;
  std::vector<std::string> scaled_units_;
  std::optional<double> unit_of_time_;
};

ExactModes no_formulas(const Modes& modes) {
  ExactModes none;
  none.modes.resize(modes.modes.size());
  none.state.resize(modes.y.size() / 2);
  return none;
}

/// Whether anything in the scene is other where the coordinate is elsewhere.
bool something_depends_on(const Model& model, std::size_t coordinate) {
  const Expression& q = model.parsed.symbols.coordinates.value[coordinate];
  const auto depends = [&](const Expression& e) { return depends_on(e, q); };
  const Lagrangian& l = model.lagrangian;
  return model.has_constraints() || depends(l.lagrangian) ||
         std::ranges::any_of(l.generalized_forces, depends);
}

/// Rates of the start that a steady motion has not: those of the request and of a scene that it
/// brings, and where constraints hold velocities those of any scene.
void note_rates_left_out(const Model& model, const SystemChoice& choice, const Reals& start,
                         const Modes& modes, Json& body) {
  const std::size_t n = model.scene.coordinates.size();
  const bool rolls = has_constraint_in_velocities(model);
  const auto angles =
      std::ranges::count_if(model.scene.coordinates, [](const Coordinate& q) { return q.unit == "rad"; });
  for (std::size_t i = 0; i < n; ++i) {
    const std::string& name = model.scene.coordinates[i].name;
    const bool was_given = choice.is_carried || std::ranges::any_of(choice.initial, [&](const auto& given) {
                             return given.first == name + "_dot";
                           });
    if ((!rolls && !was_given) || start[n + i] == 0 || modes.y[n + i] != 0) continue;
    std::string note = "The start has " + name + "_dot = " + short_number(start[n + i]) +
                       ", but these are small motions about the state in 'equilibrium', where " + name +
                       " rests: " +
                       (something_depends_on(model, i) ? "something depends on it, so that "
                                                       : "nothing depends on where it is, and ");
    note += rolls ? "while it moves nothing is steady." : "its rate is left out.";
    if (!rolls && angles >= 3)
      note += " A body's steady spin is found where its angle is the first in the sequence.";
    body["notes"].push_back(std::move(note));
  }
}

/// Which of a family of equilibria this is.
void note_family(const Scene& scene, const Modes& modes, Json& body) {
  if (modes.held.empty()) return;
  std::string kept;
  for (std::size_t k = 0; k < modes.held.size(); ++k) {
    const bool is_last = k > 0 && k + 1 == modes.held.size();
    kept += std::string(k == 0 ? "" : is_last ? " and " : ", ") + scene.coordinates[modes.held[k]].name;
  }
  body["notes"].push_back(
      "The rigid modes lead from this equilibrium to others like it. This is the one that has " + kept +
      (modes.held.size() == 1 ? " as it stands" : " as they stand") +
      " here, and the errors are those of the other coordinates.");
}

/// What is to be said of a place that was looked for, and is not simply the stable one downhill.
void note_arrival(const Modes& modes, const Reals& start, Json& body) {
  bool is_start = true;
  for (std::size_t i = 0; i < start.size() / 2; ++i) is_start = is_start && modes.y[i] == start[i];
  if (is_start || !modes.arrival) return;
  const auto leads_on = [](const Mode& mode) { return mode.kind == ModeKind::growth && mode.omega == 0; };
  const char* note = nullptr;
  if (modes.arrival == Arrival::newton)
    note =
        "Downhill of 'initial' no stable place was found that the model allows: this one is where Newton's "
        "iteration ends from there.";
  else if (std::ranges::any_of(modes.modes, leads_on))
    note =
        "The way downhill of 'initial' ends in this unstable place, on a ridge: beside the ridge it leads on.";
  else if (modes.arrival == Arrival::seen_downhill)
    note =
        "This place is downhill of 'initial'; that the force does not vanish on the way was seen at points "
        "only.";
  if (note != nullptr) body["notes"].push_back(note);
}

Response answer_modes(const Resolved<ModesRequest>& resolved, Call& call, Models& models) {
  const auto& [request, echo] = resolved;
  const ResolvedSystem system = resolved_system(request.system, echo, models, std::nullopt);
  note_lost_inertia(system, call);
  const auto& [parameters, y] = system.state;
  const Reals place = place_of(system.scene(), request.system, y);
  const auto guess =
      request.system.equilibrium.empty() ? std::nullopt : std::optional<std::vector<double>>(place);
  const bool is_constrained = system.model().has_constraints();
  const Modes modes = is_constrained ? constrained_modes(*system.dynamics, parameters, y, guess)
                                     : normal_modes(*system.dynamics, parameters, y, guess);
  const ExactModes exact =
      wants(call, "exact") ? exact_modes(*system.dynamics, parameters, written_texts(request.system), modes)
                           : no_formulas(modes);
  const int digits = request.digits.value_or(shortest_digits);
  Json body = ModesAnswer(system.model(), parameters, place, modes, exact, digits).body();
  note_arrival(modes, y, body);
  note_rates_left_out(system.model(), request.system, y, modes, body);
  note_family(system.scene(), modes, body);
  call.timing.lap("solve");
  return written_answer(call, system.scene(), system.echo, body, digits);
}

}  // namespace

Endpoint modes_endpoint() {
  return {.name = "modes",
          .help = "Equilibrium, natural frequencies and mode shapes",
          .question = question(modes_table(), answer_modes),
          .cost = {.milliseconds = 1},
          .other_names = {"mode", "normal_modes", "frequencies", "frequency", "natural_frequencies",
                          "eigenmodes", "eigenvalues", "linearize", "vibrations"}};
}

}  // namespace qdot::api
