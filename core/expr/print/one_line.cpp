#include "core/expr/print/one_line.hpp"

#include <algorithm>
#include <optional>

namespace qdot {
namespace {

/// How tightly the outermost operator of a piece of text binds.
enum class Binding { sum, product, power, atom };

struct Piece {
  std::string text;
  Binding binding{Binding::atom};
};

std::string bracketed(const std::string& text) { return "(" + text + ")"; }

std::string at_least(const Piece& piece, Binding binding) {
  return piece.binding < binding ? bracketed(piece.text) : piece.text;
}

/// A pattern with the argument in the place of each #.
std::string filled_in(std::string_view pattern, const std::string& argument) {
  std::string text;
  for (const char c : pattern) text += c == '#' ? argument : std::string(1, c);
  return bounded(std::move(text));
}

class OneLineWriter {
 public:
  OneLineWriter(const Layout& layout, const Language& language) : layout_(layout), language_(language) {}

  Piece write(NodeId id) const {
    const Node& node = layout_.graph().node(id);
    Piece piece = std::visit(
        overloaded{[&](const Literal&) { return signed_term(id); },
                   [&](const Symbol& x) { return Piece{symbol(x.name)}; },
                   [&](const Sum&) { return sum(id); }, [&](const Product&) { return signed_term(id); },
                   [&](const Power&) { return signed_term(id); }, [&](const Call& x) { return call(x); }},
        node);
    piece.text = bounded(std::move(piece.text));
    return piece;
  }

 private:
  Piece sum(NodeId id) const {
    std::string text;
    for (const NodeId term_id : layout_.terms(id)) {
      const WrittenTerm written = layout_.term(term_id);
      if (!text.empty()) text += written.negative ? " - " : " + ";
      if (text.empty() && written.negative) text = "-";
      text = bounded(text + unsigned_term(written).text);
    }
    return {text, Binding::sum};
  }

  Piece signed_term(NodeId id) const {
    const WrittenTerm written = layout_.term(id);
    const Piece piece = unsigned_term(written);
    return written.negative ? Piece{"-" + piece.text, Binding::sum} : piece;
  }

  Piece unsigned_term(const WrittenTerm& term) const {
    const bool bar = !term.below.empty();
    const Piece front = bar ? number(term.over) : fraction(term.over, term.under);
    std::vector<Piece> above = powers(term.above);
    const bool one = term.over.is_one() && (bar || term.under.is_one());
    if (!one || above.empty()) above.insert(above.begin(), front);
    if (!bar) return product(above);
    std::vector<Piece> below = powers(term.below);
    if (!term.under.is_one()) below.insert(below.begin(), number(term.under));
    const std::string divisor = at_least(product(below), Binding::power);
    return {at_least(product(above), Binding::product) + "/" + divisor, Binding::product};
  }

  std::vector<Piece> powers(const std::vector<WrittenPower>& factors) const {
    std::vector<Piece> pieces;
    for (const WrittenPower& factor : factors) pieces.push_back(power(factor));
    return pieces;
  }

  static Piece product(const std::vector<Piece>& factors) {
    if (factors.size() == 1) return factors[0];
    std::string text;
    for (const Piece& factor : factors) {
      if (!text.empty()) text += "*";
      text = bounded(text + at_least(factor, Binding::product));
    }
    return {text, Binding::product};
  }

  Piece power(const WrittenPower& power) const {
    const Piece base = write(power.base);
    if (power.exponent.is_one()) return base;
    if (power.exponent == Number::ratio(1, 2)) return {"sqrt" + bracketed(base.text)};
    if (language_.power.empty()) {
      if (const auto spelled_out = repeated_factor(power, base)) return *spelled_out;
    }
    return raised(base, fraction(Number(power.exponent)));
  }

  /// x*x for small powers of symbols: pow() is slow, and other calls would be evaluated twice.
  [[nodiscard]] std::optional<Piece> repeated_factor(const WrittenPower& power, const Piece& base) const {
    constexpr std::int64_t largest_spelled_out = 4;
    const bool is_symbol = std::holds_alternative<Symbol>(layout_.graph().node(power.base));
    const auto times = power.exponent.whole(largest_spelled_out);
    if (!is_symbol || !times) return std::nullopt;
    return product(std::vector<Piece>(static_cast<std::size_t>(*times), base));
  }

  // --- leaves ----------------------------------------------------------------------------------------------

  Piece fraction(const Number& value) const {
    if (writes_decimals() && prefers_decimal(value)) return number(value);
    return fraction(value.numerator(), value.denominator());
  }

  /// over/under, where `over` may be a decimal if `under` is 1.
  Piece fraction(const Number& over, const Number& under) const {
    if (under.is_one()) return number(over);
    if (!language_.ratio.empty()) {
      return {std::string(language_.ratio) + bracketed(number(over).text + ", " + number(under).text)};
    }
    return {number(over).text + "/" + number(under).text, Binding::product};
  }

  /// A positive integer or decimal.
  Piece number(const Number& value) const {
    if (!writes_decimals()) {
      return value.is_integer() ? Piece{integer_text(value)}
                                : fraction(value.numerator(), value.denominator());
    }
    const bool needs_point =
        language_.numbers == Language::Numbers::floating_point && value.is_integer() && !is_scientific(value);
    return {decimal_text(value) + (needs_point ? ".0" : "")};
  }

  [[nodiscard]] bool writes_decimals() const { return language_.numbers != Language::Numbers::exact; }

  [[nodiscard]] std::string symbol(const std::string& name) const {
    if (name == "pi") return std::string(language_.pi);
    return std::ranges::count(language_.keywords, name) > 0 ? name + "_" : name;
  }

  Piece call(const Call& call) const {
    if (const auto power = layout_.raised(call)) return raised(*power);
    const std::string argument = write(call.argument).text;
    if (call.function == Function::abs) return {filled_in(language_.abs, argument)};
    if (call.function == Function::sign) return {filled_in(language_.sign, argument)};
    return {std::string(name(call.function)) + bracketed(argument)};
  }

  Piece raised(const RaisedCall& power) const {
    const Piece base = write(power.base), size = unsigned_term(power.exponent);
    const Piece exponent = power.exponent.negative ? Piece{"-" + size.text, Binding::sum} : size;
    return raised(base, exponent);
  }

  Piece raised(const Piece& base, const Piece& exponent) const {
    if (language_.power.empty()) return {"pow(" + base.text + ", " + exponent.text + ")"};
    return {at_least(base, Binding::atom) + std::string(language_.power) + at_least(exponent, Binding::atom),
            Binding::power};
  }

  const Layout& layout_;
  const Language& language_;
};

}  // namespace

std::string one_line(const Layout& layout, NodeId id, const Language& language) {
  return OneLineWriter(layout, language).write(id).text;
}

}  // namespace qdot
