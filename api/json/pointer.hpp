#pragma once
// JSON Pointers (RFC 6901): in the form that problems use, as a fragment, "#/parameters/kk"; and the plain
// ones that people send, "/modes/0/omega".

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {

/// The longest key that a pointer repeats: a name with _dot after it. What is wrong below a longer one is
/// reported at the object that has it, so that a pointer always leads somewhere and no answer is long.
inline constexpr std::size_t longest_key = limits::name_bytes + 4;

/// `pointer` and one step down, the key escaped for a URI fragment; `pointer` itself below an overlong key.
[[nodiscard]] std::string below(std::string pointer, std::string_view key);
[[nodiscard]] std::string below(std::string pointer, std::size_t index);

/// The pointer to the whole document.
inline constexpr std::string_view root_pointer = "#";

/// The steps of a plain pointer, "/modes/0/omega" as {"modes", "0", "omega"}, escapes decoded. None where it
/// is no pointer, or leads to the whole document.
[[nodiscard]] std::optional<std::vector<std::string>> steps_of(std::string_view pointer);

/// Whether a step has digits only, as indices have.
[[nodiscard]] bool is_made_of_digits(std::string_view step);

/// The index of an array that a step is. None where it is no index: 0 stands before no other digit, and no
/// array has more elements than numbers count.
[[nodiscard]] std::optional<std::size_t> index_of(std::string_view step);

/// What is one step down; null where nothing is.
[[nodiscard]] const Json* child_at(const Json& from, const std::string& step);

}  // namespace qdot::api
