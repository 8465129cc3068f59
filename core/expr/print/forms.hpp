#pragma once
// The printers behind print(), one a form: one-line forms, and the two that draw fraction bars and roots.
// Each throws Error(too_large) when what it writes passes `longest_print` bytes.

#include <string>

#include "core/expr/print/layout.hpp"

namespace qdot {

[[nodiscard]] std::string text_form(const Layout& layout, NodeId id, const Notation& notation);
[[nodiscard]] std::string sympy_form(const Layout& layout, NodeId id, const Notation& notation);
[[nodiscard]] std::string maxima_form(const Layout& layout, NodeId id, const Notation& notation);
[[nodiscard]] std::string c_form(const Layout& layout, NodeId id, const Notation& notation);
[[nodiscard]] std::string latex_form(const Layout& layout, NodeId id, const Notation& notation);
[[nodiscard]] std::string mathml_form(const Layout& layout, NodeId id, const Notation& notation);

}  // namespace qdot
