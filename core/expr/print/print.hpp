#pragma once
// Writing expressions, in the order a textbook has them.
//
// In a product: the number, parameters in the order of their declaration, coordinates, velocities,
// accelerations, functions, brackets: m*g*l*sin(theta). Negative powers make a quotient: b^2/(2*m*l^2);
// without one a fraction stays in front: 3/4*m*q_dot^2. In a sum: accelerations, then falling degree in the
// velocities, then numbers, then what has no function, short terms before long ones; if that begins with a
// minus, the first positive term goes to the front: 1 - cos(phi), k*(l - l0). The order depends on names and
// the notation only, never on the history of the graph.

#include <span>
#include <string>
#include <string_view>

#include "core/expr/expression.hpp"
#include "core/expr/print/notation.hpp"

namespace qdot {

class Layout;

enum class Form {
  text,    ///< what parse reads back, exactly: parse(print(e)) == e
  latex,   ///< for math mode, without delimiters
  mathml,  ///< one <math> element of MathML Core, UTF-8
  sympy,   ///< Python for SymPy: Rational(3, 4)*m*x**2; names as they are, Python's keywords with a _ behind
  maxima,  ///< 3/4*m*x^2, %pi
  c        ///< C99 with <math.h>: 3.0/4.0*m*x*x; names as they are, C's keywords with a _ behind
};

/// A form is added by its printer (forms.hpp; on one line: languages.cpp) and its record; requests and
/// documents take its name from here.
struct PrintForm {
  Form form{};
  std::string_view name;  ///< "sympy"
  std::string (*print)(const Layout& layout, NodeId id, const Notation& notation){};
  /// Two printed sides as an equation; nullptr: with " = " between them.
  std::string (*equation)(const std::string& left, const std::string& right){};
};

/// All forms, text first.
[[nodiscard]] std::span<const PrintForm> print_forms();

/// Throws Error(too_large) when the form passes `longest_print` bytes (layout.hpp).
[[nodiscard]] std::string print(const Expression& e, Form form, const Notation& notation = {});

/// left = right, as the form has it: "Eq(x, y)" for SymPy. Throws as print does.
[[nodiscard]] std::string print_equation(const Expression& left, const Expression& right, Form form,
                                         const Notation& notation = {});

}  // namespace qdot
