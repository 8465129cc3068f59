#pragma once
// Quantities as people write them: "30deg", "12 cm", "2 rev/s", "9.81 m/s^2", "1.5e-3".

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/numerics/real.hpp"

namespace qdot::api {

struct QuantityError {
  std::string code;    ///< syntax, unknown_unit, wrong_dimension or out_of_range; of expressions more
  std::string detail;  ///< one sentence that says what to write instead
  std::vector<std::string> allowed{};  ///< names, of unknown_symbol, or units that fit
  std::string did_you_mean{};          ///< the text that was probably meant, or a name in it
};

/// The SI value of `text`, a number and an optional unit (core/mechanics/units.hpp has the names), for a
/// symbol declared in `expected_unit`, which is coherent, such as "kg" or "rad/s". A bare number is in SI.
///
/// A turn: where the symbol is an angular velocity, "2 rev/s", "120 rpm" and "2 Hz" all are 4 pi rad/s; where
/// it is a plain 1/s, Hz is 1/s. "2 1/s" is 2 rad/s: 1/s says nothing of turns.
[[nodiscard]] std::variant<Real, QuantityError> parse_quantity(std::string_view text,
                                                               std::string_view expected_unit);

/// The same as an expression of numbers and pi, "(30)*(1/180)*pi"; any other text as it is.
[[nodiscard]] std::string exact_quantity(std::string_view text, std::string_view expected_unit);

/// Is `text` a quantity in Hz for a symbol in radians, so that turns are counted?
[[nodiscard]] bool counts_turns(std::string_view text, std::string_view expected_unit);

}  // namespace qdot::api
