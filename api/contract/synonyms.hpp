#pragma once
// "Did you mean" for the symbols of a system: what people call a coordinate, a velocity or a parameter when
// they have not looked it up.

#include <span>
#include <string>
#include <string_view>

#include "api/contract/symbol.hpp"

namespace qdot::api {

/// The symbol that was meant, empty where none is likely. In this order:
///   theta0, theta_initial            a symbol with a mark of the initial state;
///   dtheta, thetadot, v_theta        the velocity of a coordinate;
///   omega, w, v, v0                  the first symbol in rad/s, or velocity in m/s;
///   mass, length, stiffness, gravity the word that a symbol's meaning begins with, or one near there.
[[nodiscard]] std::string meant_symbol(std::string_view name, std::span<const Symbol> symbols);

/// "theta'" as "theta_dot": the prime or the point that books have for a velocity, in letters.
[[nodiscard]] std::string with_dot_for_prime(std::string_view name);

/// For a message about such a name.
inline constexpr std::string_view advice_on_friction =
    " A scene of your own has it in 'dissipation' and 'forces'; GET /v1/scene-schema says how.";

/// Whether the name is that of friction, which no system of the catalogue has.
[[nodiscard]] bool names_friction(std::string_view name);

}  // namespace qdot::api
