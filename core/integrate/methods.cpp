#include "core/integrate/methods.hpp"

#include <array>
#include <stdexcept>

#include "core/base/records.hpp"
#include "core/integrate/gauss_stepper.hpp"
#include "core/integrate/sundials_steppers.hpp"
#include "core/integrate/taylor_stepper.hpp"

namespace qdot {

std::span<const MethodRecord> methods() {
  using Step = MethodRecord::Step;
  using Needs = MethodRecord::Needs;
  static constexpr std::array records{
      MethodRecord{Method::taylor, "taylor", "Taylor series of order 16 or 20", Step::adaptive,
                   Needs::expansion, 1, make_taylor_stepper},
      MethodRecord{Method::erk, "erk", "Runge-Kutta of order 8 (ARKODE)", Step::adaptive, Needs::nothing, 5,
                   make_erk_stepper},
      MethodRecord{Method::adams, "adams", "multistep of order 1 to 12 (CVODE)", Step::adaptive,
                   Needs::nothing, 10, make_adams_stepper},
      MethodRecord{Method::bdf, "bdf", "multistep of order 1 to 5 for stiff systems (CVODE)", Step::adaptive,
                   Needs::jacobian, 10, make_bdf_stepper},
      MethodRecord{Method::gauss, "gauss", "symplectic collocation of order 6 with a fixed step h",
                   Step::fixed, Needs::canonical_form, 1, make_gauss_stepper},
  };
  return records;
}

const MethodRecord& record_of(Method method) {
  return record_with(methods(), method, &MethodRecord::method, "method");
}

std::unique_ptr<Stepper> make_stepper(const RightHandSide& system, const RunRequest& request) {
  const auto [rtol, atol] = request.tolerances;
  if (!(rtol > 0) || !(atol > 0)) throw std::invalid_argument("tolerances must be positive");
  return record_of(request.method).make(system, request);
}

}  // namespace qdot
