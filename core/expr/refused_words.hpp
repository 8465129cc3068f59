#pragma once
// What to write instead of a word that no expression has: other programs' functions, and products without *.

#include <span>
#include <string>
#include <string_view>

namespace qdot {

/// How to write a function of other programs and of books here: "log(...)" for ln; empty for others.
[[nodiscard]] std::string_view function_here(std::string_view name);

/// The fewest names that make up the word, with * between them: m*x for mx; empty where it is none of more
/// than one.
[[nodiscard]] std::string product_of(std::string_view word, std::span<const std::string> names);

}  // namespace qdot
