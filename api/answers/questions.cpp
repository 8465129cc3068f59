#include "api/answers/questions.hpp"

#include <array>

#include "api/answers/accuracy/request.hpp"
#include "api/answers/bifurcations/request.hpp"
#include "api/answers/energy/request.hpp"
#include "api/answers/equations/request.hpp"
#include "api/answers/equilibria/request.hpp"
#include "api/answers/gait/request.hpp"
#include "api/answers/modes/request.hpp"
#include "api/answers/simulate/request.hpp"
#include "api/answers/turning_points/request.hpp"

namespace qdot::api {

std::span<const Endpoint> questions() {
  static const std::array all{
      equations_endpoint(),  energy_endpoint(),         modes_endpoint(),
      equilibria_endpoint(), turning_points_endpoint(), gait_endpoint(),
      simulate_endpoint(),   accuracy_endpoint(),       bifurcations_endpoint(),
  };
  return all;
}

}  // namespace qdot::api
