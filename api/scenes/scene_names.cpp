// Which names a scene may give.

#include <algorithm>

#include "api/json/limits.hpp"
#include "api/scenes/scene_reader.hpp"
#include "core/numerics/function.hpp"

namespace qdot::api {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_name_character(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; }

}  // namespace

const std::vector<std::string>& reserved_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result{"t", "pi", "sqrt"};
    result.insert(result.end(), function_names.begin(), function_names.end());
    return result;
  }();
  return names;
}

bool is_scene_name(std::string_view text) {
  const bool identifier = !text.empty() && text.size() <= limits::name_bytes && is_letter(text.front()) &&
                          std::all_of(text.begin(), text.end(), is_name_character);
  return identifier && !text.ends_with("_dot") && !text.ends_with("_ddot") &&
         std::find(reserved_names().begin(), reserved_names().end(), text) == reserved_names().end();
}

}  // namespace qdot::api
