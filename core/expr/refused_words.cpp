#include "core/expr/refused_words.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace qdot {
namespace {

/// Functions of other programs and of books, and how to write them here.
constexpr auto other_functions = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"ln", "log(...)"},
    {"arcsin", "asin(...)"},
    {"arccos", "acos(...)"},
    {"arctan", "atan(...)"},
    {"arctg", "atan(...)"},
    {"tg", "tan(...)"},
    {"sgn", "sign(...)"},
    {"fabs", "abs(...)"},
    {"radians", "30*deg"},
    {"deg2rad", "30*deg"},
    {"rad", "a number alone, which is in radians"},
    {"pow", "x^2"},
    {"cot", "1/tan(...)"},
    {"sec", "1/cos(...)"},
    {"csc", "1/sin(...)"},
    {"heaviside", "(1 + sign(...))/2"},
    {"Heaviside", "(1 + sign(...))/2"},
    {"step", "(1 + sign(...))/2"},
    {"diff", "x_dot for the derivative of x by the time"},
    {"Derivative", "x_dot for the derivative of x by the time"},
    {"D", "x_dot for the derivative of x by the time"},
    {"dot", "x_dot for the derivative of x by the time"},
});

}  // namespace

std::string_view function_here(std::string_view name) {
  const auto* const other =
      std::ranges::find(other_functions, name, [](const auto& pair) { return pair.first; });
  return other == other_functions.end() ? std::string_view() : other->second;
}

std::string product_of(std::string_view word, std::span<const std::string> names) {
  constexpr std::size_t longest = 40;
  if (word.size() > longest) return {};
  std::vector<std::optional<std::vector<std::string>>> best(word.size() + 1);  // of what the word begins with
  best[0].emplace();
  for (std::size_t end = 1; end <= word.size(); ++end) {
    for (const std::string& name : names) {
      if (name.empty() || !word.substr(0, end).ends_with(name) || !best[end - name.size()]) continue;
      auto made = *best[end - name.size()];
      made.push_back(name);
      if (!best[end] || made.size() < best[end]->size()) best[end] = std::move(made);
    }
  }
  if (!best.back() || best.back()->size() < 2) return {};
  std::string product;
  for (const std::string& name : *best.back()) product += (product.empty() ? "" : "*") + name;
  return product;
}

}  // namespace qdot
