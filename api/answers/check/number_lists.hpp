#pragma once
// Lists of numbers as students write them: "(1, -5)", "0; 0,66; 3,14", "0, ±0.66, π", "[1 -5]^T", "1 : -5",
// one a line, "2.3 and 4.7 rad/s", "T = 2 J, V = 3 J".

#include <string>
#include <string_view>
#include <vector>

#include "api/answers/check/number_notation.hpp"

namespace qdot::api {

inline constexpr std::size_t most_submitted = 10'000;

/// The numbers in a text, of which `wanted` are expected: that tells whether a comma is in a decimal or parts
/// two numbers, where both could be. Throws Error(too_large) past most_submitted.
[[nodiscard]] std::vector<WrittenNumber> written_numbers(std::string_view text, std::size_t wanted);

}  // namespace qdot::api
