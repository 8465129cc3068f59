#include "api/contract/names.hpp"

#include <algorithm>

#include "api/json/limits.hpp"
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

bool is_name(std::string_view text, NameOf of) {
  constexpr std::string_view velocity = "_dot";
  if (of == NameOf::thing_or_velocity && text.ends_with(velocity)) text.remove_suffix(velocity.size());
  const bool identifier = !text.empty() && text.size() <= limits::name_bytes && is_letter(text.front()) &&
                          std::ranges::all_of(text, is_name_character);
  return identifier && !text.ends_with("_dot") && !text.ends_with("_ddot") &&
         std::ranges::find(reserved_names(), text) == reserved_names().end();
}

}  // namespace qdot::api
