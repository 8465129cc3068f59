#include "core/expr/parse_tokens.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/error.hpp"
#include "core/expr/refused_sign.hpp"

namespace qdot {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool continues_name(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

std::size_t skip_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// Length of the number at the beginning of `text`: 12, 1.5, .5, 1e-3.
std::size_t number_length(std::string_view text) {
  std::size_t at = skip_digits(text, 0);
  if (at < text.size() && text[at] == '.') at = skip_digits(text, at + 1);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    const std::size_t end = skip_digits(text, exponent);
    if (end > exponent) at = end;
  }
  return at;
}

Number number_value(std::string_view text, std::size_t offset, const TextLimits& limits) {
  const bool integer = std::all_of(text.begin(), text.end(), is_digit);
  if (integer && text.size() > limits.integer_digits) {
    throw Error(ErrorCode::too_large,
                "the integer " + excerpt(text) + " has more than " + std::to_string(limits.integer_digits) +
                    " digits",
                offset);
  }
  if (const auto value = Number::written(text)) return *value;
  throw Error(ErrorCode::too_large, "the number " + excerpt(text) + " is outside the range of a double",
              offset);
}

std::optional<TokenKind> operator_kind(char c) {
  switch (c) {
    case '+':
      return TokenKind::plus;
    case '-':
      return TokenKind::minus;
    case '*':
      return TokenKind::times;
    case '/':
      return TokenKind::over;
    case '^':
      return TokenKind::power;
    case '(':
      return TokenKind::open;
    case ')':
      return TokenKind::close;
    default:
      return std::nullopt;
  }
}

/// Where programs have pi and functions from: math.pi, np.sqrt.
bool is_module(std::string_view name) {
  return name == "math" || name == "Math" || name == "np" || name == "numpy" || name == "sp" ||
         name == "sympy";
}

Token next_token(std::string_view text, std::size_t at, const TextLimits& limits) {
  const std::string_view rest = text.substr(at);
  const bool point_first = rest[0] == '.' && rest.size() > 1 && is_digit(rest[1]);
  if (is_digit(rest[0]) || point_first) {
    const std::string_view written = rest.substr(0, number_length(rest));
    if (rest.find("..") <= written.size())
      throw Error(ErrorCode::syntax, "a range is given by its ends, in fields of their own, not by ..", at);
    return {TokenKind::number, written, at, number_value(written, at, limits)};
  }
  if (is_letter(rest[0])) {
    const auto end = std::find_if_not(rest.begin(), rest.end(), continues_name);
    if (end != rest.end() && *end == '.' && is_module({rest.begin(), end})) {
      const auto last = std::find_if_not(end + 1, rest.end(), continues_name);
      throw Error(ErrorCode::syntax, "write pi, sqrt or sin, not " + excerpt({rest.begin(), last}), at);
    }
    return {TokenKind::name, rest.substr(0, static_cast<std::size_t>(end - rest.begin())), at, {}};
  }
  if (rest.starts_with("**")) return {TokenKind::power, rest.substr(0, 2), at, {}};
  if (rest[0] == ',' && is_choice(function_around(text.substr(0, at))))
    return {TokenKind::comma, rest.substr(0, 1), at, {}};
  const auto kind = operator_kind(rest[0]);
  if (!kind) throw Error(ErrorCode::syntax, advice_on_sign(text, at), at);
  return {*kind, rest.substr(0, 1), at, {}};
}

}  // namespace

std::vector<Token> tokenize(std::string_view text, const TextLimits& limits) {
  if (text.size() > limits.bytes) {
    throw Error(ErrorCode::too_large,
                "the expression is longer than " + std::to_string(limits.bytes) + " bytes", limits.bytes);
  }
  std::vector<Token> tokens;
  for (std::size_t at = 0; at < text.size();) {
    if (is_space(text[at])) {
      ++at;
      continue;
    }
    if (tokens.size() == limits.tokens) {
      throw Error(ErrorCode::too_large,
                  "the expression has more than " + std::to_string(limits.tokens) + " tokens", at);
    }
    tokens.push_back(next_token(text, at, limits));
    at += tokens.back().text.size();
  }
  tokens.push_back({TokenKind::end, text.substr(text.size()), text.size(), {}});
  return tokens;
}

}  // namespace qdot
