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

/// Greek letters by their names, and what else people have for minus: "π/6" is pi/6.
[[nodiscard]] std::string greek_by_name(std::string_view text);

/// Letters and digits alone, Greek ones by their names: "θ_dot" is thetadot.
[[nodiscard]] std::string letters_of(std::string_view name);

/// The candidate with the same letters and digits: "cart-pendulum" and "CartPendulum" are cart_pendulum, θ is
/// theta. One with the same capital letters is preferred. Empty: none.
[[nodiscard]] std::string same_letters(std::string_view name, std::span<const std::string> candidates);

/// The candidate with the same letters, or else that at the least distance, the first of several; empty when
/// none is near. Near means at most two edits that leave at least one letter as it was: 'kk' is near 'k', but
/// 'x' is not near 'm'. Where none is near, the only candidate that begins with the word or has it between
/// underscores: 'cart' stands for cart_pendulum, but 'pendulum' may be one of many.
[[nodiscard]] std::string closest(std::string_view word, std::span<const std::string> candidates);

}  // namespace qdot::api
