#pragma once
// The methods of integration there are. A method is added by writing its stepper and its record; requests,
// documents and measurements take names and properties from here.

#include <memory>
#include <span>
#include <string_view>

#include "core/integrate/stepper.hpp"

namespace qdot {

struct MethodRecord {
  Method method{};
  std::string_view name;                                     ///< "taylor"
  std::string_view summary;                                  ///< a clause: "Taylor series of order 16 or 20"
  enum class Step { adaptive, fixed } step{Step::adaptive};  ///< fixed: of length h, without tolerances
  double relative_cost{1};  ///< of a motion to the same tolerances, roughly; taylor's is 1
  /// Throws std::invalid_argument where the right-hand side or the request lacks what the method needs.
  std::unique_ptr<Stepper> (*make)(const RightHandSide& system, const RunRequest& request){};
};

/// All of them, the best first.
[[nodiscard]] std::span<const MethodRecord> methods();

[[nodiscard]] const MethodRecord& record_of(Method method);

/// The method that request.method names. Both arguments must outlive the stepper. Throws
/// std::invalid_argument for tolerances that are not positive and for what the method lacks: bdf a Jacobian,
/// taylor an expansion, gauss h > 0.
[[nodiscard]] std::unique_ptr<Stepper> make_stepper(const RightHandSide& system, const RunRequest& request);

}  // namespace qdot
