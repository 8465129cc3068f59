#pragma once
// JSON Pointers (RFC 6901) in the form that problems use: as a fragment, "#/parameters/kk".

#include <cstddef>
#include <string>
#include <string_view>

namespace qdot::api {

/// `pointer` and one step down. The key comes from a request: it is escaped for a URI fragment and cut to 64
/// bytes.
[[nodiscard]] std::string below(std::string pointer, std::string_view key);
[[nodiscard]] std::string below(std::string pointer, std::size_t index);

/// The pointer to the whole document.
inline constexpr std::string_view root_pointer = "#";

}  // namespace qdot::api
