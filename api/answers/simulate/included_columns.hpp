#pragma once
// The columns that `include` asks for, each with a name of its own.

#include <string>
#include <vector>

#include "api/answers/simulate/request.hpp"
#include "core/dynamics/columns.hpp"

namespace qdot::api {

struct IncludedColumns {
  std::vector<qdot::Column> columns;
  std::vector<std::string> notes;  ///< on those that have not their usual name
};

/// A scene's own names stay: those of coordinates and velocities, multipliers, conditions and reports, and
/// places. A quantity whose usual name (T, V, energy, h, p_x) is among them gets a longer one, as does a
/// condition, a report or a place that is called as something before it. Names depend on the scene alone,
/// not on what else is asked for.
[[nodiscard]] IncludedColumns included_columns(const Model& model, const std::vector<Extra>& include);

}  // namespace qdot::api
