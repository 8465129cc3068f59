#pragma once
// What to write instead of a sign that no expression has: signs of books, LaTeX's and other programs'.

#include <cstddef>
#include <string>
#include <string_view>

namespace qdot {

/// "text", or the beginning of it when it is longer than 40 bytes, quoted,
/// with what is not printable ASCII as ?.
[[nodiscard]] std::string excerpt(std::string_view text);

/// The function in whose brackets the text ends; empty where there is none.
[[nodiscard]] std::string_view function_around(std::string_view text);

/// One sentence without a full stop, on the byte text[at], where no token begins.
[[nodiscard]] std::string advice_on_sign(std::string_view text, std::size_t at);

}  // namespace qdot
