#include "api/answers/endpoints.hpp"

#include <algorithm>
#include <array>

#include "api/answers/accuracy/request.hpp"
#include "api/answers/bifurcations/request.hpp"
#include "api/answers/embedded.hpp"
#include "api/answers/energy/request.hpp"
#include "api/answers/equations/request.hpp"
#include "api/answers/equilibria/request.hpp"
#include "api/answers/gait/request.hpp"
#include "api/answers/modes/request.hpp"
#include "api/answers/simulate/request.hpp"
#include "api/answers/turning_points/request.hpp"

namespace qdot::api {

std::span<const Endpoint> endpoints() {
  static const std::array all{
      equations_endpoint(),  energy_endpoint(),         modes_endpoint(),
      equilibria_endpoint(), turning_points_endpoint(), gait_endpoint(),
      simulate_endpoint(),   accuracy_endpoint(),       bifurcations_endpoint(),
  };
  return all;
}

std::string address_of(const Endpoint& endpoint) { return "/v1/" + std::string(endpoint.name); }

const Endpoint* endpoint_at(std::string_view address) {
  const auto found =
      std::ranges::find_if(endpoints(), [&](const Endpoint& e) { return address_of(e) == address; });
  return found == endpoints().end() ? nullptr : &*found;
}

Json description_of(const Endpoint& endpoint) {
  return Json::parse(text_of(endpoint_files(), std::string(endpoint.name) + ".json"));
}

}  // namespace qdot::api
