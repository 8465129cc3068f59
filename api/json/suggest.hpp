#pragma once
// "Did you mean ...?": the known word nearest to a word nobody knows.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace qdot::api {

/// Optimal string alignment distance (Damerau 1964): the least number of letters inserted, left out, replaced
/// or swapped with their neighbour that turns one word into the other, capital letters counting as small
/// ones.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate at the least distance, the first of several; empty when none is near. Near means at most two
/// edits that leave at least one letter as it was: 'kk' is near 'k', but 'x' is not near 'm'.
[[nodiscard]] std::string closest(std::string_view word, std::span<const std::string> candidates);

}  // namespace qdot::api
