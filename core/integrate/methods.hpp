#pragma once
// The methods of integration there are. A method is added by writing its stepper and by its name and its
// record here; requests, documents, checks and measurements take names and properties from here.

#include <memory>
#include <span>
#include <string_view>

#include "core/integrate/stepper.hpp"

namespace qdot {

/// - taylor: Taylor series of order 16 or 20. It takes the fewest and longest steps, its polynomial is the
///   dense output, and it keeps round-off low.
/// - erk: ARKODE, order 8, the fastest of the three of SUNDIALS on small oscillating systems.
///   A row of the grid costs it 12 evaluations, and watching events about 10 a step.
/// - adams: CVODE, order 1 to 12, with the fewest evaluations of these three.
/// - bdf: CVODE, order 1 to 5, for stiff systems (strong damping).
/// - gauss: implicit Gauss collocation of order 6 with a fixed step.
///   It is symplectic in canonical variables, so that energy errors stay bounded however long the motion.
/// The best is the first, and what a request gets that chooses none.
enum class Method { taylor, erk, adams, bdf, gauss };

struct MethodRecord {
  Method method{};
  std::string_view name;                                     ///< "taylor"
  std::string_view summary;                                  ///< a clause: "Taylor series of order 16 or 20"
  enum class Step { adaptive, fixed } step{Step::adaptive};  ///< fixed: of length h, without tolerances
  /// Of the right-hand side, beside its values: RightHandSide::jacobian and so on. By an expansion steps are
  /// polynomials and can be bounded; canonical variables are used where there are any.
  enum class Needs { nothing, jacobian, expansion, canonical_form } needs{Needs::nothing};
  double relative_cost{1};  ///< of a motion to the same tolerances, roughly; taylor's is 1
  /// Throws std::invalid_argument where the right-hand side or the request lacks what the method needs.
  std::unique_ptr<Stepper> (*make)(const RightHandSide& system, const RunRequest& request){};

  [[nodiscard]] bool has_fixed_step() const { return step == Step::fixed; }
  [[nodiscard]] bool expands() const { return needs == Needs::expansion; }
};

/// All of them, the best first.
[[nodiscard]] std::span<const MethodRecord> methods();

[[nodiscard]] const MethodRecord& record_of(Method method);

/// The method that request.method names. Both arguments must outlive the stepper. Throws
/// std::invalid_argument for tolerances that are not positive and for what the method lacks: bdf a Jacobian,
/// taylor an expansion, gauss h > 0.
[[nodiscard]] std::unique_ptr<Stepper> make_stepper(const RightHandSide& system, const RunRequest& request);

}  // namespace qdot
