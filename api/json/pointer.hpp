#pragma once
// JSON Pointers (RFC 6901) in the form that problems use: as a fragment, "#/parameters/kk".

#include <cstddef>
#include <string>
#include <string_view>

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

}  // namespace qdot::api
