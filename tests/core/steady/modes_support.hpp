#pragma once
// Normal modes as tests ask for them, and what they are held against.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/steady/modes.hpp"
#include "tests/support/motions.hpp"

namespace qdot::test {

/// What every frequency and shape must agree to, relative; and what the error bound must stay under.
inline constexpr double promised = 1e-12;
inline constexpr double tight = 1e-15;

inline Modes modes_of(const std::shared_ptr<const Model>& model, const Values& given,
                      const std::optional<std::vector<double>>& guess = std::nullopt) {
  const std::vector<double> parameters = parameter_values(*model, given);
  return normal_modes(Dynamics(model), parameters, initial_state(*model, parameters, given), guess);
}
inline Modes modes_of(const std::string& system, const Values& given = {},
                      const std::optional<std::vector<double>>& guess = std::nullopt) {
  return modes_of(model_of(system), given, guess);
}

/// Kinds in order, "rigid oscillation".
inline std::string kinds(const Modes& found) {
  std::string text;
  for (const Mode& mode : found.modes) text += (text.empty() ? "" : " ") + std::string(name(mode.kind));
  return text;
}

/// Within the stated error, and that small.
inline void expect_omega(const Mode& mode, double expected, double relative = promised) {
  EXPECT_EQ(mode.kind, ModeKind::oscillation);
  EXPECT_NEAR(mode.omega, expected, relative * expected);
  ASSERT_TRUE(mode.omega_error);
  EXPECT_LE(*mode.omega_error, tight * mode.omega);
}

inline void expect_shape(const Mode& mode, const std::vector<double>& expected, double tolerance = promised) {
  ASSERT_EQ(mode.shape.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(mode.shape[i].real(), expected[i], tolerance * std::abs(expected[i])) << i;
    EXPECT_EQ(mode.shape[i].imag(), 0) << i;
  }
}

}  // namespace qdot::test
