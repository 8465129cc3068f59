#include <cmath>

#include "api/answers/energy/request.hpp"
#include "api/answers/lost_inertia.hpp"
#include "api/answers/stated.hpp"
#include "api/answers/units_of.hpp"
#include "core/dynamics/known_signs.hpp"
#include "core/motion/column_errors.hpp"
#include "core/motion/values_at_kinks.hpp"

namespace qdot::api {
namespace {

/// T and its parts, V, L, E and h; a scene that gives only its Lagrangian has L and h.
std::vector<qdot::Column> energies(const Model& model) {
  std::vector<qdot::Column> columns;
  if (model.energy) {
    columns = {{"T", "J", *model.lagrangian.kinetic_energy},
               {"T2", "J", model.kinetic_parts[0]},
               {"T1", "J", model.kinetic_parts[1]},
               {"T0", "J", model.kinetic_parts[2]},
               {"V", "J", *model.lagrangian.potential_energy}};
  }
  columns.push_back({"L", "J", model.lagrangian.lagrangian});
  if (model.energy) columns.push_back({"E", "J", *model.energy});
  columns.push_back({"h", "J", model.jacobi});
  columns.push_back({"H", "J", model.jacobi});  // the Hamiltonian's value
  return columns;
}

class EnergyAnswer {
 public:
  EnergyAnswer(const Dynamics& dynamics, const ResolvedState& state, double t, int digits)
      : dynamics_(dynamics), state_(state), t_(t), digits_(digits) {}

  Json body() {
    const Model& model = dynamics_.model();
    if (!model.energy) no_energies();
    compute();
    body_.update(next("", energies(model)));
    body_.update(next("", momentum_columns(model)));
    body_["accelerations"] = next("accelerations", acceleration_columns(model));
    if (model.has_constraints()) body_["multipliers"] = next("multipliers", multiplier_columns(model));
    if (!model.scene.valid_while.empty()) body_["validity"] = next("validity", validity_columns(model));
    if (!model.scene.reports.empty()) body_["reports"] = next("reports", report_columns(model));
    body_["conserved"] = conserved();
    body_["error"] = std::move(errors_);
    body_["units"] = std::move(units_);
    return std::move(body_);
  }

 private:
  void no_energies() {
    for (const char* name : {"T", "T2", "T1", "T0", "V", "E"}) body_[name] = nullptr;
    body_["reason"] =
        "The scene gives only its Lagrangian, so kinetic and potential energy are not known apart.";
  }

  /// All values at once, since they have much in common.
  void compute() {
    const Model& model = dynamics_.model();
    std::vector<qdot::Column> all;
    for (const auto& columns : {energies(model), momentum_columns(model), acceleration_columns(model),
                                multiplier_columns(model), validity_columns(model), report_columns(model)}) {
      all.insert(all.end(), columns.begin(), columns.end());
    }
    stated_ = model.impulse.empty() ? values_at_kinks(dynamics_, all, state_.parameters, t_, state_.y)
                                    : beside_jumps(all);
    refuse_poles(all, energies(model).size() + momentum_columns(model).size());
  }

  /// Of a Lagrangian whose jumps are impulses, at a state that lies at none.
  [[nodiscard]] StatedValues beside_jumps(const std::vector<qdot::Column>& columns) const {
    if (!signs_are_known(dynamics_.model(), columns, state_.parameters, t_, state_.y))
      throw Error(ErrorCode::not_applicable, dynamics_.model().impulse);
    StatedValues stated{.values = values_at(dynamics_, columns, state_.parameters, t_, state_.y),
                        .errors = {}};
    stated.errors = value_errors(*dynamics_.columns(columns), state_.parameters, t_, state_.y, stated.values);
    return stated;
  }

  /// A number of which nothing is known is none: tan(q) at pi/2, to the nearest double.
  void refuse_poles(const std::vector<qdot::Column>& columns, std::size_t count) const {
    std::string names;
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(stated_.errors[i])) names += (names.empty() ? "" : ", ") + columns[i].name;
    }
    if (names.empty()) return;
    throw Error(
        ErrorCode::invalid_state,
        "In this state nothing is known of " + names +
            ": it is where they have no finite value, or next to such a place by no more than rounding.");
  }

  [[nodiscard]] Json written_error(double value, double error) const {
    return stated_error({value, error}, digits_);
  }

  /// The next of the values, in the order of compute(), which stand under `place`.
  Json next(const std::string& place, const std::vector<qdot::Column>& columns) {
    Json json = Json::object();
    for (const qdot::Column& column : columns) {
      const double value = stated_.values[next_];
      json[column.name] = value;
      const std::string key = key_beside(errors_, place, column.name);
      errors_[key] = written_error(value, stated_.errors[next_++]);
      units_[key] = column.unit;
    }
    return json;
  }

  Json conserved() {
    Json array = Json::array();
    append(array, *dynamics_.conserved(state_.parameters));
    append(array, *dynamics_.found(state_.parameters));
    return array;
  }

  void append(Json& array, const Conserved& conserved) {
    std::vector<double> numbers(conserved.quantities.size());
    if (numbers.empty()) return;
    Workspace workspace = conserved.values->bind(state_.parameters);
    if (conserved.values->evaluate(t_, state_.y, workspace, numbers) != Evaluation::ok) return;
    const std::vector<double> errors =
        value_errors(*conserved.values, state_.parameters, t_, state_.y, numbers);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const ConservedQuantity& quantity = conserved.quantities[i];
      array.push_back({{"name", quantity.name},
                       {"value", numbers[i]},
                       {"error", written_error(numbers[i], errors[i])},
                       {"unit", quantity.unit},
                       {"why", quantity.why}});
    }
  }

  const Dynamics& dynamics_;
  const ResolvedState& state_;
  double t_;
  int digits_;
  StatedValues stated_;
  std::size_t next_{};
  Json body_ = Json::object();
  Json errors_ = Json::object();
  Json units_ = Json::object();
};

Response answer_energy(const Resolved<EnergyRequest>& resolved, Call& call, Models& models) {
  const auto& [request, echo] = resolved;
  const ResolvedSystem system = resolved_system(request.system, echo, models, request.t);
  note_lost_inertia(system, call);
  const int digits = request.digits.value_or(shortest_digits);
  const Json body = EnergyAnswer(*system.dynamics, system.state, request.t, digits).body();
  call.timing.lap("solve");
  return written_answer(call, system.scene(), system.echo, body, digits);
}

}  // namespace

Endpoint energy_endpoint() {
  return {.name = "energy",
          .help = "Energies, momenta and accelerations at a state",
          .question = question(energy_table(), answer_energy),
          .other_names = {"energies", "state", "momenta"}};
}

}  // namespace qdot::api
