#pragma once
// POST and GET /v1/modes: small oscillations about an equilibrium.

#include <optional>

#include "api/contract/request_table.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {

struct ModesRequest {
  SystemChoice system{};  ///< its `equilibrium` says which one; empty: the stable one nearest to `initial`
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<ModesRequest>& modes_table();

}  // namespace qdot::api
