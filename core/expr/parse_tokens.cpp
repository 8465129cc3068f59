#include "core/expr/parse_tokens.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/base/error.hpp"

namespace qdot {
namespace {

constexpr std::size_t longest_excerpt = 40;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool continues_name(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

std::size_t skip_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// Length of the number at the beginning of `text`: 12, 1.5, .5, 1e-3.
std::size_t number_length(std::string_view text) {
  std::size_t at = skip_digits(text, 0);
  if (at < text.size() && text[at] == '.') at = skip_digits(text, at + 1);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    const std::size_t end = skip_digits(text, exponent);
    if (end > exponent) at = end;
  }
  return at;
}

Number number_value(std::string_view text, std::size_t offset, const TextLimits& limits) {
  const bool integer = std::all_of(text.begin(), text.end(), is_digit);
  if (integer && text.size() > limits.integer_digits) {
    throw Error(ErrorCode::too_large,
                "the integer " + excerpt(text) + " has more than " + std::to_string(limits.integer_digits) +
                    " digits",
                offset);
  }
  if (const auto value = Number::written(text)) return *value;
  throw Error(ErrorCode::too_large, "the number " + excerpt(text) + " is outside the range of a double",
              offset);
}

std::optional<TokenKind> operator_kind(char c) {
  switch (c) {
    case '+':
      return TokenKind::plus;
    case '-':
      return TokenKind::minus;
    case '*':
      return TokenKind::times;
    case '/':
      return TokenKind::over;
    case '^':
      return TokenKind::power;
    case '(':
      return TokenKind::open;
    case ')':
      return TokenKind::close;
    default:
      return std::nullopt;
  }
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
    {"′", "write theta_dot for the velocity of theta"},
    {"’", "write theta_dot for the velocity of theta"},
    {"ẋ", "write x_dot for the velocity of x"},
    {"ẏ", "write y_dot for the velocity of y"},
    {"ż", "write z_dot for the velocity of z"},
    {"\xcc\x87", "write x_dot for the velocity of x"},  // the dot above the letter before
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

std::string advice_on(std::string_view rest) {
  const auto sign =
      std::ranges::find_if(signs_of_books, [&](const auto& pair) { return rest.starts_with(pair.first); });
  if (sign != signs_of_books.end()) return std::string(sign->second);
  return is_greek(rest) ? advice_on_greek(rest) : "expressions are ASCII: this sign is not";
}

[[noreturn]] void reject_character(std::string_view rest, std::size_t offset) {
  const char c = rest.front();
  std::string message = "an expression cannot contain " + excerpt(rest.substr(0, 1));
  if (static_cast<unsigned char>(c) >= 0x80) message = advice_on(rest);
  if (c == '\\') message = "leave out LaTeX's backslashes: names stand alone, pi, theta or sin(...)";
  if (c == '|') message = "write abs(...) for the absolute value";
  if (c == '<' || c == '>')
    message =
        "an expression compares nothing: 1 - x is not negative while x <= 1, and (1 + sign(t - 1))/2 is 0 "
        "before t = 1 and 1 after it";
  if (c == '=') message = "expected an expression, not an equation: '='";
  if (c == '[' || c == '{') message = "write ( and ) for brackets";
  if (c == ',') message = "every function takes one argument: unexpected ','; decimals have a point";
  if (c == '\'') message = "write theta_dot for the velocity of theta";
  throw Error(ErrorCode::syntax, message, offset);
}

/// Where programs have pi and functions from: math.pi, np.sqrt.
bool is_module(std::string_view name) {
  return name == "math" || name == "Math" || name == "np" || name == "numpy" || name == "sp" ||
         name == "sympy";
}

Token next_token(std::string_view text, std::size_t at, const TextLimits& limits) {
  const std::string_view rest = text.substr(at);
  const bool point_first = rest[0] == '.' && rest.size() > 1 && is_digit(rest[1]);
  if (is_digit(rest[0]) || point_first) {
    const std::string_view written = rest.substr(0, number_length(rest));
    if (rest.find("..") <= written.size())
      throw Error(ErrorCode::syntax, "a range is given by its ends, in fields of their own, not by ..", at);
    return {TokenKind::number, written, at, number_value(written, at, limits)};
  }
  if (is_letter(rest[0])) {
    const auto end = std::find_if_not(rest.begin(), rest.end(), continues_name);
    if (end != rest.end() && *end == '.' && is_module({rest.begin(), end})) {
      const auto last = std::find_if_not(end + 1, rest.end(), continues_name);
      throw Error(ErrorCode::syntax, "write pi, sqrt or sin, not " + excerpt({rest.begin(), last}), at);
    }
    return {TokenKind::name, rest.substr(0, static_cast<std::size_t>(end - rest.begin())), at, {}};
  }
  if (rest.starts_with("**")) return {TokenKind::power, rest.substr(0, 2), at, {}};
  const auto kind = operator_kind(rest[0]);
  if (!kind) reject_character(rest, at);
  return {*kind, rest.substr(0, 1), at, {}};
}

}  // namespace

std::string excerpt(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text.substr(0, longest_excerpt)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + "'";
}

std::vector<Token> tokenize(std::string_view text, const TextLimits& limits) {
  if (text.size() > limits.bytes) {
    throw Error(ErrorCode::too_large,
                "the expression is longer than " + std::to_string(limits.bytes) + " bytes", limits.bytes);
  }
  std::vector<Token> tokens;
  for (std::size_t at = 0; at < text.size();) {
    if (is_space(text[at])) {
      ++at;
      continue;
    }
    if (tokens.size() == limits.tokens) {
      throw Error(ErrorCode::too_large,
                  "the expression has more than " + std::to_string(limits.tokens) + " tokens", at);
    }
    tokens.push_back(next_token(text, at, limits));
    at += tokens.back().text.size();
  }
  tokens.push_back({TokenKind::end, text.substr(text.size()), text.size(), {}});
  return tokens;
}

}  // namespace qdot
