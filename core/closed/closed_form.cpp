#include "core/closed/closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/expr/print/print.hpp"
#include "core/mechanics/notation.hpp"

namespace qdot {
namespace {

bool speaks_only_of(const Expression& e, std::span<const Expression> symbols,
                    std::span<const Expression> allowed) {
  const NodeId root = e.id();
  const auto is = [](NodeId id) { return [id](const Expression& symbol) { return symbol.id() == id; }; };
  for (const NodeId id : reachable(e.graph(), {&root, 1})) {
    const auto* symbol = std::get_if<Symbol>(&e.graph().node(id));
    if (symbol == nullptr || symbol->name == "pi") continue;
    if (std::ranges::none_of(symbols, is(id)) && std::ranges::none_of(allowed, is(id))) return false;
  }
  return true;
}

std::vector<std::string> assumptions(const ExactValues& values, const Expression& e,
                                     const Relations& relations) {
  const Notation notation = notation_of(values.model().scene);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < values.symbols().size(); ++i) {
    const Expression& p = values.symbols()[i];
    const std::string& name = values.model().scene.parameters[i].name;
    const ExponentValues& put_in = values.model().parsed.exponents.put_in;
    if (const auto exponent = put_in.find(name); exponent != put_in.end()) {
      found.push_back(name + " = " + print(e.graph().number(exponent->second), Form::text));
    } else if (values.parameters()[i] == 0) {
      found.push_back(name + " = 0");
    } else if (depends_on(e, p)) {
      found.push_back(name + (values.parameters()[i] > 0 ? " > 0" : " < 0"));
    }
  }
  for (const auto& [symbol, value] : relations.replacements)
    found.push_back(print(symbol, Form::text) + " = " + print(value, Form::text, notation));
  return found;
}

}  // namespace

void assume_signs(ClosedForm& form, const ExactValues& values, const Expression& e,
                  std::span<const Expression> symbols) {
  for (const Expression& symbol : symbols) {
    if (depends_on(e, symbol))
      form.assumes.push_back(print(symbol, Form::text) + (values.sign(symbol) < 0 ? " < 0" : " > 0"));
  }
}

bool agrees(const Real& formula, double number, double error) {
  const double rounding = std::numeric_limits<double>::epsilon() * std::abs(number);
  return formula.is_finite() &&
         std::abs((formula.value - number) + formula.low) <= error + formula.error + rounding;
}

std::optional<ClosedForm> closed_form(const ExactValues& values, const Expression& e,
                                      const Relations& relations, std::span<const Expression> allowed) {
  if (written_length(e) > longest_closed_form || !speaks_only_of(e, values.symbols(), allowed))
    return std::nullopt;
  const Notation notation = notation_of(values.model().scene);
  return ClosedForm{print(e, Form::text, notation), print(e, Form::latex, notation),
                    assumptions(values, e, relations)};
}

}  // namespace qdot
