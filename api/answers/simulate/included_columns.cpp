#include "api/answers/simulate/included_columns.hpp"

#include <array>
#include <map>
#include <set>
#include <utility>

namespace qdot::api {
namespace {

/// A column with the name that it gets where its usual one is taken.
struct Candidate {
  qdot::Column column;
  std::string longer;
};
using Candidates = std::vector<Candidate>;

/// Who comes first keeps the usual name.
constexpr std::array by_precedence{Extra::multipliers,    Extra::validity,        Extra::positions,
                                   Extra::accelerations,  Extra::momenta,         Extra::energy,
                                   Extra::kinetic_energy, Extra::potential_energy};

void append(Candidates& candidates, const std::vector<qdot::Column>& columns, const std::string& prefix) {
  for (const qdot::Column& column : columns) candidates.push_back({column, prefix + column.name});
}

void append_momenta(Candidates& candidates, const Model& model) {
  const std::vector<qdot::Column> columns = momentum_columns(model);
  for (std::size_t i = 0; i < columns.size(); ++i)
    candidates.push_back({columns[i], "momentum_" + model.scene.coordinates[i].name});
}

Candidates candidates_of(const Model& model, Extra extra) {
  Candidates found;
  switch (extra) {
    case Extra::energy:
      if (model.energy) return {{{"energy", "J", *model.energy}, "total_energy"}};
      return {{{"h", "J", model.jacobi}, "jacobi_integral"}};
    case Extra::kinetic_energy:
      if (const auto& kinetic = model.lagrangian.kinetic_energy)
        found.push_back({{"T", "J", *kinetic}, "kinetic_energy"});
      break;
    case Extra::potential_energy:
      if (const auto& potential = model.lagrangian.potential_energy)
        found.push_back({{"V", "J", *potential}, "potential_energy"});
      break;
    case Extra::momenta:
      append_momenta(found, model);
      break;
    case Extra::positions:
      append(found, position_columns(model), "position_");
      break;
    case Extra::accelerations:
      append(found, acceleration_columns(model), "acceleration_");
      break;
    case Extra::multipliers:
      append(found, multiplier_columns(model), "multiplier_");
      break;
    case Extra::validity:
      append(found, validity_columns(model), "condition_");
      append(found, report_columns(model), "report_");
      break;
  }
  return found;
}

std::set<std::string> names_of_state(const Scene& scene) {
  std::set<std::string> names{"t"};
  for (const Coordinate& q : scene.coordinates) names.insert({q.name, q.name + "_dot"});
  return names;
}

/// `longer`, or with a number behind it where even that is taken.
std::string free_name(const std::string& longer, std::set<std::string>& taken) {
  std::string name = longer;
  for (int i = 2; !taken.insert(name).second; ++i) name = longer + "_" + std::to_string(i);
  return name;
}

}  // namespace

IncludedColumns included_columns(const Model& model, const std::vector<Extra>& include) {
  if (include.empty()) return {};
  std::map<Extra, IncludedColumns> named;
  std::set<std::string> taken = names_of_state(model.scene);
  for (const Extra extra : by_precedence) {
    for (Candidate& candidate : candidates_of(model, extra)) {
      std::string& name = candidate.column.name;
      if (!taken.insert(name).second) {
        const std::string usual = std::exchange(name, free_name(candidate.longer, taken));
        named[extra].notes.push_back("The name " + usual + " is taken in this scene: the column '" + name +
                                     "' is what would be called so.");
      }
      named[extra].columns.push_back(std::move(candidate.column));
    }
  }
  IncludedColumns result;
  for (const Extra extra : include) {
    const IncludedColumns& more = named[extra];
    result.columns.insert(result.columns.end(), more.columns.begin(), more.columns.end());
    result.notes.insert(result.notes.end(), more.notes.begin(), more.notes.end());
  }
  return result;
}

}  // namespace qdot::api
