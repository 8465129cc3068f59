#pragma once
// Coefficients x_k, in the parameters, with sum x_k e_k = 0 identically: numbers where they are numbers,
// otherwise solved for in the algebra of expressions.

#include <optional>
#include <span>
#include <vector>

#include "core/expr/expression.hpp"
#include "core/symmetry/residue.hpp"

namespace qdot {

/// The same dependence at two draws of the parameters.
struct SampledDependence {
  std::vector<Modular> first, second;
};

/// Whether functions of sums of angles stand as they are, which is shorter, or in those of single angles,
/// which finds more.
enum class AngleForm { as_written, single };

/// One coefficient for each of the expressions, without denominators in the parameters, so that they mean
/// something for all their values. None where they are not found within the work that this may take. What
/// comes out is a proposal: who claims it proves it.
[[nodiscard]] std::optional<std::vector<Expression>> exact_coefficients(
    std::span<const Expression> expressions, const SampledDependence& dependence,
    std::span<const Expression> parameters, AngleForm angles);

}  // namespace qdot
