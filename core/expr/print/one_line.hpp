#pragma once
// The forms that are written on one line: what a programming language differs in is one record.

#include <span>
#include <string>
#include <string_view>

#include "core/expr/print/layout.hpp"

namespace qdot {

/// No member has a default: the compiler asks a new language for each of them.
struct Language {
  enum class Numbers {
    exact,          ///< 1/4, never 0.25
    decimal,        ///< 9.81, where it is exact and shorter than 981/100
    floating_point  ///< the same, and whole ones with a point: 3.0
  };

  std::span<const std::string_view> keywords;  ///< symbols of these names get a _ behind
  std::string_view pi;
  Numbers numbers;
  std::string_view ratio;  ///< the function that makes a number of two integers; empty: 3/4
  std::string_view power;  ///< the operator between base and exponent; empty: pow(x, n), and x*x for x^2
  std::string_view abs;    ///< what abs(#) and sign(#) are in it
  std::string_view sign;
};

/// Throws Error(too_large) when the form passes `longest_print` bytes.
[[nodiscard]] std::string one_line(const Layout& layout, NodeId id, const Language& language);

}  // namespace qdot
