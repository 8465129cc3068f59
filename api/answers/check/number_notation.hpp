#pragma once
// Numbers as students write them, brought into the notation in which requests have theirs:
//
//   \theta_{max} = 55{,}13^\circ       55.13deg, of the name theta_max
//   9.81 × 10⁻³ N m                    9.81 * 10^-3 N m
//   3 π/4, 2√2, 0.31pi                 3 *pi/4, 2*sqrt(2), 0.31*pi
//
// What has two readings (1,234 and 0·962) is refused with what to write instead.

#include <string>
#include <string_view>

namespace qdot::api {

struct WrittenNumber {
  std::string name{};     ///< what stands before an equals sign; empty: nothing
  std::string text{};     ///< a number, an expression, or one with a unit behind it
  std::string refused{};  ///< why it cannot be read; empty: it can
};

enum class Commas { are_decimal, part_numbers };

/// Without commands of LaTeX and dollar signs, for a whole list as for one number. Throws Error(syntax) and
/// Error(too_large), as without_latex does.
[[nodiscard]] std::string number_without_latex(std::string_view text);

/// One number out of number_without_latex.
[[nodiscard]] WrittenNumber written_number(std::string_view text, Commas commas);

/// Where the unit behind an expression begins: at rad/s in "sqrt(9.81/0.8) rad/s"; npos where there is none.
[[nodiscard]] std::size_t unit_behind(std::string_view text);

}  // namespace qdot::api
