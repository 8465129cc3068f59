#pragma once
// POST and GET /v1/bifurcations: critical values of one parameter over a range.

#include <optional>
#include <string>

#include "api/contract/request_table.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {

struct BifurcationsRequest {
  SystemChoice system{};
  std::string parameter{};
  double from{}, to{};
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<BifurcationsRequest>& bifurcations_table();

}  // namespace qdot::api
