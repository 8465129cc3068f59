#include "api/answers/energy/request.hpp"
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
  EnergyAnswer(const Dynamics& dynamics, const ResolvedState& state, double t)
      : dynamics_(dynamics), state_(state), t_(t) {}

  Json body() {
    const Model& model = dynamics_.model();
    if (!model.energy) no_energies();
    body_.update(values(energies(model)));
    body_.update(values(momentum_columns(model)));
    body_["accelerations"] = values(acceleration_columns(model));
    if (model.has_constraints()) body_["multipliers"] = values(multiplier_columns(model));
    if (!model.scene.valid_while.empty()) body_["validity"] = values(validity_columns(model));
    if (!model.scene.reports.empty()) body_["reports"] = values(report_columns(model));
    body_["conserved"] = conserved();
    body_["units"] = std::move(units_);
    return std::move(body_);
  }

 private:
  void no_energies() {
    for (const char* name : {"T", "T2", "T1", "T0", "V", "E"}) body_[name] = nullptr;
    body_["reason"] =
        "The scene gives only its Lagrangian, so kinetic and potential energy are not known apart.";
  }

  Json values(const std::vector<qdot::Column>& columns) {
    const std::vector<double> numbers = values_at_kinks(dynamics_, columns, state_.parameters, t_, state_.y);
    Json json = Json::object();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      json[columns[i].name] = numbers[i];
      units_[columns[i].name] = columns[i].unit;
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
    const bool finite = conserved.values->evaluate(t_, state_.y, workspace, numbers) == Evaluation::ok;
    for (std::size_t i = 0; finite && i < numbers.size(); ++i) {
      const ConservedQuantity& quantity = conserved.quantities[i];
      array.push_back(
          {{"name", quantity.name}, {"value", numbers[i]}, {"unit", quantity.unit}, {"why", quantity.why}});
    }
  }

  const Dynamics& dynamics_;
  const ResolvedState& state_;
  double t_;
  Json body_ = Json::object();
  Json units_ = Json::object();
};

Response answer_energy(const Resolved<EnergyRequest>& resolved, Call& call, Models& models) {
  const auto& [request, echo] = resolved;
  const ResolvedSystem system = resolved_system(request.system, echo, models, request.t);
  const Json body = EnergyAnswer(*system.dynamics, system.state, request.t).body();
  call.timing.lap("solve");
  return written_answer(call, system.scene(), system.echo, body, request.digits);
}

}  // namespace

Endpoint energy_endpoint() {
  return {.name = "energy",
          .help = "Energies, momenta and accelerations at a state",
          .question = question(energy_table(), answer_energy),
          .other_names = {"energies", "state", "momenta"}};
}

}  // namespace qdot::api
