#pragma once
// What people write that is not JSON, by its name: a comma before }, single quotes, comments, NaN, None. The
// parser only tells where it stopped; this reads the text once more and says what to write instead.

#include <string>
#include <string_view>

namespace qdot::api {

/// One or two sentences about the first place of `text` that breaks the grammar (RFC 8259), or an empty text
/// where none of the known slips is found. Linear in the size of the text.
[[nodiscard]] std::string json_slip(std::string_view text);

}  // namespace qdot::api
