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
///   omega, v                         the only velocity in rad/s, or in m/s;
///   mass, length, stiffness, gravity the word that a symbol's meaning begins with, or one near there.
[[nodiscard]] std::string meant_symbol(std::string_view name, std::span<const Symbol> symbols);

}  // namespace qdot::api
