#include "core/grading/student_tokens.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "core/base/error.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_tokens = 2000;
constexpr std::size_t most_integer_digits = 17;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::size_t digits_from(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// Length of a number: 12, 1.5, .5, 2., 1e-3.
std::size_t length_of_number(std::string_view text) {
  std::size_t at = digits_from(text, 0);
  if (at < text.size() && text[at] == '.') at = digits_from(text, at + 1);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    const std::size_t end = digits_from(text, exponent);
    if (end > exponent) at = end;
  }
  return at;
}

Number value_of(std::string_view text, std::size_t offset) {
  const bool is_integer = std::ranges::all_of(text, is_digit);
  if (is_integer && text.size() > most_integer_digits)
    throw Error(ErrorCode::too_large, "a whole number has more than 17 digits", offset);
  if (const auto value = Number::written(text)) return *value;
  throw Error(ErrorCode::too_large, "a number is outside the range of a double", offset);
}

std::optional<Mark> mark_of(char c) {
  constexpr std::array<std::pair<char, Mark>, 19> marks{{{'\'', Mark::prime},
                                                         {'+', Mark::plus},
                                                         {'-', Mark::minus},
                                                         {'*', Mark::times},
                                                         {'/', Mark::over},
                                                         {'^', Mark::power},
                                                         {'(', Mark::open},
                                                         {'[', Mark::open},
                                                         {'{', Mark::open},
                                                         {')', Mark::close},
                                                         {']', Mark::close},
                                                         {'}', Mark::close},
                                                         {'|', Mark::bar},
                                                         {'=', Mark::equals},
                                                         {',', Mark::comma},
                                                         {':', Mark::colon},
                                                         {'\n', Mark::line},
                                                         {';', Mark::line},
                                                         {'\r', Mark::line}}};
  const auto found = std::ranges::find(marks, c, &std::pair<char, Mark>::first);
  return found == marks.end() ? std::nullopt : std::optional(found->second);
}

StudentToken next_token(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  const bool point_first = rest[0] == '.' && rest.size() > 1 && is_digit(rest[1]);
  if (is_digit(rest[0]) || point_first) {
    const std::string_view written = rest.substr(0, length_of_number(rest));
    return {.mark = Mark::number, .text = written, .offset = at, .value = value_of(written, at)};
  }
  if (is_letter(rest[0])) {
    const auto end =
        std::ranges::find_if_not(rest, [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
    return {.mark = Mark::name,
            .text = rest.substr(0, static_cast<std::size_t>(end - rest.begin())),
            .offset = at};
  }
  if (rest.starts_with("**")) return {.mark = Mark::power, .text = rest.substr(0, 2), .offset = at};
  if (rest.starts_with("==") || rest.starts_with(":="))
    return {.mark = Mark::equals, .text = rest.substr(0, 2), .offset = at};
  const auto mark = mark_of(rest[0]);
  if (!mark) throw Error(ErrorCode::syntax, "there is a character that formulas do not have", at);
  return {.mark = *mark, .text = rest.substr(0, 1), .offset = at};
}

bool needs_more(Mark mark) {
  return mark == Mark::plus || mark == Mark::minus || mark == Mark::times || mark == Mark::over ||
         mark == Mark::equals || mark == Mark::open || mark == Mark::power || mark == Mark::line;
}

bool goes_on(Mark mark) {
  return mark == Mark::plus || mark == Mark::times || mark == Mark::over || mark == Mark::equals ||
         mark == Mark::close;
}

/// Without the line ends inside brackets, or inside what clearly goes on in the next line.
std::vector<StudentToken> with_lines_joined(const std::vector<StudentToken>& tokens) {
  std::vector<StudentToken> joined;
  int depth = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const StudentToken& token = tokens[i];
    if (token.mark == Mark::open) ++depth;
    if (token.mark == Mark::close) --depth;
    const bool is_inside = token.mark == Mark::line && token.text != ";" &&
                           (depth > 0 || joined.empty() || needs_more(joined.back().mark) ||
                            goes_on(tokens[i + 1].mark));  // an end token is last
    if (!is_inside) joined.push_back(token);
  }
  return joined;
}

/// A point that ends a sentence, and no decimal.
bool is_full_stop(std::string_view plain, std::size_t at) {
  const bool ends = plain.find_first_not_of(" \t\r\n;", at + 1) == std::string_view::npos ||
                    plain[at + 1] == '\n' || plain[at + 1] == ';' || plain[at + 1] == '\r';
  return plain[at] == '.' && ends;
}

}  // namespace

std::vector<StudentToken> student_tokens(std::string_view plain) {
  std::vector<StudentToken> tokens;
  bool is_apart = true;
  for (std::size_t at = 0; at < plain.size();) {
    const bool is_blank = plain[at] == ' ' || plain[at] == '\t' || is_full_stop(plain, at);
    if (is_blank || plain.substr(at).starts_with("%pi")) {  // pi as Maxima has it
      is_apart = true;
      ++at;
      continue;
    }
    if (tokens.size() == most_tokens)
      throw Error(ErrorCode::too_large, "the formula has more than 2000 parts", at);
    tokens.push_back(next_token(plain, at));
    const std::size_t end = at + tokens.back().text.size();
    const bool is_word = is_apart && end < plain.size() && (plain[end] == ' ' || plain[end] == '\n');
    if (is_word && (tokens.back().text == "and" || tokens.back().text == "und"))
      tokens.back().mark = Mark::line;
    tokens.back().is_apart = std::exchange(is_apart, false);
    at += tokens.back().text.size();
  }
  tokens.push_back({.mark = Mark::end, .text = "", .offset = plain.size()});
  return with_lines_joined(tokens);
}

}  // namespace qdot
