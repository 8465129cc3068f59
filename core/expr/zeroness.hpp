#pragma once
// Whether an expression is zero identically, by algebra: multiplied out with its denominators, in sines and
// cosines of single angles. Where everything in it is independent of everything else, the form is zero
// exactly when the expression is.

#include <cstdint>
#include <optional>

#include "core/expr/polynomial.hpp"

namespace qdot {

enum class Zeroness {
  zero,      ///< identically, wherever it has a value
  not_zero,  ///< proven: a nonzero polynomial in independent functions
  unknown    ///< functions of each other are left, or the algebra grew past `work`
};

/// e times what stands below its bars, multiplied out; none where that grows past `work`.
[[nodiscard]] std::optional<Expression> numerator(const Expression& e, std::uint64_t work = 60'000);

/// That numerator in sines and cosines of single angles; none where it grows past `work`.
[[nodiscard]] std::optional<Polynomial> normal_form(const Expression& e, std::uint64_t work = 60'000);

[[nodiscard]] Zeroness zeroness(const Expression& e, std::uint64_t work = 60'000);

}  // namespace qdot
