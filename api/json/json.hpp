#pragma once
// The one JSON type of this room. Objects keep the order in which they were written, so that a scene reads
// the same on the way out and an answer's fields come in the order that the code gives them.

#include <memory>
#include <nlohmann/json.hpp>

namespace nlohmann {

// What gives an object's or an array's memory back. The library's own takes memory for it, in a destructor,
// where the want of it ends the process. This one recurses instead; no document of ours is deep
// (limits::json_depth).
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

}  // namespace qdot::api
