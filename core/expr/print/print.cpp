#include "core/expr/print/print.hpp"

#include <array>

#include "core/base/records.hpp"
#include "core/expr/print/forms.hpp"

namespace qdot {
namespace {

std::string sympy_equation(const std::string& left, const std::string& right) {
  return "Eq(" + left + ", " + right + ")";
}

std::string c_equation(const std::string& left, const std::string& right) { return left + " == " + right; }

/// One <math> element from two.
std::string mathml_equation(const std::string& left, const std::string& right) {
  constexpr std::string_view end = "</math>";
  return left.substr(0, left.rfind(end)) + "<mo>=</mo>" + right.substr(right.find('>') + 1);
}

const PrintForm& record_of(Form form) {
  return record_with(print_forms(), form, &PrintForm::form, "printed form");
}

}  // namespace

std::span<const PrintForm> print_forms() {
  static constexpr std::array forms{
      PrintForm{Form::text, "text", text_form},
      PrintForm{Form::latex, "latex", latex_form},
      PrintForm{Form::mathml, "mathml", mathml_form, mathml_equation},
      PrintForm{Form::sympy, "sympy", sympy_form, sympy_equation},
      PrintForm{Form::maxima, "maxima", maxima_form},
      PrintForm{Form::c, "c", c_form, c_equation},
  };
  return forms;
}

std::string print(const Expression& e, Form form, const Notation& notation) {
  return record_of(form).print(Layout(e, notation), e.id(), notation);
}

std::string print_equation(const Expression& left, const Expression& right, Form form,
                           const Notation& notation) {
  const PrintForm& record = record_of(form);
  const std::string first = print(left, form, notation), second = print(right, form, notation);
  return record.equation == nullptr ? first + " = " + second : record.equation(first, second);
}

}  // namespace qdot
