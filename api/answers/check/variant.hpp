#pragma once
// A variant of a key: a value of each of its ranges, drawn by a seed.
//
// The bits are those of SplitMix64 (core/numerics/random_bits.hpp), started with the seed: the k-th range
// takes the value with the index (bits mod count). A draw is thrown away, and the next bits give another,
// when with it
//   - an item cannot be asked, or its number does not exist or is not known well enough to be graded;
//   - a usual slip (core/grading/number_slip.hpp) would count as right: twice an angle that is 0, the period
//   of a
//     motion that has T = omega, the square of 1.
// So the same key and seed give the same variant, whatever else was drawn, on every machine.

#include <cstdint>
#include <string_view>
#include <variant>

#include "api/answers/answers.hpp"
#include "api/answers/check/sheet_error.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

/// {"variant": {"seed": 7, "values": {"l": "0.45 m"}}, "items": [...]}: the numbers of the question, and the
/// key.
[[nodiscard]] std::variant<Json, SheetError> drawn_variant(std::string_view key, std::uint64_t seed,
                                                           const FindSystem& find_system, Models& models);

}  // namespace qdot::api
