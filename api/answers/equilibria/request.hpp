#pragma once
// /v1/equilibria: all equilibria and steady motions with their stability; or with `solve_for`, the value of a
// parameter or of an ignorable coordinate's velocity that makes a position an equilibrium.

#include <optional>
#include <string>

#include "api/answers/endpoint.hpp"

namespace qdot::api {

struct EquilibriaRequest {
  /// Its `position` belongs to `solve_for`; without one, the coordinates that `initial` gives are it.
  SystemChoice system{};
  std::optional<std::string> solve_for{};
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<EquilibriaRequest>& equilibria_table();

[[nodiscard]] Endpoint equilibria_endpoint();

}  // namespace qdot::api
