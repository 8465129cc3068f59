#include <algorithm>
#include <array>

#include "core/expr/print/forms.hpp"

namespace qdot {
namespace {

/// The forms that are written on one line.
enum class Language { text, sympy, maxima, c };

/// How tightly the outermost operator of a piece of text binds.
enum class Binding { sum, product, power, atom };

struct LinearPiece {
  std::string text;
  Binding binding{Binding::atom};
};

constexpr std::array<std::string_view, 35> python_keywords{
    "False", "None",     "True",  "and",    "as",   "assert", "async",  "await",    "break",
    "class", "continue", "def",   "del",    "elif", "else",   "except", "finally",  "for",
    "from",  "global",   "if",    "import", "in",   "is",     "lambda", "nonlocal", "not",
    "or",    "pass",     "raise", "return", "try",  "while",  "with",   "yield"};

constexpr std::array<std::string_view, 34> c_keywords{
    "auto",   "break",    "case",     "char",     "const", "continue", "default", "do",     "double",
    "else",   "enum",     "extern",   "float",    "for",   "goto",     "if",      "inline", "int",
    "long",   "register", "restrict", "return",   "short", "signed",   "sizeof",  "static", "struct",
    "switch", "typedef",  "union",    "unsigned", "void",  "volatile", "while"};

std::string bracketed(const std::string& text) { return "(" + text + ")"; }

std::string at_least(const LinearPiece& piece, Binding binding) {
  return piece.binding < binding ? bracketed(piece.text) : piece.text;
}

class LinearWriter {
 public:
  LinearWriter(const Layout& layout, Language language) : layout_(layout), language_(language) {}

  LinearPiece write(NodeId id) const {
    const Node& node = layout_.graph().node(id);
    LinearPiece piece = std::visit(
        overloaded{[&](const Literal&) { return signed_term(id); },
                   [&](const Symbol& x) { return LinearPiece{symbol(x.name)}; },
                   [&](const Sum&) { return sum(id); }, [&](const Product&) { return signed_term(id); },
                   [&](const Power&) { return signed_term(id); }, [&](const Call& x) { return call(x); }},
        node);
    piece.text = bounded(std::move(piece.text));
    return piece;
  }

 private:
  LinearPiece sum(NodeId id) const {
    std::string text;
    for (const NodeId term_id : layout_.terms(id)) {
      const WrittenTerm written = layout_.term(term_id);
      if (!text.empty()) text += written.negative ? " - " : " + ";
      if (text.empty() && written.negative) text = "-";
      text = bounded(text + unsigned_term(written).text);
    }
    return {text, Binding::sum};
  }

  LinearPiece signed_term(NodeId id) const {
    const WrittenTerm written = layout_.term(id);
    const LinearPiece piece = unsigned_term(written);
    return written.negative ? LinearPiece{"-" + piece.text, Binding::sum} : piece;
  }

  LinearPiece unsigned_term(const WrittenTerm& term) const {
    const bool bar = !term.below.empty();
    const LinearPiece front = bar ? number(term.over) : fraction(term.over, term.under);
    std::vector<LinearPiece> above = powers(term.above);
    const bool one = term.over.is_one() && (bar || term.under.is_one());
    if (!one || above.empty()) above.insert(above.begin(), front);
    if (!bar) return product(above);
    std::vector<LinearPiece> below = powers(term.below);
    if (!term.under.is_one()) below.insert(below.begin(), number(term.under));
    const std::string divisor = at_least(product(below), Binding::power);
    return {at_least(product(above), Binding::product) + "/" + divisor, Binding::product};
  }

  std::vector<LinearPiece> powers(const std::vector<WrittenPower>& factors) const {
    std::vector<LinearPiece> pieces;
    for (const WrittenPower& factor : factors) pieces.push_back(power(factor));
    return pieces;
  }

  static LinearPiece product(const std::vector<LinearPiece>& factors) {
    if (factors.size() == 1) return factors[0];
    std::string text;
    for (const LinearPiece& factor : factors) {
      if (!text.empty()) text += "*";
      text = bounded(text + at_least(factor, Binding::product));
    }
    return {text, Binding::product};
  }

  LinearPiece power(const WrittenPower& power) const {
    const LinearPiece base = write(power.base);
    if (power.exponent.is_one()) return base;
    if (power.exponent == Number::ratio(1, 2)) return {"sqrt" + bracketed(base.text)};
    if (language_ == Language::c) return c_power(power, base);
    return raised(base, fraction(Number(power.exponent)));
  }

  /// x*x for small powers of symbols: pow() is slow, and other calls would be evaluated twice.
  LinearPiece c_power(const WrittenPower& power, const LinearPiece& base) const {
    constexpr std::int64_t largest_spelled_out = 4;
    const bool is_symbol = std::holds_alternative<Symbol>(layout_.graph().node(power.base));
    if (const auto times = power.exponent.whole(largest_spelled_out); is_symbol && times) {
      return product(std::vector<LinearPiece>(static_cast<std::size_t>(*times), base));
    }
    return {"pow(" + base.text + ", " + fraction(power.exponent).text + ")"};
  }

  // --- leaves ----------------------------------------------------------------------------------------------

  LinearPiece fraction(const Number& value) const {
    if (writes_decimals() && prefers_decimal(value)) return number(value);
    return fraction(value.numerator(), value.denominator());
  }

  /// over/under, where `over` may be a decimal if `under` is 1.
  LinearPiece fraction(const Number& over, const Number& under) const {
    if (under.is_one()) return number(over);
    if (language_ == Language::sympy)
      return {"Rational(" + number(over).text + ", " + number(under).text + ")"};
    return {number(over).text + "/" + number(under).text, Binding::product};
  }

  /// A positive integer or decimal.
  LinearPiece number(const Number& value) const {
    if (!writes_decimals()) {
      return value.is_integer() ? LinearPiece{integer_text(value)}
                                : fraction(value.numerator(), value.denominator());
    }
    const bool needs_point = language_ == Language::c && value.is_integer() && !is_scientific(value);
    return {decimal_text(value) + (needs_point ? ".0" : "")};
  }

  [[nodiscard]] bool writes_decimals() const {
    return language_ == Language::text || language_ == Language::c;
  }

  std::string symbol(const std::string& name) const {
    const auto keyword = [&](const auto& words) {
      return std::find(words.begin(), words.end(), name) != words.end();
    };
    switch (language_) {
      case Language::sympy:
        return keyword(python_keywords) ? name + "_" : name;
      case Language::maxima:
        return name == "pi" ? "%pi" : name;
      case Language::c:
        return name == "pi" ? c_pi() : keyword(c_keywords) ? name + "_" : name;
      case Language::text:
        break;
    }
    return name;
  }

  /// C99 has no M_PI.
  static std::string c_pi() { return "3.141592653589793"; }

  LinearPiece call(const Call& call) const {
    if (const auto power = layout_.raised(call)) return raised(*power);
    const std::string argument = write(call.argument).text;
    if (language_ == Language::c && call.function == Function::sign) {
      const std::string x = bracketed(argument);
      return {"((" + x + " > 0) - (" + x + " < 0))"};
    }
    return {std::string(function_name(call.function)) + bracketed(argument)};
  }

  LinearPiece raised(const RaisedCall& power) const {
    const LinearPiece base = write(power.base), size = unsigned_term(power.exponent);
    const LinearPiece exponent = power.exponent.negative ? LinearPiece{"-" + size.text, Binding::sum} : size;
    if (language_ == Language::c) return {"pow(" + base.text + ", " + exponent.text + ")"};
    return raised(base, exponent);
  }

  LinearPiece raised(const LinearPiece& base, const LinearPiece& exponent) const {
    const std::string sign = language_ == Language::sympy ? "**" : "^";
    return {at_least(base, Binding::atom) + sign + at_least(exponent, Binding::atom), Binding::power};
  }

  std::string_view function_name(Function function) const {
    const bool sympy = language_ == Language::sympy;
    if (function == Function::abs && sympy) return "Abs";
    if (function == Function::abs && language_ == Language::c) return "fabs";
    if (function == Function::sign && language_ == Language::maxima) return "signum";
    return name(function);
  }

  const Layout& layout_;
  Language language_;
};

std::string linear_form(const Layout& layout, NodeId id, Language language) {
  return LinearWriter(layout, language).write(id).text;
}

}  // namespace

std::string text_form(const Layout& layout, NodeId id, const Notation&) {
  return linear_form(layout, id, Language::text);
}

std::string sympy_form(const Layout& layout, NodeId id, const Notation&) {
  return linear_form(layout, id, Language::sympy);
}

std::string maxima_form(const Layout& layout, NodeId id, const Notation&) {
  return linear_form(layout, id, Language::maxima);
}

std::string c_form(const Layout& layout, NodeId id, const Notation&) {
  return linear_form(layout, id, Language::c);
}

}  // namespace qdot
