#pragma once
// The lexical level of expression text: bounded, ASCII only, every token with its byte offset.

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/expr/number.hpp"

namespace qdot {

/// A character each, except power (^ or **), number, name and end. Commas are those of max and min only.
enum class TokenKind { number, name, plus, minus, times, over, power, open, close, comma, end };

/// Whether it is max or min.
[[nodiscard]] inline bool is_choice(std::string_view name) { return name == "max" || name == "min"; }

struct Token {
  TokenKind kind{TokenKind::end};
  std::string_view text;  ///< into the text that was read
  std::size_t offset{0};  ///< in bytes from its beginning
  Number value;           ///< of a number
};

/// What expression text may measure.
struct TextLimits {
  std::size_t bytes{4096};
  std::size_t tokens{2000};
  std::size_t integer_digits{17};
};

/// The tokens of `text`, an end token last. Throws Error(syntax) at a character no expression has,
/// Error(too_large) beyond a limit.
[[nodiscard]] std::vector<Token> tokenize(std::string_view text, const TextLimits& limits = {});

}  // namespace qdot
