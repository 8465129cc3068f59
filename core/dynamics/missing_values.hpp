#pragma once
// States in which something that the scene is written with has no value (core/mechanics/
// partial_quantities.hpp): no motion passes them, and nothing rests there, whatever the equations say.

#include <optional>
#include <span>
#include <string>

#include "core/mechanics/model.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

/// "L and the position of bob"; empty where all have values. Without a time what contains it is not asked.
[[nodiscard]] std::string missing_values(const Model& model, const Reals& parameters, std::optional<double> t,
                                         const Reals& y);

/// Throws Error(invalid_state) where something has no value.
void refuse_missing_values(const Model& model, const Reals& parameters, std::optional<double> t,
                           const Reals& y);

/// Something has no value at y, nor at the ends of what it is enclosed by: y +- errors.
[[nodiscard]] bool lacks_values(const Model& model, std::span<const double> parameters,
                                std::span<const double> y, std::span<const double> errors);

}  // namespace qdot
