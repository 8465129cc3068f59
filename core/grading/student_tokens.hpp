#pragma once
// The lexical level of submissions in plain notation (plain_notation.hpp).

#include <string_view>
#include <vector>

#include "core/expr/number.hpp"

namespace qdot {

enum class Mark {
  number,
  name,
  prime,  ///< '
  plus,
  minus,
  times,
  over,
  power,   ///< ^ or **
  open,    ///< ( [ {
  close,   ///< ) ] }
  bar,     ///< |
  equals,  ///< = or ==
  comma,
  colon,
  line,  ///< the end of a line, or ;
  end
};

struct StudentToken {
  Mark mark{Mark::end};
  std::string_view text{};
  std::size_t offset{0};
  bool is_apart{true};  ///< a blank stands before it
  Number value{};       ///< of a number
};

/// Throws Error(syntax) at a character that no formula has, Error(too_large) past 2,000 tokens.
[[nodiscard]] std::vector<StudentToken> student_tokens(std::string_view plain);

}  // namespace qdot
