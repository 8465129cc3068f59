#pragma once
// The elementary functions an expression may call: a closed set.

#include <array>
#include <optional>
#include <string_view>

namespace qdot {

enum class Function { sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, exp, log, abs, sign };

inline constexpr std::array<std::string_view, 13> function_names{
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "abs", "sign"};

[[nodiscard]] constexpr std::string_view name(Function function) {
  return function_names[static_cast<std::size_t>(function)];
}

[[nodiscard]] constexpr std::optional<Function> function_named(std::string_view text) {
  for (std::size_t i = 0; i < function_names.size(); ++i) {
    if (function_names[i] == text) return static_cast<Function>(i);
  }
  return std::nullopt;
}

/// Value by functions that give the same bits on every x86-64 machine (SLEEF's deterministic ones).
[[nodiscard]] double evaluate(Function function, double argument);
/// base^exponent in the same way; whole exponents and halves of them by products and a square root.
[[nodiscard]] double power(double base, double exponent);

}  // namespace qdot
