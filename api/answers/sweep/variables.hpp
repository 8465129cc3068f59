#pragma once
// What a sweep runs over. A grid has every combination of its variables' values, the last variable varying
// fastest. A sample has `count` rows, each variable drawn by itself.
//
// The numbers of a sample are those of SplitMix64 (core/numerics/random_bits.hpp) from the seed, taken row
// by row and in each row variable by variable: u = (z >> 11) 2^-53 lies in [0, 1).
//   uniform [a, b]: a + (b - a) u
//   normal [m, s]:  m + s sqrt(-2 log(1 - u1)) cos(2 pi u2)
// Source of the second: Box and Muller, A note on the generation of random normal deviates, Annals of
// Mathematical Statistics 29 (1958).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/answers/sweep/request.hpp"
#include "api/answers/sweep/swept_range.hpp"

namespace qdot::api {

struct SweptValues {
  std::vector<SweepVariable> variables{};
  std::size_t rows{};
  std::vector<SweptRange> ranges{};  ///< of the variables
  bool is_sample{};
  std::uint64_t seed{};              ///< of a sample
  Json echo{};                       ///< what the variables run over, in SI
  std::vector<std::string> notes{};  ///< how a value was understood that could be meant otherwise

  /// In SI. Computed from the row's number, so that a hundred million rows need no memory before they are
  /// asked.
  [[nodiscard]] double value(std::size_t row, std::size_t variable) const;
};

/// None after errors were reported. `whole` is the place of the request, `asked` the fields of the question
/// that is asked: what varies must be among what they take. Values are numbers, texts with a unit, or
/// expressions of what is in `scope`, where what varies is left open. `most_rows` may be exceeded by none.
[[nodiscard]] std::optional<SweptValues> read_variables(const SweepRequest& request, const Scene& scene,
                                                        const FieldSet& asked, const Place& whole,
                                                        ParameterScope& scope, std::int64_t most_rows,
                                                        Errors& errors);

}  // namespace qdot::api
