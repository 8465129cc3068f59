#pragma once
// The one JSON type of this room. Objects keep the order in which they were written, so that a scene reads
// the same on the way out and an answer's fields come in the order that the code gives them.

#include <concepts>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace nlohmann {

// How an object or an array gives its memory back. The library's own destroy() first moves all values below
// it to a vector, so that no depth of nesting overflows the stack: it allocates in a destructor, and where
// that fails the process ends, while a request that memory fails for has to cost that request alone
// (tests/faults/allocation_test.cpp). The library has no public place for another way: the vector's allocator
// is fixed, and a container of ours, or an allocator of ours, is asked only after the vector was filled. This
// one recurses; no document of ours is deep (limits::json_depth).
static_assert(NLOHMANN_JSON_VERSION_MAJOR == 3 && NLOHMANN_JSON_VERSION_MINOR == 11,
              "json_value::destroy is private to the library: read it again in this version");
template <>
inline void basic_json<ordered_map>::json_value::destroy(value_t type) {
  const auto give_back = [](auto* value) {
    std::allocator<std::remove_pointer_t<decltype(value)>> allocator;
    std::destroy_at(value);
    allocator.deallocate(value, 1);
  };
  if (type == value_t::object) give_back(object);
  if (type == value_t::array) give_back(array);
  if (type == value_t::string) give_back(string);
  if (type == value_t::binary) give_back(binary);
}

}  // namespace nlohmann

namespace qdot::api {

using Json = nlohmann::ordered_json;

/// The library compares with a literal by making JSON of it: that takes memory, and may not fail.
[[nodiscard]] inline bool is_text(const Json& json, std::string_view text) {
  return json.is_string() && json.get_ref<const std::string&>() == text;
}
template <std::same_as<Json> Given>
bool operator==(const Given& json, const char* text) = delete;
template <std::same_as<Json> Given>
bool operator!=(const Given& json, const char* text) = delete;

}  // namespace qdot::api
