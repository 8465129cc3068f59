#pragma once
// How long a formula is, counted in its text.

#include "core/expr/parse_tokens.hpp"

namespace qdot::test {

/// Its additions, subtractions, multiplications, divisions, powers and calls. A sign counts nothing, and
/// neither does a fraction of two numbers (3/4*m, x^(1/2)).
inline std::size_t operation_count_of_text(std::string_view text) {
  const std::vector<Token> tokens = tokenize(text);
  const auto kind = [&](std::size_t i) { return i < tokens.size() ? tokens[i].kind : TokenKind::end; };
  const auto is_number = [&](std::size_t i) { return kind(i) == TokenKind::number; };
  const auto ends_operand = [&](std::size_t i) {
    return is_number(i) || kind(i) == TokenKind::name || kind(i) == TokenKind::close;
  };
  const auto is_fraction = [&](std::size_t i) {  // 3/4, but not in x/3/4 or 3/4^2
    const bool bound_left = i > 1 && (kind(i - 2) == TokenKind::over || kind(i - 2) == TokenKind::power);
    return i > 0 && is_number(i - 1) && is_number(i + 1) && !bound_left && kind(i + 2) != TokenKind::power;
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    switch (kind(i)) {
      case TokenKind::plus:
      case TokenKind::minus:
        count += i > 0 && ends_operand(i - 1) ? 1 : 0;
        break;
      case TokenKind::over:
        count += is_fraction(i) ? 0 : 1;
        break;
      case TokenKind::times:
      case TokenKind::power:
        ++count;
        break;
      case TokenKind::name:
        count += kind(i + 1) == TokenKind::open ? 1 : 0;
        break;
      case TokenKind::number:
      case TokenKind::open:
      case TokenKind::close:
      case TokenKind::comma:
      case TokenKind::end:
        break;
    }
  }
  return count;
}

}  // namespace qdot::test
