#include "api/answers/check/number_notation.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <utility>

#include "api/json/text.hpp"
#include "core/base/error.hpp"
#include "core/grading/plain_notation.hpp"
#include "core/mechanics/unit_names.hpp"
#include "core/mechanics/units.hpp"

namespace qdot::api {
namespace {

using Replacements = std::span<const std::pair<std::string_view, std::string_view>>;

constexpr std::size_t longest_number = 400;  // bytes
constexpr std::size_t longest_name = 40;
constexpr std::size_t longest_latex = 4096;  // whose commands stand inside each other

constexpr auto of_latex = std::to_array<std::pair<std::string_view, std::string_view>>({{"^{\\circ}", "°"},
                                                                                        {"^\\circ", "°"},
                                                                                        {"^{\\degree}", "°"},
                                                                                        {"\\degree", "°"},
                                                                                        {"\\circ", "°"},
                                                                                        {"\\pm", "±"},
                                                                                        {"\\approx", "≈"},
                                                                                        {"\\simeq", "≈"},
                                                                                        {"{,}", ","},
                                                                                        {"^{\\top}", "^T"},
                                                                                        {"^\\top", "^T"}});

constexpr auto of_signs = std::to_array<std::pair<std::string_view, std::string_view>>({{"−", "-"},
                                                                                        {"–", "-"},
                                                                                        {"⁄", "/"},
                                                                                        {"∕", "/"},
                                                                                        {"÷", "/"},
                                                                                        {"π", " pi "},
                                                                                        {"½", "(1/2)"},
                                                                                        {"\xC2\xA0", " "},
                                                                                        {"\xE2\x80\xAF", " "},
                                                                                        {"\xE2\x80\x89", " "},
                                                                                        {"\t", " "},
                                                                                        {"\n", " "},
                                                                                        {"arccos", "acos"},
                                                                                        {"arcsin", "asin"},
                                                                                        {"arctan", "atan"},
                                                                                        {" per ", "/"}});

constexpr auto raised_signs = std::to_array<std::pair<std::string_view, char>>({{"⁰", '0'},
                                                                                {"¹", '1'},
                                                                                {"²", '2'},
                                                                                {"³", '3'},
                                                                                {"⁴", '4'},
                                                                                {"⁵", '5'},
                                                                                {"⁶", '6'},
                                                                                {"⁷", '7'},
                                                                                {"⁸", '8'},
                                                                                {"⁹", '9'},
                                                                                {"⁻", '-'}});

bool digit_at(std::string_view text, std::size_t at) {
  return at < text.size() && text[at] >= '0' && text[at] <= '9';
}
bool letter_at(std::string_view text, std::size_t at) {
  return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0;
}

std::string replaced(std::string_view text, Replacements all) {
  std::string result;
  while (!text.empty()) {
    const auto found = std::ranges::find_if(all, [&](const auto& r) { return text.starts_with(r.first); });
    result += found == all.end() ? text.substr(0, 1) : found->second;
    text.remove_prefix(found == all.end() ? 1 : found->first.size());
  }
  return result;
}

/// "10⁻³" as "10^-3".
std::string with_powers(std::string_view text) {
  std::string result;
  bool is_raised = false;
  while (!text.empty()) {
    const auto sign =
        std::ranges::find_if(raised_signs, [&](const auto& s) { return text.starts_with(s.first); });
    const bool found = sign != raised_signs.end();
    if (found && !is_raised) result += '^';
    result += found ? sign->second : text.front();
    text.remove_prefix(found ? sign->first.size() : 1);
    is_raised = found;
  }
  return result;
}

/// "√2" as "sqrt(2)", "√(2)" as "sqrt(2)".
std::string with_roots(std::string_view text) {
  constexpr std::string_view root = "√";
  std::string result;
  while (!text.empty()) {
    if (!text.starts_with(root)) {
      result += text.front();
      text.remove_prefix(1);
      continue;
    }
    text.remove_prefix(root.size());
    const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
    result += end == 0 ? " sqrt" : " sqrt(" + std::string(text.substr(0, end)) + ")";
    text.remove_prefix(end);
  }
  return result;
}

/// The name before an equals sign goes from `text`; a sign that says "about" goes, too.
std::string take_name(std::string_view& text) {
  std::string name;
  const std::size_t equals = text.find('=');
  if (equals != std::string_view::npos && equals <= longest_name) {
    const std::string_view left = trimmed(text.substr(0, equals));
    const bool begins_a_name = left.empty() || letter_at(left, 0) || static_cast<signed char>(left[0]) < 0;
    if (!begins_a_name || left.find_first_of("+*/^<>") != std::string_view::npos) return name;
    name = left;
    text = trimmed(text.substr(equals + 1));
  }
  for (const std::string_view about : {"≈", "≃", "~"}) {
    if (text.starts_with(about)) text = trimmed(text.substr(about.size()));
  }
  return name;
}

/// "0.962 rad." ends a sentence.
std::string_view without_full_stop(std::string_view text) {
  if (!text.ends_with('.') || text.size() < 2) return text;
  const std::string_view before = text.substr(0, text.size() - 1);
  const bool has_point = before.find('.') != std::string_view::npos;
  return digit_at(before, before.size() - 1) && !has_point ? text : before;
}

/// Why a comma or a point between digits has two readings; empty: it has one.
std::string two_readings(std::string_view text) {
  constexpr std::string_view dot = "·";
  if (const std::size_t at = text.find(dot); at != std::string_view::npos && at > 0) {
    const std::size_t after = at + dot.size();
    const std::size_t end = std::min(text.find_first_not_of("0123456789", after), text.size());
    const bool is_whole = text.substr(0, at).find_first_not_of("+-0123456789") == std::string_view::npos;
    const bool is_product = end == after || (end < text.size() && text[end] != ' ' && !letter_at(text, end));
    if (is_whole && !is_product) return "A decimal has a point, 0.5, and a product a *.";
  }
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || !digit_at(text, comma + 1)) return "";
  const std::size_t first = text.find_first_of("0123456789");
  const std::size_t end = std::min(text.find_first_not_of("0123456789", comma + 1), text.size());
  const bool is_second =
      text.find_first_of(",.", comma + 1) != std::string_view::npos || text.find('.') < comma;
  const bool parts_thousands = end - comma == 4 && first < comma && text[first] != '0' && comma - first <= 3;
  return is_second || parts_thousands ? "Write a decimal with a point, and no comma between thousands." : "";
}

std::string with_decimal_points(std::string text) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == ',' && digit_at(text, i - 1) && digit_at(text, i + 1)) text[i] = '.';
  }
  return text;
}

/// "9.6 x 10^-1" with *.
std::string with_times(std::string text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] != 'x' && text[i] != 'X') continue;
    const std::size_t before = text.find_last_not_of(' ', i - 1);
    const std::size_t after = text.find_first_not_of(' ', i + 1);
    const bool is_power_of_ten =
        after != std::string::npos && text.compare(after, 2, "10") == 0 && !digit_at(text, after + 2);
    if (before != std::string::npos && digit_at(text, before) && is_power_of_ten) text[i] = '*';
  }
  return text;
}

bool is_factor_word(std::string_view word) {
  constexpr std::array words{"pi",   "sqrt", "sin",  "cos",  "tan", "asin",
                             "acos", "atan", "sinh", "cosh", "exp", "log"};
  return std::ranges::find(words, word) != words.end();
}

/// "2 pi", "2sqrt(3)" and "2(1+3)" with *.
std::string with_products(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (letter_at(text, end)) ++end;
    const std::string_view word = text.substr(i, end - i);
    const std::size_t last = result.find_last_not_of(' ');
    const bool follows_factor =
        last != std::string::npos && (digit_at(result, last) || result[last] == '.' || result[last] == ')' ||
                                      result.ends_with("pi") || result.ends_with("pi "));
    const bool opens = text[i] == '(' && follows_factor && !parse_unit(text.substr(i));
    if ((follows_factor && is_factor_word(word)) || opens) result += '*';
    result += word.empty() ? text.substr(i, 1) : word;
    i = word.empty() ? i + 1 : end;
  }
  return result;
}

/// "0.5 [rad]" without the brackets around the unit.
std::string_view unwrapped_unit(std::string_view text, std::string& room) {
  const std::size_t open = text.find('[');
  if (!text.ends_with(']') || open == 0 || open == std::string_view::npos) return text;
  const std::string_view unit = text.substr(open + 1, text.size() - open - 2);
  if (!parse_unit(unit)) return text;
  room = std::string(text.substr(0, open)) + " " + std::string(unit);
  return room;
}

}  // namespace

std::string number_without_latex(std::string_view text) {
  const bool has_braces =
      text.find("^{") != std::string_view::npos || text.find("{,}") != std::string_view::npos;
  if (text.find_first_of("\\$") == std::string_view::npos && !has_braces) return std::string(text);
  if (text.size() > longest_latex) throw Error(ErrorCode::too_large, "the text is longer than 4096 bytes");
  return without_latex(replaced(text, of_latex));
}

WrittenNumber written_number(std::string_view text, Commas commas) {
  WrittenNumber written;
  text = trimmed(text);
  if (text.size() > longest_number) {
    written.refused = "It is too long for a number.";
    return written;
  }
  std::string room;
  text = unwrapped_unit(text, room);
  written.name = take_name(text);
  text = without_full_stop(text);
  if (commas == Commas::are_decimal) {
    written.refused = two_readings(text);
    if (!written.refused.empty()) return written;
  }
  std::string plain = with_roots(with_powers(replaced(text, of_signs)));
  if (commas == Commas::are_decimal) plain = with_decimal_points(std::move(plain));
  plain = with_products(with_times(in_ascii(plain)));
  written.text = trimmed(plain);
  const std::string_view whole = written.text;
  const bool has_two =
      whole.ends_with(" 1") && digit_at(whole, whole.find_last_not_of(' ', whole.size() - 2));
  if (has_two) written.refused = "Two numbers stand side by side.";
  return written;
}

std::size_t unit_behind(std::string_view text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    const char before = text[i - 1];
    const bool may_begin =
        letter_at(text, i) && (before == ' ' || before == ')' || before == '*' || digit_at(text, i - 1));
    if (may_begin && parse_unit(text.substr(i))) return i;
  }
  return std::string_view::npos;
}

}  // namespace qdot::api
