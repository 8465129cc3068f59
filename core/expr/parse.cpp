#include "core/expr/parse.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/expr/parse_tokens.hpp"
#include "core/expr/refused_sign.hpp"
#include "core/expr/refused_words.hpp"
#include "core/expr/special_angles.hpp"

namespace qdot {
namespace {

bool is_function(std::string_view name) { return name == "sqrt" || function_named(name).has_value(); }

/// The number an expression is or is multiplied with.
Number coefficient(const Expression& e) {
  if (const Number* number = e.number()) return *number;
  const auto* product = std::get_if<Product>(&e.node());
  return product != nullptr ? product->coefficient : Number(1);
}

class Parser {
 public:
  /// Unknown names are noted in `unknown`; every other error is thrown.
  Parser(std::string_view text, Graph& graph, std::span<const std::string> allowed, const ParseLimits& limits,
         std::vector<ParseError>& unknown)
      : tokens_(tokenize(text, {limits.bytes, limits.tokens, limits.integer_digits})),
        graph_(graph),
        allowed_(allowed),
        limits_(limits),
        unknown_(unknown),
        first_node_(graph.size()) {}

  Expression whole() {
    if (at(TokenKind::end)) fail("expected an expression, not an empty text");
    const Expression result = sum();
    if (!at(TokenKind::end)) reject_rest();
    refuse_underflow(result);
    return result;
  }

 private:
  [[nodiscard]] const Token& token() const { return tokens_[next_]; }
  [[nodiscard]] bool at(TokenKind kind) const { return token().kind == kind; }

  bool accept(TokenKind kind) {
    if (!at(kind)) return false;
    ++next_;
    return true;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::syntax, message, token().offset);
  }

  [[nodiscard]] bool is_known(std::string_view name) const {
    return name == "pi" || std::find(allowed_.begin(), allowed_.end(), name) != allowed_.end();
  }

  [[nodiscard]] std::string found() const { return at(TokenKind::end) ? "the end" : excerpt(token().text); }

  // --- the grammar -----------------------------------------------------------------------------------------

  Expression sum() {
    std::vector<Expression> terms{term()};
    while (at(TokenKind::plus) || at(TokenKind::minus)) {
      const bool negative = at(TokenKind::minus);
      ++next_;
      const Expression next = term();
      terms.push_back(negative ? -next : next);
    }
    return terms.size() == 1 ? terms[0] : checked(graph_.sum(terms));
  }

  Expression term() {
    const bool negative = signs();
    std::vector<Expression> factors{power()};
    while (at(TokenKind::times) || at(TokenKind::over)) {
      const bool divides = at(TokenKind::over);
      ++next_;
      const Token first = token();
      const bool minus = signs();
      Expression factor = power();
      if (divides && factor.is_zero()) throw Error(ErrorCode::syntax, "division by zero", first.offset);
      if (divides) factor = pow(factor, Number(-1));
      factors.push_back(minus ? -factor : factor);
    }
    const Expression product = factors.size() == 1 ? factors[0] : checked(graph_.product(factors));
    return negative ? -product : product;
  }

  /// Skips signs; whether they are a minus together.
  bool signs() {
    bool negative = false;
    for (; at(TokenKind::plus) || at(TokenKind::minus); ++next_) negative ^= at(TokenKind::minus);
    return negative;
  }

  Expression power() {
    const Expression base = primary();
    if (!accept(TokenKind::power)) return base;
    const Token first = token();
    const bool negative = signs();
    const Expression magnitude = nested([this] { return power(); });
    return raised(base, negative ? -magnitude : magnitude, first.offset);
  }

  Expression raised(const Expression& base, const Expression& exponent, std::size_t offset) {
    const Number* number = exponent.number();
    if (number == nullptr) return checked(pow(base, exponent));
    if (std::abs(number->value()) > limits_.exponent) {
      throw Error(ErrorCode::too_large, "the exponent is larger than " + std::to_string(limits_.exponent),
                  offset);
    }
    if (base.is_zero() && number->is_negative()) throw Error(ErrorCode::syntax, "division by zero", offset);
    return checked(pow(base, *number));
  }

  Expression primary() {
    const Token first = token();
    if (accept(TokenKind::number)) {
      if (at(TokenKind::name) || at(TokenKind::open)) reject_juxtaposition(first);
      return checked(graph_.number(first.value));
    }
    if (accept(TokenKind::open)) return bracket(first);
    if (accept(TokenKind::name)) return name(first);
    fail("expected a number, a symbol or '(', found " + found());
  }

  /// What follows an opening bracket, up to its closing one.
  Expression bracket(const Token& open) {
    const Expression inside = nested([this] { return sum(); });
    close(open);
    return inside;
  }

  void close(const Token& open) {
    if (!at(TokenKind::close)) {
      if (!at(TokenKind::end)) reject_rest();
      fail("expected ')' to close the '(' at byte " + std::to_string(open.offset));
    }
    ++next_;
  }

  Expression name(const Token& name) {
    if (at(TokenKind::open)) {
      if (is_choice(name.text) && !is_known(name.text)) return choice(name);
      if (!is_function(name.text)) reject_call(name);
      const Token open = token();
      ++next_;
      return call(name.text, bracket(open));
    }
    const std::string text(name.text);
    const bool known = is_known(text);
    if (!known && is_function(text) && at(TokenKind::power)) {
      throw Error(ErrorCode::syntax, "write " + text + "(x)^2, not " + text + "^2(x)", token().offset);
    }
    if (!known && is_function(text)) {
      throw Error(ErrorCode::syntax, "expected '(' after the function " + excerpt(text), token().offset);
    }
    if (!known && text == "deg") return checked(Number::ratio(1, 180) * graph_.symbol("pi"));
    if (!known) note_unknown(text, name.offset);
    return checked(graph_.symbol(text));
  }

  /// max(a, b) = (a + b + |a - b|)/2, and of more the largest one after the other.
  Expression choice(const Token& name) {
    const Token open = token();
    ++next_;
    Expression result = nested([this] { return sum(); });
    if (!at(TokenKind::comma)) fail(std::string(name.text) + " takes two or more, with commas between them");
    while (accept(TokenKind::comma)) {
      const Expression other = nested([this] { return sum(); });
      const Expression apart = graph_.call(Function::abs, result - other);
      const Expression both = result + other;
      result = checked(Number::ratio(1, 2) * (name.text == "max" ? both + apart : both - apart));
    }
    close(open);
    return result;
  }

  /// An angle that is measured from another right angle, sin(a + pi/2), is read as cos(a).
  Expression call(std::string_view name, const Expression& argument) {
    const auto function = function_named(name);
    const Expression made = function ? graph_.call(*function, argument) : sqrt(argument);
    return checked(has_angle_beside_pi(argument) ? with_special_angles(made) : made);
  }

  /// A sum of pi, some times, and what is no number.
  [[nodiscard]] bool has_angle_beside_pi(const Expression& e) const {
    const auto* sum = std::get_if<Sum>(&graph_.node(e.id()));
    return sum != nullptr && std::ranges::any_of(sum->terms, [&](NodeId id) {
             const Expression rest = split_coefficient({graph_, id}).rest;
             const auto* symbol = std::get_if<Symbol>(&rest.node());
             return symbol != nullptr && symbol->name == "pi";
           });
  }

  // --- bounds and complaints -------------------------------------------------------------------------------

  template <class Read>
  Expression nested(Read read) {
    if (++depth_ > limits_.depth) {
      throw Error(ErrorCode::too_large,
                  "the expression is nested deeper than " + std::to_string(limits_.depth) + " levels",
                  token().offset);
    }
    const Expression result = read();
    --depth_;
    return result;
  }

  Expression checked(const Expression& e) const {
    if (graph_.size() - first_node_ > limits_.nodes) {
      throw Error(ErrorCode::too_large,
                  "the expression has more than " + std::to_string(limits_.nodes) + " parts", token().offset);
    }
    if (!std::isfinite(coefficient(e).value())) {
      throw Error(ErrorCode::too_large, "a number in the expression is outside the range of a double",
                  token().offset);
    }
    return e;
  }

  /// Numbers are exact in expressions, and 0 where they are computed if no double is as small.
  void refuse_underflow(const Expression& e) const {
    const NodeId root[]{e.id()};
    for (const NodeId id : reachable(graph_, root)) {
      const Number c = coefficient(Expression(graph_, id));
      if (c.is_zero() || c.value() != 0) continue;
      throw Error(ErrorCode::too_large, "a number in the expression is outside the range of a double",
                  token().offset);
    }
  }

  void note_unknown(const std::string& name, std::size_t offset) {
    const bool noted =
        std::any_of(unknown_.begin(), unknown_.end(), [&](const auto& e) { return e.symbol == name; });
    if (noted) return;
    std::string advice;
    const std::string product = product_of(name, allowed_);
    if (!product.empty()) advice = ": a product is written " + product;
    if (name == "e") advice = ": the exponential function is exp(...)";
    if (name == "Pi" || name == "PI") advice = ": the number is pi";
    for (const std::string_view mark : {"_dot_dot", "_ddot", "_dot"}) {
      if (!name.ends_with(mark) || !is_known(name.substr(0, name.size() - mark.size()))) continue;
      advice = mark == "_dot" ? ": there are no velocities here" : ": there are no accelerations here";
      break;
    }
    unknown_.push_back(
        {ErrorCode::unknown_symbol, offset, "unknown symbol " + excerpt(name) + advice, name, product});
  }

  [[noreturn]] void reject_juxtaposition(const Token& number) const {
    const std::string left(number.text.substr(0, 17));
    const bool is_unit = at(TokenKind::name) && !is_known(token().text) && !is_function(token().text);
    if (is_unit && token().text != "deg")
      fail("a number in an expression is in SI, with no unit behind it; " + excerpt(token().text) +
           " is none of the symbols");
    if (!at(TokenKind::name)) fail("write " + left + "*(...), not " + left + "(...)");
    const std::string right(token().text.substr(0, 17));
    std::string message = "write " + left + "*" + right + ", not " + left + right;
    if (token().offset > number.offset + number.text.size())
      message += "; if " + right + " is a unit, give the number in SI instead, without it";
    fail(message);
  }

  [[noreturn]] void reject_call(const Token& name) const {
    std::string message = "unknown function " + excerpt(name.text) + ", there are sqrt";
    for (const std::string_view known : function_names) message += ", " + std::string(known);
    message += ", max, min";
    if (const std::string_view here = function_here(name.text); !here.empty())
      message = "write " + std::string(here) + ", not " + std::string(name.text) + "(...)";
    const std::string known(name.text.substr(0, 36));
    if (is_known(name.text)) message = "write " + known + "*(...) for a product";
    if (is_known(name.text) && is_time_in_brackets())
      message = "write " + known + " alone, not " + known + "(t): every coordinate is a function of time";
    throw Error(ErrorCode::syntax, message, name.offset);
  }

  [[nodiscard]] bool is_time_in_brackets() const {
    return next_ + 2 < tokens_.size() && tokens_[next_ + 1].text == "t" &&
           tokens_[next_ + 2].kind == TokenKind::close;
  }

  /// The tokens from here on continue nothing.
  [[noreturn]] void reject_rest() const {
    if (at(TokenKind::close)) fail("there is no '(' for this ')'");
    fail("expected an operator, found " + found() + ": a product is written with *");
  }

  std::vector<Token> tokens_;
  Graph& graph_;
  std::span<const std::string> allowed_;
  ParseLimits limits_;
  std::vector<ParseError>& unknown_;
  std::size_t first_node_;
  std::size_t next_{0};
  int depth_{0};
};

}  // namespace

ParseResult parse_all(std::string_view text, Graph& graph, std::span<const std::string> allowed_symbols,
                      const ParseLimits& limits) {
  ParseResult result;
  try {
    result.expression = Parser(text, graph, allowed_symbols, limits, result.errors).whole();
  } catch (const Error& error) {
    result.errors.push_back({error.code(), error.offset(), error.what(), "", ""});
  }
  if (!result.errors.empty()) result.expression.reset();
  return result;
}

Expression parse(std::string_view text, Graph& graph, std::span<const std::string> allowed_symbols) {
  ParseResult result = parse_all(text, graph, allowed_symbols);
  if (result.expression) return *result.expression;
  const ParseError& first = result.errors.front();
  throw Error(first.code, first.message, first.offset);
}

}  // namespace qdot
