#pragma once
// /v1/bifurcations: the values of one parameter, over a range, at which equilibria, or the gaits of a scene
// with an impact, appear, vanish or change their stability.

#include <optional>
#include <string>

#include "api/answers/endpoint.hpp"

namespace qdot::api {

struct BifurcationsRequest {
  SystemChoice system{};
  std::string parameter{};  ///< its name in the scene
  double from{}, to{};      ///< the range that is searched, ends included, in the parameter's unit
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<BifurcationsRequest>& bifurcations_table();

[[nodiscard]] Endpoint bifurcations_endpoint();

}  // namespace qdot::api
