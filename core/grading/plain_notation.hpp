#pragma once
// Formulas as people write them, brought into one plain notation in ASCII, which student_parser.hpp reads:
//
//   θ̈ + (g/l) sin θ                       theta_ddot + (g/l) sin theta
//   \ddot{\theta}+\frac{g}{l}\sin\theta    theta_ddot + ((g)/(l)) sin theta
//   \frac{d\theta}{dt}                     d/dt(theta)
//
// A line of LaTeX that ends in \\ ends with a line here.

#include <string>
#include <string_view>

namespace qdot {

/// Signs beyond ASCII: Greek letters, dots above letters, superscripts, signs of multiplication. Throws
/// Error(syntax) at any other.
[[nodiscard]] std::string without_unicode(std::string_view text);

/// Commands of LaTeX. Throws Error(syntax) at one that it does not know, and Error(too_large) where they are
/// nested too deep.
[[nodiscard]] std::string without_latex(std::string_view text);

/// Both. Throws Error(too_large) for a text of more than `longest` bytes.
[[nodiscard]] std::string plain_notation(std::string_view text, std::size_t longest = 4096);

}  // namespace qdot
