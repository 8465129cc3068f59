#pragma once
// Where the inertia of one coordinate vanishes or has no bound: no motion passes such a place, whatever the
// speed there, and no formula that was found in sin x or x^2 knows of it.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/expr/calculus.hpp"

namespace qdot {

/// What divides the inertia, or the inertia divides by, to some power: cos x of m cos^2 x. Sums are among
/// them; what does not depend on x is not.
[[nodiscard]] std::vector<Expression> factors_of_inertia(const Expression& inertia, const Expression& x);

/// Places at which one of them vanishes, by the parameters: of angles those about 0. Others may be missing.
[[nodiscard]] std::vector<Expression> places_of_barriers(const std::vector<Expression>& factors,
                                                         const Expression& x);

/// Whether ways come to such places, by numbers.
class Barriers {
 public:
  /// With numbers for `symbols`.
  Barriers(const Expression& inertia, const Expression& x, const std::vector<Expression>& symbols);

  using Meets = std::function<bool(double from, double to, int pieces)>;
  /// Whether the way meets one of those that are seen in so many pieces of it; empty where there are none.
  /// Outlived by this.
  [[nodiscard]] Meets at(std::span<const double> numbers) const;

 private:
  std::optional<CompiledFunction> at_ends_, on_the_way_;
  std::size_t once_{};  ///< so many of the first vanish once
};

}  // namespace qdot
