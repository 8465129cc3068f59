#pragma once
// POST and GET /v1/energy and /v1/equations: questions that integrate nothing.

#include <optional>

#include "api/contract/request_table.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {

/// Energies, momenta and accelerations at one state.
struct EnergyRequest {
  SystemChoice system{};
  double t{};
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<EnergyRequest>& energy_table();

enum class EquationForm { text, latex, mathml, sympy, maxima, c };

/// Symbols only: parameters and states do not enter.
struct EquationsRequest {
  SystemChoice system{};
  EquationForm form{EquationForm::text};
};

[[nodiscard]] const RequestTable<EquationsRequest>& equations_table();

}  // namespace qdot::api
