#pragma once
// Reading expressions from text.
//
//   sum     = term { (+|-) term }
//   term    = {+|-} power { (*|/) {+|-} power }      a leading minus belongs to the whole term: -a*b = -(a*b)
//   power   = primary [ ^ {+|-} power ]              right associative; ** is ^; -x^2 = -(x^2)
//   primary = number | name | function ( sum ) | choice ( sum , sum {, sum} ) | ( sum )
//
// Functions are those of core/numerics/function.hpp and sqrt; a choice is max or min, which are written with
// abs: max(a, b) = (a + b + |a - b|)/2. The name `pi` is always known, and `deg` is
// pi/180 where no symbol has that name: 30*deg. There is no implicit multiplication. Numbers are exactly the
// decimals that are written: 9.81 is 981/100.
//
// The text may be hostile: its bytes, tokens and depth and the nodes it makes are bounded (ParseLimits), and
// a chain of a thousand terms makes one flat sum.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/expr/expression.hpp"
#include "core/numerics/crossing.hpp"

namespace qdot {

/// Bounds on one expression's text and on what it builds; passing one is an Error(too_large).
struct ParseLimits {
  std::size_t bytes{4096};
  std::size_t tokens{2000};
  std::size_t integer_digits{17};
  int depth{64};            ///< brackets, calls and exponents inside each other
  int exponent{64};         ///< magnitude of a numeric exponent
  std::size_t nodes{2000};  ///< nodes added to the graph
};

struct ParseError {
  ErrorCode code{ErrorCode::syntax};  ///< syntax, unknown_symbol or too_large
  std::size_t offset{0};              ///< in bytes from the beginning of the text
  std::string message;                ///< one sentence without a full stop
  std::string symbol;                 ///< the name, of unknown_symbol
  std::string product;                ///< of symbols, that the name was meant for: m*x for mx; or empty
};

/// An expression, or why there is none: every unknown name (once each), then at most one other error, which
/// ended the reading.
struct ParseResult {
  std::optional<Expression> expression;
  std::vector<ParseError> errors;
};

[[nodiscard]] ParseResult parse_all(std::string_view text, Graph& graph,
                                    std::span<const std::string> allowed_symbols,
                                    const ParseLimits& limits = {});

/// The expression. Throws the first of parse_all's errors as Error.
[[nodiscard]] Expression parse(std::string_view text, Graph& graph,
                               std::span<const std::string> allowed_symbols);

/// An event is a zero of `expression`.
struct ParsedEvent {
  Expression expression;
  Crossing crossing{Crossing::either};
};

/// "theta = 0+", "l=1.2", "phi - 2*theta = 0-": left minus right side; a last + counts upward crossings only,
/// a last - downward ones. Throws as parse does, offsets counted in the whole text.
[[nodiscard]] ParsedEvent parse_event(std::string_view text, Graph& graph,
                                      std::span<const std::string> allowed_symbols);

}  // namespace qdot
