#include <algorithm>
#include <cctype>

#include "core/expr/print/forms.hpp"

namespace qdot {
namespace {

std::string latex_brackets(const std::string& latex) { return "\\left(" + latex + "\\right)"; }

std::string latex_group(const std::string& latex) { return "{" + latex + "}"; }

/// A number in front: 3, 9.81, 1.5 \cdot 10^{-7}.
std::string number_text(const Number& value) {
  std::string text = decimal_text(value);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  return text.substr(0, e) + " \\cdot 10^{" + std::to_string(std::stoi(text.substr(e + 1))) + "}";
}

std::string fraction_text(const Number& over, const Number& under) {
  if (under.is_one()) return number_text(over);
  return "\\frac" + latex_group(number_text(over)) + latex_group(number_text(under));
}

std::string_view command(Function function) {
  switch (function) {
    case Function::sin:
      return "\\sin";
    case Function::cos:
      return "\\cos";
    case Function::tan:
      return "\\tan";
    case Function::asin:
      return "\\arcsin";
    case Function::acos:
      return "\\arccos";
    case Function::atan:
      return "\\arctan";
    case Function::sinh:
      return "\\sinh";
    case Function::cosh:
      return "\\cosh";
    case Function::tanh:
      return "\\tanh";
    case Function::exp:
      return "\\exp";
    case Function::log:
      return "\\ln";
    case Function::abs:
      return "\\operatorname{abs}";
    case Function::sign:
      return "\\operatorname{sgn}";
  }
  return "";
}

/// A factor, and what its neighbours must know of it.
struct LatexPiece {
  std::string latex;
  bool bracket{false};  ///< begins with a bracket, so a bare argument must not stand before it
  bool number{false};   ///< begins with a digit
  bool word{false};     ///< a name of several letters, set off by thin spaces
};

class LatexWriter {
 public:
  LatexWriter(const Layout& layout, const Notation& notation) : layout_(layout), notation_(notation) {}

  std::string write(NodeId id) const {
    if (std::holds_alternative<Sum>(layout_.graph().node(id))) return sum(id);
    const WrittenTerm term = layout_.term(id);
    return bounded((term.negative ? "-" : "") + unsigned_term(term));
  }

 private:
  std::string sum(NodeId id) const {
    std::string latex;
    for (const NodeId term_id : layout_.terms(id)) {
      const WrittenTerm term = layout_.term(term_id);
      if (!latex.empty()) latex += term.negative ? " - " : " + ";
      if (latex.empty() && term.negative) latex = "-";
      latex = bounded(latex + unsigned_term(term));
    }
    return latex;
  }

  std::string unsigned_term(const WrittenTerm& term) const {
    if (term.below.empty()) return product(fraction_text(term.over, term.under), term.above);
    return "\\frac" + latex_group(product(number_text(term.over), term.above)) +
           latex_group(product(number_text(term.under), term.below));
  }

  /// number * factors; a number 1 is not written, a lone bracket loses its brackets.
  std::string product(const std::string& number, const std::vector<WrittenPower>& factors) const {
    const bool one = number == "1";
    if (factors.empty()) return number;
    if (one && factors.size() == 1 && factors[0].exponent.is_one()) return alone(factors[0].base);
    std::vector<LatexPiece> pieces;
    if (!one) pieces.push_back({number, false, true, false});
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const bool bracket_follows = i + 1 < factors.size() && layout_.is_compound(factors[i + 1].base);
      pieces.push_back(power(factors[i], bracket_follows));
    }
    return joined(pieces);
  }

  /// A base that stands by itself and needs no brackets.
  std::string alone(NodeId base) const {
    return layout_.is_compound(base) ? write(base) : factor(base, false).latex;
  }

  static std::string joined(const std::vector<LatexPiece>& pieces) {
    std::string latex;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (i > 0) {
        const bool words = pieces[i - 1].word || pieces[i].word;
        latex += pieces[i].number ? " \\cdot " : words ? " \\, " : " ";
      }
      latex = bounded(latex + pieces[i].latex);
    }
    return latex;
  }

  LatexPiece power(const WrittenPower& power, bool bracket_follows) const {
    if (power.exponent.is_one()) return factor(power.base, bracket_follows);
    if (power.exponent == Number::ratio(1, 2)) return {"\\sqrt" + latex_group(write(power.base))};
    const std::string exponent = exponent_text(power.exponent);
    const auto* call = std::get_if<Call>(&layout_.graph().node(power.base));
    if (call == nullptr) {
      LatexPiece base = factor(power.base, false);
      base.latex += exponent;
      return base;
    }
    if (takes_inner_exponent(call->function) && power.exponent.is_integer()) {
      return {std::string(command(call->function)) + exponent + argument(*call, bracket_follows)};
    }
    return {latex_brackets(called(*call, false).latex) + exponent, true};
  }

  static std::string exponent_text(const Number& exponent) {
    const std::string text = prefers_decimal(exponent)
                                 ? number_text(exponent)
                                 : fraction_text(exponent.numerator(), exponent.denominator());
    return "^" + (text.size() == 1 ? text : latex_group(text));
  }

  LatexPiece factor(NodeId base, bool bracket_follows) const {
    return std::visit(overloaded{[&](const Literal&) { return literal(base); },
                                 [&](const Symbol& x) { return symbol(x.name); },
                                 [&](const Sum&) {
                                   return LatexPiece{latex_brackets(write(base)), true};
                                 },
                                 [&](const Product&) {
                                   return LatexPiece{latex_brackets(write(base)), true};
                                 },
                                 [&](const Power&) {
                                   return LatexPiece{latex_brackets(write(base)), true};
                                 },
                                 [&](const Call& x) { return called(x, bracket_follows); }},
                      layout_.graph().node(base));
  }

  LatexPiece literal(NodeId id) const {
    if (layout_.is_compound(id)) return {latex_brackets(write(id)), true};
    return {write(id), false, true};
  }

  LatexPiece symbol(const std::string& name) const {
    const std::string latex = latex_name(name, notation_);
    return {latex, false, false, latex.starts_with("\\mathrm")};
  }

  LatexPiece called(const Call& call, bool bracket_follows) const {
    const auto power = layout_.raised(call);
    if (!power) return {call_text(call, bracket_follows)};
    LatexPiece base = factor(power->base, false);
    if (std::holds_alternative<Call>(layout_.graph().node(power->base)))
      base = {latex_brackets(base.latex), true};
    base.latex += "^" + latex_group((power->exponent.negative ? "-" : "") + unsigned_term(power->exponent));
    return base;
  }

  std::string call_text(const Call& call, bool bracket_follows) const {
    if (call.function == Function::exp) return "e^" + latex_group(write(call.argument));
    if (call.function == Function::abs) return "\\left|" + write(call.argument) + "\\right|";
    return std::string(command(call.function)) + argument(call, bracket_follows);
  }

  /// \sin\theta, \sin l, \sin\left(2 \theta\right).
  std::string argument(const Call& call, bool bracket_follows) const {
    const std::string latex = write(call.argument);
    if (!is_bare(layout_, call.argument, bracket_follows)) return latex_brackets(latex);
    return (latex.starts_with('\\') ? "" : " ") + latex;
  }

  const Layout& layout_;
  const Notation& notation_;
};

}  // namespace

std::string latex_form(const Layout& layout, NodeId id, const Notation& notation) {
  return LatexWriter(layout, notation).write(id);
}

}  // namespace qdot
