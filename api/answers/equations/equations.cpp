#include "api/answers/equations/request.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/canonical.hpp"
#include "core/mechanics/conserved.hpp"
#include "core/mechanics/dimensionless.hpp"
#include "core/mechanics/notation.hpp"
#include "core/symmetry/found_quantities.hpp"

namespace qdot::api {
namespace {

constexpr const char* too_long = "It would be too long to write out; compute with M q_ddot = f instead.";
constexpr const char* too_long_with_constraints =
    "It would be too long to write out; solve the equations of motion together with the constraints, each "
    "differentiated until accelerations stand in it.";

constexpr const char* not_quadratic =
    "L is not quadratic in the velocities, so these are not written by the momenta; 'jacobi_integral' is the "
    "same energy by the velocities.";

constexpr const char* search_given_up =
    "More may be conserved: the search for symmetries, or the proof of one, did not succeed within its bounds.";

class EquationsAnswer {
 public:
  EquationsAnswer(const Model& model, Form form)
      : model_(model), form_(form), notation_(notation_of(model.scene)), own_(copied(model.lagrangian)) {}

  Json body() {
    const EquationsOfMotion equations = derive_equations(own_);
    write_energies();
    body_["generalized_forces"] = by_coordinate(own_.generalized_forces);
    body_["equations_of_motion"] = implicit(equations);
    if (model_.has_constraints()) body_["constraints"] = constraints();
    attempt("accelerations", [&] { return accelerations(equations); });
    body_["mass_matrix"] = matrix(mass_matrix(own_));
    body_["momenta"] = momenta(conjugate_momenta(own_));
    body_["jacobi_integral"] = written(jacobi_integral(own_));
    attempt("hamiltonian", [&] {
      const auto found = hamiltonian(own_);
      return optional(found, found ? "" : without_momenta());
    });
    body_["ignorable_coordinates"] = names(ignorable_coordinates(own_));
    attempt("routhian", [&] { return reduced(); });
    body_["conserved"] = conserved();
    body_["validity"] = validity();
    attempt("dimensionless", [&] { return dimensionless(); });
    if (!reasons_.empty()) body_["reasons"] = std::move(reasons_);
    return std::move(body_);
  }

 private:
  [[nodiscard]] std::string written(const Expression& e) const { return print(e, form_, notation_); }
  [[nodiscard]] const std::string& coordinate(std::size_t i) const {
    return model_.scene.coordinates[i].name;
  }

  /// The part, or null with the reason why there is none.
  void attempt(const std::string& name, const std::function<Json()>& make) {
    body_[name] = nullptr;
    try {
      body_[name] = make();
    } catch (const Error& error) {
      reasons_[name] = error.code() == ErrorCode::not_applicable ? error.what() : why_too_long();
    }
  }

  /// With constraints M q_ddot = f does not determine the motion.
  [[nodiscard]] const char* why_too_long() const {
    return model_.has_constraints() ? too_long_with_constraints : too_long;
  }

  /// Why velocities are not written by momenta.
  [[nodiscard]] const char* without_momenta() const {
    return canonical_equations(own_) ? why_too_long() : not_quadratic;
  }

  [[nodiscard]] Json optional(const std::optional<Expression>& e, const char* why_not) const {
    if (!e) throw Error(ErrorCode::not_applicable, why_not);
    return written(*e);
  }

  [[nodiscard]] Json by_coordinate(const std::vector<Expression>& expressions) const {
    Json json = Json::object();
    for (std::size_t i = 0; i < expressions.size(); ++i) json[coordinate(i)] = written(expressions[i]);
    return json;
  }

  /// By the names that the Hamiltonian and the Routhian have for them.
  [[nodiscard]] Json momenta(const std::vector<Expression>& expressions) const {
    const std::vector<std::string> names = momentum_names(own_.symbols);
    Json json = Json::object();
    for (std::size_t i = 0; i < expressions.size(); ++i) json[names[i]] = written(expressions[i]);
    return json;
  }

  [[nodiscard]] Json names(const std::vector<std::size_t>& coordinates) const {
    Json array = Json::array();
    for (const std::size_t i : coordinates) array.push_back(coordinate(i));
    return array;
  }

  void write_energies() {
    const auto part = [&](const std::optional<Expression>& e) {
      return optional(e, "The scene gives only its Lagrangian, so T and V are not known apart.");
    };
    attempt("T", [&] { return part(own_.kinetic_energy); });
    attempt("V", [&] { return part(own_.potential_energy); });
    body_["L"] = written(own_.lagrangian);
  }

  [[nodiscard]] Json implicit(const EquationsOfMotion& equations) const {
    Json array = Json::array();
    for (std::size_t i = 0; i < equations.equations.size(); ++i) {
      const Equation& e = equations.equations[i];
      array.push_back({{"coordinate", coordinate(i)},
                       {"equation", print_equation(e.left, e.right, form_, notation_)},
                       {"left", written(e.left)},
                       {"right", written(e.right)},
                       {"divided_by", written(e.divided_by)}});
    }
    return array;
  }

  [[nodiscard]] Json accelerations(const EquationsOfMotion& equations) const {
    const std::vector<Expression> solution = solved_on_constraints(augmented(equations, own_), own_);
    if (solution.empty()) throw Error(ErrorCode::not_applicable, why_too_long());
    Json json = Json::object();
    const std::size_t n = model_.degrees_of_freedom();
    for (std::size_t i = 0; i < n; ++i) json[coordinate(i) + "_ddot"] = written(solution[i]);
    for (std::size_t i = n; i < solution.size(); ++i)
      json[multiplier_name(model_.scene.constraints[i - n])] = written(solution[i]);
    return json;
  }

  /// What the equations of motion are to be solved with.
  [[nodiscard]] Json constraints() const {
    const Expression zero = own_.graph->number(0);
    Json array = Json::array();
    for (std::size_t j = 0; j < own_.constraints.size(); ++j) {
      const ConstraintEquation& constraint = own_.constraints[j];
      array.push_back({{"name", model_.scene.constraints[j].name},
                       {"kind", constraint.position ? "holonomic" : "velocities"},
                       {"equation", print_equation(constraint.position.value_or(constraint.rate), zero, form_,
                                                   notation_)},
                       {"multiplier", written(own_.symbols.multipliers[j])},
                       {"unit", model_.parsed.constraints[j].multiplier_unit}});
    }
    return array;
  }

  [[nodiscard]] Json matrix(const Matrix& entries) const {
    Json array = Json::array();
    for (const auto& row : entries) {
      Json line = Json::array();
      for (const Expression& entry : row) line.push_back(written(entry));
      array.push_back(std::move(line));
    }
    return array;
  }

  [[nodiscard]] Json reduced() const {
    const auto found = routhian(own_);
    if (!found) {
      const std::size_t ignored = ignorable_coordinates(own_).size();
      const bool has_others = ignored > 0 && ignored < model_.degrees_of_freedom();
      throw Error(ErrorCode::not_applicable,
                  has_others ? without_momenta() : "There is no ignorable coordinate to leave others with.");
    }
    Json rates = Json::object();
    for (std::size_t k = 0; k < found->ignored.size(); ++k) {
      rates[coordinate(found->ignored[k]) + "_dot"] = written(found->rates[k]);
    }
    return {{"R", written(found->routhian)}, {"ignored", names(found->ignored)}, {"rates", std::move(rates)}};
  }

  [[nodiscard]] Json conserved() {
    const std::vector<ConservedQuantity> known = conserved_quantities(own_, model_.scene);
    const FoundQuantities found = found_quantities(model_, own_, {}, known);
    Json array = Json::array();
    for (const auto* quantities : {&known, &found.quantities}) {
      for (const ConservedQuantity& quantity : *quantities)
        array.push_back({{"name", quantity.name}, {"value", written(quantity.value)}, {"why", quantity.why}});
    }
    if (!found.is_complete) reasons_["conserved"] = search_given_up;
    if (const std::string why = why_energy_changes(own_); !why.empty())
      reasons_["energy_not_conserved"] = why;
    return array;
  }

  [[nodiscard]] Json validity() const {
    Json array = Json::array();
    for (std::size_t i = 0; i < model_.validity.size(); ++i) {
      const ValidityCondition& condition = model_.scene.valid_while[i];
      array.push_back(
          {{"name", condition.name}, {"value", written(model_.validity[i])}, {"message", condition.message}});
    }
    return array;
  }

  [[nodiscard]] Json dimensionless() const {
    if (model_.scene.without_units)
      throw Error(ErrorCode::not_applicable, "The scene has no units: it is dimensionless as it is.");
    if (model_.has_constraints())
      throw Error(ErrorCode::not_applicable, "It is not written for scenes with constraints.");
    const auto form = dimensionless_form(model_.scene, model_.parsed, own_);
    if (!form)
      throw Error(ErrorCode::not_applicable, "The parameters do not span the dimensions of the scene.");
    Json groups = Json::object();
    for (const DimensionlessGroup& group : form->groups) groups[group.name] = written(group.value);
    Json units = Json::array();
    for (const Expression& unit : form->units) units.push_back(written(unit));
    std::vector<Expression> reduced;
    for (const Expression& rate : own_.symbols.coordinates.rate)
      reduced.push_back(simplify(differentiate(form->lagrangian, rate)));
    return {{"set_to_one", std::move(units)},
            {"groups", std::move(groups)},
            {"energy_unit", written(form->energy_unit)},
            {"time_unit", written(form->time_unit)},
            {"L", written(form->lagrangian)},
            {"momenta", momenta(reduced)}};
  }

  const Model& model_;
  Form form_;
  Notation notation_;
  Lagrangian own_;  ///< on a graph of its own
  Json body_ = Json::object();
  Json reasons_ = Json::object();
};

Response answer_equations(const Resolved<EquationsRequest>& resolved, Call& call, Models& models) {
  const auto& [request, echo] = resolved;
  const std::shared_ptr<const Dynamics> dynamics = models.of(request.system);
  const std::string kept_as = "equations/" + std::to_string(static_cast<int>(request.form));
  const Json body = models.remembered(*request.system.scene, kept_as, [&, &request = request] {
    return EquationsAnswer(dynamics->model(), request.form).body();
  });
  call.timing.lap("solve");
  return written_answer(call, dynamics->model().scene, echo, body);
}

}  // namespace

Endpoint equations_endpoint() {
  return {.name = "equations",
          .help = "Lagrangian, equations of motion and what is conserved",
          .question = question(equations_table(), answer_equations),
          .other_names = {"equation", "eq", "eqs", "eom", "equations_of_motion", "lagrangian", "hamiltonian",
                          "derive"}};
}

}  // namespace qdot::api
