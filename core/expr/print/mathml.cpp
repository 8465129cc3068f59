#include "core/expr/print/forms.hpp"

namespace qdot {
namespace {

constexpr const char* minus = "<mo>−</mo>";              // U+2212
constexpr const char* invisible_times = "<mo>⁢</mo>";  // U+2062
constexpr const char* apply_function = "<mo>⁡</mo>";   // U+2061

std::string element(const std::string& tag, const std::string& content) {
  return "<" + tag + ">" + content + "</" + tag + ">";
}

std::string row(const std::string& content) { return element("mrow", content); }

std::string mathml_brackets(const std::string& content) { return row("<mo>(</mo>" + content + "<mo>)</mo>"); }

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
    if (one && factors.size() == 1 && factors[0].exponent.is_one() && layout_.is_compound(factors[0].base)) {
      return write(factors[0].base);
    }
    std::string content = one && !factors.empty() ? "" : fraction_element(over, under);
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const bool bracket_follows = i + 1 < factors.size() && layout_.is_compound(factors[i + 1].base);
      if (!content.empty()) content += begins_with_digit(factors[i]) ? "<mo>⋅</mo>" : invisible_times;
      content = bounded(content + power(factors[i], bracket_follows));
    }
    return content;
  }

  [[nodiscard]] bool begins_with_digit(const WrittenPower& power) const {
    const bool root = power.exponent == Number::ratio(1, 2);
    return !root && std::holds_alternative<Literal>(layout_.graph().node(power.base));
  }

  std::string power(const WrittenPower& power, bool bracket_follows) const {
    if (power.exponent.is_one()) return factor(power.base, bracket_follows);
    if (power.exponent == Number::ratio(1, 2)) return element("msqrt", write(power.base));
    const std::string exponent = exponent_element(power.exponent);
    const auto* call = std::get_if<Call>(&layout_.graph().node(power.base));
    if (call == nullptr) return element("msup", factor(power.base, false) + exponent);
    if (takes_inner_exponent(call->function) && power.exponent.is_integer()) {
      return called(*call, exponent, bracket_follows);
    }
    return element("msup", mathml_brackets(factor(power.base, false)) + exponent);
  }

  static std::string exponent_element(const Number& exponent) {
    if (prefers_decimal(exponent)) return number_element(exponent);
    return fraction_element(exponent.numerator(), exponent.denominator());
  }

  std::string factor(NodeId base, bool bracket_follows) const {
    return std::visit(
        overloaded{[&](const Literal&) { return enclosed(base); },
                   [&](const Symbol& x) { return mathml_name(x.name); },
                   [&](const Sum&) { return enclosed(base); }, [&](const Product&) { return enclosed(base); },
                   [&](const Power&) { return enclosed(base); },
                   [&](const Call& x) { return call(x, bracket_follows); }},
        layout_.graph().node(base));
  }

  std::string enclosed(NodeId id) const {
    return layout_.is_compound(id) ? mathml_brackets(write(id)) : write(id);
  }

  std::string call(const Call& call, bool bracket_follows) const {
    if (const auto power = layout_.raised(call)) {
      const bool is_call = std::holds_alternative<Call>(layout_.graph().node(power->base));
      const std::string base = factor(power->base, false);
      return element("msup",
                     (is_call ? mathml_brackets(base) : base) +
                         row((power->exponent.negative ? minus : "") + unsigned_term(power->exponent)));
    }
    if (call.function == Function::exp) return element("msup", "<mi>e</mi>" + row(write(call.argument)));
    if (call.function == Function::abs) return row("<mo>|</mo>" + write(call.argument) + "<mo>|</mo>");
    return called(call, "", bracket_follows);
  }

  /// sin θ, or with an exponent sin² θ.
  std::string called(const Call& call, const std::string& exponent, bool bracket_follows) const {
    std::string function = element("mi", std::string(written_function(call.function)));
    if (!exponent.empty()) function = element("msup", function + exponent);
    const bool bare = is_bare(layout_, call.argument, bracket_follows);
    const std::string argument = write(call.argument);
    return row(function + apply_function + (bare ? argument : mathml_brackets(argument)));
  }

  const Layout& layout_;
};

}  // namespace

std::string mathml_form(const Layout& layout, NodeId id, const Notation&) {
  return bounded("<math xmlns=\"http://www.w3.org/1998/Math/MathML\">" + row(MathmlWriter(layout).write(id)) +
                 "</math>");
}

}  // namespace qdot
