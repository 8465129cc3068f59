#pragma once
// Small documents from text and to text. The library's parser and writer are templates: compiled here once,
// they do not cost every file that uses them two seconds.

#include <string>
#include <string_view>

#include "api/json/json.hpp"

namespace qdot::api {

/// Of a text of ours; throws the library's parse_error.
[[nodiscard]] Json parse_json(std::string_view text);
/// Where the text is no JSON: the value that is_discarded(), neither object nor array.
[[nodiscard]] Json parse_json_or_discard(std::string_view text);

/// On one line, without spaces; throws where a string is not UTF-8.
[[nodiscard]] std::string dump_json(const Json& json);
/// The same; what is not UTF-8 is replaced.
[[nodiscard]] std::string dump_json_replacing(const Json& json);

}  // namespace qdot::api
