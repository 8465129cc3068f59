#include "core/integrate/stepper.hpp"

#include <stdexcept>

#include "core/integrate/gauss_stepper.hpp"
#include "core/integrate/sundials_steppers.hpp"
#include "core/integrate/taylor_stepper.hpp"

namespace qdot {

std::unique_ptr<Stepper> make_stepper(const RightHandSide& system, const RunRequest& request) {
  const auto [rtol, atol] = request.tolerances;
  if (!(rtol > 0) || !(atol > 0)) throw std::invalid_argument("tolerances must be positive");
  switch (request.method) {
    case Method::adams:
      return make_adams_stepper(system, request);
    case Method::bdf:
      if (!system.jacobian) throw std::invalid_argument("bdf needs a Jacobian");
      return make_bdf_stepper(system, request);
    case Method::erk:
      return make_erk_stepper(system, request);
    case Method::taylor:
      if (!system.expansion) throw std::invalid_argument("taylor needs an expansion");
      return make_taylor_stepper(system, request);
    case Method::gauss:
      if (!(request.h > 0)) throw std::invalid_argument("gauss needs a step");
      return make_gauss_stepper(system, request);
  }
  throw std::invalid_argument("unknown method");
}

}  // namespace qdot
