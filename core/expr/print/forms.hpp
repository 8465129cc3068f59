#pragma once
// The printers behind print(): one-line forms, and the two that draw fraction bars and roots.

#include <string>

#include "core/expr/print/layout.hpp"
#include "core/expr/print/print.hpp"

namespace qdot {

/// Form::text, sympy, maxima or c.
[[nodiscard]] std::string linear_form(const Layout& layout, NodeId id, Form form);
[[nodiscard]] std::string latex_form(const Layout& layout, NodeId id, const Notation& notation);
[[nodiscard]] std::string mathml_form(const Layout& layout, NodeId id);

/// Whether f^n(x) is a usual way to write f(x)^n: sin^2(x).
[[nodiscard]] bool takes_inner_exponent(Function function);

/// Whether an argument may stand without brackets, sin x: a symbol, and no factor in brackets follows.
[[nodiscard]] bool is_bare(const Layout& layout, NodeId argument, bool bracket_follows);

/// `written`, unless it passes longest_print.
[[nodiscard]] std::string bounded(std::string written);

}  // namespace qdot
