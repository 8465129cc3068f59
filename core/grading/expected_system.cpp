#include "core/grading/expected_system.hpp"

#include <algorithm>
#include <array>

#include "core/mechanics/canonical.hpp"

namespace qdot {
namespace {

[[noreturn]] void has_none(std::string_view what) {
  throw Error(ErrorCode::not_applicable, "This system has no " + std::string(what) + " to write out.");
}

Expression required(const std::optional<Expression>& e, std::string_view what) {
  if (!e) has_none(what);
  return *e;
}

}  // namespace

ExpectedSystem::ExpectedSystem(const Model& model) : model_(model), own_(copied(model.lagrangian)) {
  for (const auto& row : model.system.matrix) {
    matrix_.emplace_back();
    for (const Expression& entry : row) matrix_.back().push_back(graph().adopt(entry));
  }
  for (const Expression& e : model.system.right) right_.push_back(graph().adopt(e));
  for (const Expression& e : model.system.unknowns) unknowns_.push_back(graph().adopt(e));
}

void ExpectedSystem::fix(std::size_t parameter, const Expression& value) {
  const Replacement replacement{own_.symbols.parameters[parameter], value};
  for (Replacement& other : fixed_) other.second = substitute(other.second, std::array{replacement});
  fixed_.push_back(replacement);
  for (auto& row : matrix_) {
    for (Expression& entry : row) entry = with_fixed(entry);
  }
  for (Expression& e : right_) e = with_fixed(e);
}

std::vector<ConstraintEquation> ExpectedSystem::constraints() const {
  std::vector<ConstraintEquation> constraints = own_.constraints;
  for (ConstraintEquation& constraint : constraints) {
    if (constraint.position) constraint.position = with_fixed(*constraint.position);
    constraint.rate = with_fixed(constraint.rate);
    for (Expression& slope : constraint.slope) slope = with_fixed(slope);
    constraint.rest = with_fixed(constraint.rest);
  }
  return constraints;
}

std::vector<Expression> ExpectedSystem::plain_multipliers() const {
  std::vector<Expression> plain;
  for (std::size_t j = 0; j < model_.scene.constraints.size(); ++j) {
    if (multiplier_name(model_.scene.constraints[j]).starts_with("lambda"))
      plain.push_back(own_.symbols.multipliers[j]);
  }
  return plain;
}

Expression ExpectedSystem::with_fixed(const Expression& e) const {
  return fixed_.empty() ? e : substitute(e, fixed_);
}

bool ExpectedSystem::speaks_of_fixed(const Expression& e) const {
  return std::ranges::any_of(fixed_, [&](const Replacement& r) { return depends_on(e, r.first); });
}

std::optional<Expression> ExpectedSystem::energy_named(std::string_view name) const {
  if (name == "T") return required(own_.kinetic_energy, "T");
  if (name == "V") return required(own_.potential_energy, "V");
  if (name == "L") return own_.lagrangian;
  if (name == "h") return graph().adopt(model_.jacobi);
  if (name == "E") {
    if (!model_.energy) has_none("E");
    return graph().adopt(*model_.energy);
  }
  if (name == "H") return required(hamiltonian(own_), "H");
  if (name != "R") return std::nullopt;
  const auto reduced = routhian(own_);
  if (!reduced) has_none("R");
  return reduced->routhian;
}

std::optional<Expression> ExpectedSystem::by_coordinate(std::string_view name) const {
  for (std::size_t i = 0; i < degrees_of_freedom(); ++i) {
    const std::string& q = model_.scene.coordinates[i].name;
    if (name == "p_" + q) return graph().adopt(model_.momenta[i]);
    if (name == "Q_" + q) return own_.generalized_forces[i];
    if (name == q + "_ddot") return unknown_written_out(i);
  }
  return std::nullopt;
}

/// Where it is too long to write out, its symbol has the value of the right motion where formulas are
/// compared.
Expression ExpectedSystem::unknown_written_out(std::size_t i) const {
  if (unknowns_.size() > largest_written_system) return unknowns_[i];
  const std::vector<Expression> solution = cramer(matrix_, right_);
  return solution[i];
}

std::optional<Expression> ExpectedSystem::multiplier(std::string_view name) const {
  for (std::size_t j = 0; j < model_.scene.constraints.size(); ++j) {
    if (multiplier_name(model_.scene.constraints[j]) == name)
      return unknown_written_out(degrees_of_freedom() + j);
  }
  return std::nullopt;
}

std::optional<Expression> ExpectedSystem::condition(std::string_view name) const {
  for (std::size_t i = 0; i < model_.validity.size(); ++i) {
    if (model_.scene.valid_while[i].name == name) return graph().adopt(model_.validity[i]);
  }
  for (std::size_t i = 0; i < model_.reports.size(); ++i) {
    if (model_.scene.reports[i].name == name) return graph().adopt(model_.reports[i]);
  }
  return std::nullopt;
}

std::optional<Expression> ExpectedSystem::quantity(std::string_view name) const {
  std::optional<Expression> found = energy_named(name);
  if (!found) found = by_coordinate(name);
  if (!found) found = multiplier(name);
  if (!found) found = condition(name);
  return found ? std::optional(with_fixed(*found)) : std::nullopt;
}

bool ExpectedSystem::is_ambiguous(std::string_view name) const {
  const std::vector<std::string> names = quantity_names();
  const std::size_t own =
      model_.scene.constraints.size() + model_.scene.valid_while.size() + model_.scene.reports.size();
  const auto first_own = names.end() - static_cast<std::ptrdiff_t>(own);
  return std::find(names.begin(), first_own, name) != first_own &&
         std::find(first_own, names.end(), name) != names.end();
}

std::vector<std::string> ExpectedSystem::quantity_names() const {
  std::vector<std::string> names{"T", "V", "L", "E", "h", "H", "R"};
  for (const Coordinate& q : model_.scene.coordinates) {
    for (const std::string& name : {"p_" + q.name, "Q_" + q.name, q.name + "_ddot"}) names.push_back(name);
  }
  for (const Constraint& constraint : model_.scene.constraints) names.push_back(multiplier_name(constraint));
  for (const ValidityCondition& condition : model_.scene.valid_while) names.push_back(condition.name);
  for (const Report& report : model_.scene.reports) names.push_back(report.name);
  return names;
}

std::vector<Expression> ExpectedSystem::momenta() const { return momentum_symbols(own_); }

Expression ExpectedSystem::with_momenta(const Expression& e) const {
  const std::vector<Expression> symbols = momenta();
  if (!depends_on(e, symbols)) return e;
  std::vector<Replacement> replacements;
  for (std::size_t i = 0; i < symbols.size(); ++i)
    replacements.emplace_back(symbols[i], with_fixed(graph().adopt(model_.momenta[i])));
  return substitute(e, replacements);
}

std::vector<SymbolDomain> ExpectedSystem::domains() const {
  std::vector<SymbolDomain> domains;
  for (std::size_t i = 0; i < own_.symbols.parameters.size(); ++i) {
    const Expression& parameter = own_.symbols.parameters[i];
    const auto is_this = [&](const Replacement& r) { return r.first == parameter; };
    if (std::ranges::none_of(fixed_, is_this))
      domains.push_back({parameter, model_.scene.parameters[i].domain});
  }
  const Symbols::Varying& q = own_.symbols.coordinates;
  for (std::size_t i = 0; i < q.value.size(); ++i)
    domains.push_back({q.value[i], model_.scene.coordinates[i].domain});
  for (const Expression& rate : q.rate) domains.push_back({rate, {}});
  for (const Expression& p : momenta()) domains.push_back({p, {}});
  const Symbols::Varying& inputs = own_.symbols.inputs;
  for (const auto* group : {&inputs.value, &inputs.rate, &inputs.second_rate}) {
    for (const Expression& symbol : *group) domains.push_back({symbol, {}});
  }
  domains.push_back({own_.symbols.t, {}});
  return domains;
}

}  // namespace qdot
