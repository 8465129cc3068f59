#include "core/expr/refused_sign.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace qdot {
namespace {

constexpr std::size_t longest_excerpt = 40;

bool is_name_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// What a sign of books and word processors is in ASCII.
constexpr auto signs_of_books = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"½", "write 1/2 for the fraction"},
    {"⅓", "write 1/3 for the fraction"},
    {"¼", "write 1/4 for the fraction"},
    {"¾", "write 3/4 for the fraction"},
    {"√", "write sqrt(...) for the root"},
    {"—", "write - for a minus"},
    {"–", "write - for a minus"},
    {"−", "write - for a minus"},
    {"÷", "write / for a division"},
    {"×", "write * for a product"},
    {"·", "write * for a product"},
    {"⋅", "write * for a product"},
    {"∗", "write * for a product"},
    {"²", "write ^2 for the square"},
    {"³", "write ^3 for the cube"},
    {"°", "write 30*deg for 30 degrees"},
    {"ẋ", "write x_dot for the velocity of x"},
    {"ẏ", "write y_dot for the velocity of y"},
    {"ż", "write z_dot for the velocity of z"},
    {"∞", "there is no number for infinity"},
});

constexpr auto greek_letters = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"α", "alpha"}, {"β", "beta"},  {"γ", "gamma"}, {"δ", "delta"}, {"ε", "epsilon"}, {"ζ", "zeta"},
    {"η", "eta"},   {"θ", "theta"}, {"ϑ", "theta"}, {"κ", "kappa"}, {"λ", "lambda"},  {"μ", "mu"},
    {"ν", "nu"},    {"ξ", "xi"},    {"π", "pi"},    {"ρ", "rho"},   {"σ", "sigma"},   {"τ", "tau"},
    {"φ", "phi"},   {"ϕ", "phi"},   {"χ", "chi"},   {"ψ", "psi"},   {"ω", "omega"},   {"Ω", "Omega"},
    {"Δ", "Delta"}, {"Θ", "Theta"}, {"Φ", "Phi"},   {"Ψ", "Psi"},
});

constexpr std::string_view dot_above = "\xcc\x87";  ///< the letter before

/// "write omega for it, or omega_dot": the letter that the text begins with.
std::string advice_on_greek(std::string_view rest) {
  const auto letter =
      std::ranges::find_if(greek_letters, [&](const auto& pair) { return rest.starts_with(pair.first); });
  const std::string name = letter != greek_letters.end() ? std::string(letter->second) : "theta";
  if (letter != greek_letters.end() && rest.substr(letter->first.size()).starts_with(dot_above))
    return "write " + name + "_dot for the velocity of " + name;
  return "expressions are ASCII: write " + name + " for the Greek letter";
}

/// The first bytes of U+0370 to U+03FF.
bool is_greek(std::string_view rest) {
  const auto first = static_cast<unsigned char>(rest.front());
  return first == 0xce || first == 0xcf || (first == 0xcd && static_cast<unsigned char>(rest[1]) >= 0xb0);
}

std::string advice_on_foreign(std::string_view rest) {
  const auto sign =
      std::ranges::find_if(signs_of_books, [&](const auto& pair) { return rest.starts_with(pair.first); });
  if (sign != signs_of_books.end()) return std::string(sign->second);
  return is_greek(rest) ? advice_on_greek(rest) : "expressions are ASCII: this sign is not";
}

/// The name that the text ends with.
std::string_view last_name(std::string_view text) {
  const auto first = std::find_if_not(text.rbegin(), text.rend(), is_name_part).base();
  return text.substr(static_cast<std::size_t>(first - text.begin()));
}

/// What marks the velocity of what stands before it.
std::string advice_on_prime(std::string_view before) {
  const std::string_view name = last_name(before);
  const std::string q(name.empty() ? "theta" : name.substr(0, longest_excerpt));
  return "write " + q + "_dot for the velocity of " + q;
}

/// Functions of two arguments in other programs, and how to write them here.
constexpr auto of_two = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"pow", "x^2 for pow(x, 2)"},
    {"atan2", "atan(y/x), or atan(y/x) + pi where x < 0, for atan2(y, x)"},
    {"hypot", "sqrt(x^2 + y^2) for hypot(x, y)"},
    {"diff", "x_dot for the derivative of x by the time"},
    {"Derivative", "x_dot for the derivative of x by the time"},
});

std::string advice_on_comma(std::string_view text, std::size_t at) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (at > 0 && is_digit(text[at - 1]) && at + 1 < text.size() && is_digit(text[at + 1]))
    return "decimals have a point: unexpected ','";
  const std::string_view name = function_around(text.substr(0, at));
  const auto function = std::ranges::find(of_two, name, [](const auto& pair) { return pair.first; });
  if (function != of_two.end()) return "write " + std::string(function->second);
  return name.empty() ? "unexpected ','"
                      : "every function but max and min takes one argument: unexpected ','";
}

std::string advice_on_backslash(std::string_view rest) {
  for (const std::string_view dot : {"\\dot{", "\\dot "}) {
    if (!rest.starts_with(dot)) continue;
    const std::string_view behind = rest.substr(dot.size());
    const std::size_t length = std::min(behind.find_first_of("} "), longest_excerpt);
    return advice_on_prime(last_name(behind.substr(0, length)));
  }
  return "leave out LaTeX's backslashes: names stand alone, pi, theta or sin(...)";
}

}  // namespace

std::string_view function_around(std::string_view text) {
  int closed = 0;
  for (std::size_t at = text.size(); at-- > 0;) {
    if (text[at] == ')') ++closed;
    if (text[at] == '(' && closed-- == 0) return last_name(text.substr(0, at));
  }
  return {};
}

std::string excerpt(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text.substr(0, longest_excerpt)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + "'";
}

std::string advice_on_sign(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at), rest = text.substr(at);
  for (const std::string_view prime : {"'", "′", "’", dot_above.data()})
    if (rest.starts_with(prime)) return advice_on_prime(before);
  if (static_cast<unsigned char>(rest.front()) >= 0x80) return advice_on_foreign(rest);
  switch (rest.front()) {
    case '\\':
      return advice_on_backslash(rest);
    case '|':
      return "write abs(...) for the absolute value";
    case '<':
    case '>':
      return "an expression compares nothing: 1 - x is not negative while x <= 1, and (1 + sign(t - 1))/2 is 0 "
             "before t = 1 and 1 after it";
    case '=':
      return "an expression is no equation: for a = b write a - (b), which is zero";
    case '[':
    case '{':
      return "write ( and ) for brackets";
    case ',':
      return advice_on_comma(text, at);
    default:
      break;
  }
  if (rest.starts_with(".diff")) return advice_on_prime(before);
  return "an expression cannot contain " + excerpt(rest.substr(0, 1));
}

}  // namespace qdot
