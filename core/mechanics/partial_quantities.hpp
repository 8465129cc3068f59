#pragma once
// What a scene is written with, where it may have no value although its equations have one: the force of a
// potential log(x) is 1/x on both sides of 0, and a root of x in a position leaves 1/x in the kinetic energy.
// A place belongs to the scene only where all of these have values.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

struct PartialQuantity {
  std::string name;  ///< "L", "the position of bob"
  Expression value;  ///< in t, q, q', the parameters and inputs
};

/// Those with a logarithm, a root, an inverse sine or cosine, or a parameter in a denominator.
[[nodiscard]] std::vector<PartialQuantity> partial_quantities(const ParsedScene& scene,
                                                              const Lagrangian& lagrangian);

/// "L and the position of bob": what has no finite value there. Quantities that contain an input are not
/// asked, without a time those that contain it. Empty where all have values.
[[nodiscard]] std::string without_value(const std::vector<PartialQuantity>& quantities,
                                        const Symbols& symbols, std::span<const double> parameters,
                                        std::optional<double> t, std::span<const double> y);

}  // namespace qdot
