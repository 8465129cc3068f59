#pragma once
// The printers behind print(): one-line forms, and the two that draw fraction bars and roots.

#include <string>

#include "core/expr/print.hpp"
#include "core/expr/print_layout.hpp"

namespace qdot {

/// Form::text, sympy, maxima or c.
[[nodiscard]] std::string linear_form(const Layout& layout, NodeId id, Form form);
[[nodiscard]] std::string latex_form(const Layout& layout, NodeId id, const Notation& notation);
[[nodiscard]] std::string mathml_form(const Layout& layout, NodeId id);

/// `written`, unless it passes longest_print.
[[nodiscard]] std::string bounded(std::string written);

}  // namespace qdot
