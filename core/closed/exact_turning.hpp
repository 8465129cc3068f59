#pragma once
// The equation of the turning points with the initial state put in, and its roots where it is a linear or
// quadratic polynomial of the coordinate, of its cosine or of its sine:
//
//   U(x; p) - h = 0,   p_c the momenta of the ignored coordinates, h = 1/2 A(x0) x0'^2 + U(x0; p)
//
// and the period where it is elementary (exact_period.hpp). Where the initial state is known by decimals
// only, formulas are written with h and p_c themselves.

#include "core/closed/closed_form.hpp"
#include "core/closed/exact_extrema.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/turning/turning_points.hpp"

namespace qdot {

struct ExactTurningPoints {
  std::optional<ClosedForm> equation{};  ///< "left = 0"
  std::optional<ExactExtremum> maximum{}, minimum{};
  std::optional<ClosedForm> energy{};                ///< h
  std::vector<std::optional<ClosedForm>> momenta{};  ///< of the ignored coordinates, in order
  std::optional<ClosedForm> period{};
};

/// Of turning points by the energy integral. `energy_name`: what h is called.
[[nodiscard]] ExactTurningPoints exact_turning_points(const Dynamics& dynamics, const Reals& parameters,
                                                      const WrittenTexts& written, const TurningPoints& found,
                                                      const std::string& energy_name);

}  // namespace qdot
