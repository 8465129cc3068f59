#include "core/expr/print/print.hpp"

#include "core/base/error.hpp"
#include "core/expr/print/forms.hpp"

namespace qdot {

std::string bounded(std::string written) {
  if (written.size() <= longest_print) return written;
  throw Error(ErrorCode::too_large, "the formula is too long to be written out");
}

bool takes_inner_exponent(Function function) {
  return function != Function::exp && function != Function::log && function != Function::abs &&
         function != Function::sign;
}

bool is_bare(const Layout& layout, NodeId argument, bool bracket_follows) {
  return std::holds_alternative<Symbol>(layout.graph().node(argument)) && !bracket_follows;
}

std::string print(const Expression& e, Form form, const Notation& notation) {
  const Layout layout(e, notation);
  switch (form) {
    case Form::latex:
      return latex_form(layout, e.id(), notation);
    case Form::mathml:
      return mathml_form(layout, e.id());
    case Form::text:
    case Form::sympy:
    case Form::maxima:
    case Form::c:
      return linear_form(layout, e.id(), form);
  }
  return {};
}

}  // namespace qdot
