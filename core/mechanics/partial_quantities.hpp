#pragma once
// What a scene is written with, where it may have no value although its equations have one: the force of a
// potential log(x) is 1/x on both sides of 0, and a root of x in a position leaves 1/x in the kinetic energy.
// A place belongs to the scene only where all of these have values. At a pole rounding leaves finite ones, so
// that what may have poles has to have a bound, too.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mechanics/lagrangian.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

struct PartialQuantity {
  std::string name;  ///< "L", "the position of bob"
  Expression value;  ///< in t, q, q', the parameters and inputs
  bool may_have_poles{};
  std::vector<Expression> of_parameters{};  ///< roots, denominators and so on that consist of them alone
};

/// Those with a logarithm, a root, an inverse sine or cosine, a tangent, or a denominator, be it only a
/// parameter.
[[nodiscard]] std::vector<PartialQuantity> partial_quantities(const ParsedScene& scene,
                                                              const Lagrangian& lagrangian);

/// "L and the position of bob": what has no finite value there, as far as y is known. Quantities that contain
/// an input are not asked, without a time those that contain it. Empty where all have values.
[[nodiscard]] std::string without_value(const std::vector<PartialQuantity>& quantities,
                                        const Symbols& symbols, const Reals& parameters,
                                        std::optional<double> t, const Reals& y);

/// A part of a quantity that consists of parameters alone and has no finite value: in no state has that one.
/// What contains the parameter number `varied` is not asked.
struct MissingPart {
  std::string name;
  Expression part;
};
[[nodiscard]] std::optional<MissingPart> part_without_value(const std::vector<PartialQuantity>& quantities,
                                                            const Symbols& symbols, const Reals& parameters,
                                                            std::optional<std::size_t> varied = {});

}  // namespace qdot
