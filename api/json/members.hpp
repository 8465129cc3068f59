#pragma once
// The members of a JSON object as they were written: what is passed on keeps every digit.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace qdot::api {

/// Each key, decoded, with the text of its value. `object` is the text of an object that has been read before
/// (api/contract/json_reader.hpp), so that its grammar is known to be right.
[[nodiscard]] std::vector<std::pair<std::string, std::string_view>> members_of(std::string_view object);

}  // namespace qdot::api
