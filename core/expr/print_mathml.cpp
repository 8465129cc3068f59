#include "core/expr/print_forms.hpp"

namespace qdot {
namespace {

constexpr const char* minus = "<mo>−</mo>";              // U+2212
constexpr const char* invisible_times = "<mo>⁢</mo>";  // U+2062
constexpr const char* apply_function = "<mo>⁡</mo>";   // U+2061

std::string element(const std::string& tag, const std::string& content) {
  return "<" + tag + ">" + content + "</" + tag + ">";
}

std::string row(const std::string& content) { return element("mrow", content); }

std::string bracketed(const std::string& content) { return row("<mo>(</mo>" + content + "<mo>)</mo>"); }

std::string number_element(const Number& value) {
  const std::string text = decimal_text(value);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return element("mn", text);
  const int exponent = std::stoi(text.substr(e + 1));
  const std::string magnitude = element("mn", std::to_string(exponent < 0 ? -exponent : exponent));
  return row(element("mn", text.substr(0, e)) + "<mo>⋅</mo>" +
             element("msup", element("mn", "10") + row((exponent < 0 ? minus : "") + magnitude)));
}

std::string fraction_element(const Number& over, const Number& under) {
  if (under.is_one()) return number_element(over);
  return element("mfrac", number_element(over) + number_element(under));
}

std::string_view written_function(Function function) {
  switch (function) {
    case Function::asin:
      return "arcsin";
    case Function::acos:
      return "arccos";
    case Function::atan:
      return "arctan";
    case Function::log:
      return "ln";
    case Function::sign:
      return "sgn";
    case Function::sin:
    case Function::cos:
    case Function::tan:
    case Function::sinh:
    case Function::cosh:
    case Function::tanh:
    case Function::exp:
    case Function::abs:
      break;
  }
  return name(function);
}

class MathmlWriter {
 public:
  explicit MathmlWriter(const Layout& layout) : layout_(layout) {}

  /// The content of a row.
  std::string write(NodeId id) const {
    if (!std::holds_alternative<Sum>(layout_.graph().node(id))) return signed_term(id);
    std::string content;
    for (const NodeId term_id : layout_.terms(id)) {
      const WrittenTerm term = layout_.term(term_id);
      if (term.negative) content += minus;
      if (!term.negative && !content.empty()) content += "<mo>+</mo>";
      content = bounded(content + unsigned_term(term));
    }
    return content;
  }

 private:
  std::string signed_term(NodeId id) const {
    const WrittenTerm term = layout_.term(id);
    return bounded((term.negative ? minus : "") + unsigned_term(term));
  }

  std::string unsigned_term(const WrittenTerm& term) const {
    if (term.below.empty()) return product(term.over, term.under, term.above);
    return element("mfrac", row(product(term.over, Number(1), term.above)) +
                                row(product(term.under, Number(1), term.below)));
  }

  /// over/under * factors; a number 1 is not written, a lone bracket loses its brackets.
  std::string product(const Number& over, const Number& under,
                      const std::vector<WrittenPower>& factors) const {
    const bool one = over.is_one() && under.is_one();
    if (one && factors.size() == 1 && factors[0].exponent.is_one() && is_bracketed(factors[0].base)) {
      return write(factors[0].base);
    }
    std::string content = one && !factors.empty() ? "" : fraction_element(over, under);
    for (const WrittenPower& factor : factors) {
      if (!content.empty()) content += begins_with_digit(factor) ? "<mo>⋅</mo>" : invisible_times;
      content = bounded(content + power(factor));
    }
    return content;
  }

  [[nodiscard]] bool begins_with_digit(const WrittenPower& power) const {
    const bool root = power.exponent == Number::ratio(1, 2);
    return !root && std::holds_alternative<Literal>(layout_.graph().node(power.base));
  }

  [[nodiscard]] bool is_bracketed(NodeId base) const {
    const Node& node = layout_.graph().node(base);
    const auto* literal = std::get_if<Literal>(&node);
    if (literal != nullptr) return literal->value.is_negative() || !layout_.term(base).under.is_one();
    return std::holds_alternative<Sum>(node) || std::holds_alternative<Product>(node) ||
           std::holds_alternative<Power>(node);
  }

  std::string power(const WrittenPower& power) const {
    if (power.exponent.is_one()) return factor(power.base);
    if (power.exponent == Number::ratio(1, 2)) return element("msqrt", write(power.base));
    const bool split = power.exponent.is_exact() && !prefers_decimal(power.exponent);
    const std::string exponent =
        split ? fraction_element(Number(power.exponent.numerator()), Number(power.exponent.denominator()))
              : number_element(power.exponent);
    const bool is_call = std::holds_alternative<Call>(layout_.graph().node(power.base));
    const std::string base = is_call ? bracketed(factor(power.base)) : factor(power.base);
    if (const auto* call = std::get_if<Call>(&layout_.graph().node(power.base)); call != nullptr) {
      if (has_inner_power(call->function) && power.exponent.is_integer()) return called(*call, exponent);
    }
    return element("msup", base + exponent);
  }

  /// sin^2 x is (sin x)^2; for the others it is not said.
  static bool has_inner_power(Function function) {
    return function != Function::exp && function != Function::abs && function != Function::sign &&
           function != Function::log;
  }

  std::string factor(NodeId base) const {
    return std::visit(
        overloaded{[&](const Literal&) { return enclosed(base); },
                   [&](const Symbol& x) { return mathml_name(x.name); },
                   [&](const Sum&) { return enclosed(base); }, [&](const Product&) { return enclosed(base); },
                   [&](const Power&) { return enclosed(base); }, [&](const Call& x) { return call(x); }},
        layout_.graph().node(base));
  }

  std::string enclosed(NodeId id) const { return is_bracketed(id) ? bracketed(write(id)) : write(id); }

  std::string call(const Call& call) const {
    if (call.function == Function::exp) return element("msup", "<mi>e</mi>" + row(write(call.argument)));
    if (call.function == Function::abs) return row("<mo>|</mo>" + write(call.argument) + "<mo>|</mo>");
    return called(call, "");
  }

  /// sin θ, or with an exponent sin² θ.
  std::string called(const Call& call, const std::string& exponent) const {
    std::string function = element("mi", std::string(written_function(call.function)));
    if (!exponent.empty()) function = element("msup", function + exponent);
    const bool bare = std::holds_alternative<Symbol>(layout_.graph().node(call.argument));
    const std::string argument = write(call.argument);
    return row(function + apply_function + (bare ? argument : bracketed(argument)));
  }

  const Layout& layout_;
};

}  // namespace

std::string mathml_form(const Layout& layout, NodeId id) {
  return bounded("<math xmlns=\"http://www.w3.org/1998/Math/MathML\">" + row(MathmlWriter(layout).write(id)) +
                 "</math>");
}

}  // namespace qdot
