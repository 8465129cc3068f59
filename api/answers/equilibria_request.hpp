#pragma once
// POST and GET /v1/equilibria: all equilibria, or with `solve_for` the number that makes a position one.

#include <optional>
#include <string>

#include "api/contract/request_table.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {

struct EquilibriaRequest {
  /// Its `position` belongs to `solve_for`; without one, the coordinates that `initial` gives are it.
  SystemChoice system{};
  std::optional<std::string> solve_for{};
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<EquilibriaRequest>& equilibria_table();

}  // namespace qdot::api
