#pragma once
// Words for what a question has a few answers to, in the sentences in which students say them.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace qdot::api {

/// In small letters, with blanks for hyphens and underscores, without a full stop.
[[nodiscard]] std::string as_words(std::string_view text);

/// The answers among which `word` is one: stable, unstable, neutral; none where it is alone.
[[nodiscard]] std::span<const std::string_view> choices_with(std::string_view word);

/// The one of the choices of which a text speaks: "It is stable." is stable. None where it says more than
/// that
/// ("not stable", "asymptotically stable") or nothing of it.
[[nodiscard]] std::optional<std::string_view> spoken_choice(std::string_view text,
                                                            std::span<const std::string_view> choices);

}  // namespace qdot::api
