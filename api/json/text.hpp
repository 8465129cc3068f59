#pragma once
// Other people's text inside our messages: short, printable, valid UTF-8, whatever was sent.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace qdot::api {

/// `text` with everything that is not printable UTF-8 replaced by U+FFFD, cut to at most `longest` bytes at a
/// character's end; "..." says that it was cut.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 40);

/// 'text', as above, in single quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);
[[nodiscard]] inline std::string quoted(std::string_view text) { return in_quotes(text); }

[[nodiscard]] bool is_utf8(std::string_view text);

/// Without spaces and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// ASCII letters to lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// "a, b or c"
[[nodiscard]] std::string enumerated(const std::vector<std::string>& words,
                                     std::string_view conjunction = "or");

}  // namespace qdot::api
