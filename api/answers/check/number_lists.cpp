#include "api/answers/check/number_lists.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "api/json/text.hpp"
#include "core/base/error.hpp"
#include "core/mechanics/units.hpp"

namespace qdot::api {
namespace {

constexpr std::string_view opening = "([{<", closing = ")]}>";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "^T" or "'" behind a vector goes.
std::string_view without_transpose(std::string_view text) {
  text = trimmed(text);
  for (const std::string_view sign : {"^T", "^(T)", "^t", "^( T )", "'", "ᵀ"}) {
    const std::string_view before = trimmed(text.substr(0, text.size() - std::min(text.size(), sign.size())));
    const bool is_vector = !before.empty() && closing.find(before.back()) != std::string_view::npos;
    if (text.ends_with(sign) && is_vector) return before;
  }
  return text;
}

/// A list in one pair of brackets, and the unit behind them.
struct Bracketed {
  std::string_view inside;
  std::string_view unit{};
  bool is_square{};
};

Bracketed bracketed(std::string_view text) {
  text = without_transpose(text);
  const std::size_t kind = text.empty() ? std::string_view::npos : opening.find(text.front());
  if (kind == std::string_view::npos) return {text};
  const std::size_t end = text.rfind(closing[kind]);
  if (end == std::string_view::npos || end == 0) return {text};
  const std::string_view inside = text.substr(1, end - 1), behind = trimmed(text.substr(end + 1));
  const bool is_list = kind != 0 || inside.find_first_of(",;\n:") != std::string_view::npos;
  const bool is_one_pair = inside.find(closing[kind]) == std::string_view::npos || behind.empty();
  if (!is_list || !is_one_pair || (!behind.empty() && !parse_unit(behind))) return {text};
  return {inside, behind, kind == 1};
}

/// "2.3 and 4.7" with a comma.
std::string with_commas_for_words(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::size_t length = 0;
    for (const std::string_view word : {" and ", " or ", " und ", " et "}) {
      if (text.starts_with(word)) length = word.size();
    }
    result += length == 0 ? text.substr(0, 1) : std::string_view(" ; ");
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

enum class Parting { all_signs, no_tight_commas, blanks };

/// Whether a comma stands between two digits.
bool is_tight_comma(std::string_view text, std::size_t at) {
  return text[at] == ',' && at > 0 && at + 1 < text.size() && is_digit(text[at - 1]) &&
         is_digit(text[at + 1]);
}

std::vector<std::string_view> parts_of(std::string_view text, Parting parting) {
  const std::string_view signs = parting == Parting::blanks                             ? " "
                                 : text.find_first_of(",;\n") == std::string_view::npos ? ":"
                                                                                        : ",;\n";
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t start = 0;
  const auto end_part = [&](std::size_t end, bool is_needed) {
    const std::string_view part = trimmed(text.substr(start, end - start));
    if (is_needed || !part.empty()) parts.push_back(part);
    if (parts.size() > most_submitted)
      throw Error(ErrorCode::too_large, "the list has more than 10000 numbers");
    start = end + 1;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    const bool is_sign = depth == 0 && signs.find(text[i]) != std::string_view::npos;
    const bool is_decimal = parting == Parting::no_tight_commas && is_tight_comma(text, i);
    if (is_sign && !is_decimal) end_part(i, text[i] == ',');
  }
  end_part(text.size(), false);
  return parts;
}

/// "±a" as a and -a.
void add_with_signs(std::vector<WrittenNumber>& numbers, WrittenNumber number) {
  for (const std::string_view sign : {"±", "+-", "+/-"}) {
    if (!number.text.starts_with(sign)) continue;
    number.text = trimmed(std::string_view(number.text).substr(sign.size()));
    numbers.push_back(number);
    number.text = "-" + number.text;
  }
  numbers.push_back(std::move(number));
}

std::vector<WrittenNumber> numbers_of(const std::vector<std::string_view>& parts, Commas commas,
                                      std::string_view unit) {
  std::vector<WrittenNumber> numbers;
  for (const std::string_view part : parts) {
    WrittenNumber number = written_number(part, commas);
    if (!unit.empty()) number.text += " " + std::string(unit);
    add_with_signs(numbers, std::move(number));
  }
  return numbers;
}

/// [1 -5], as MATLAB has it.
bool has_blanks_only(const Bracketed& list) {
  return list.is_square && list.inside.find_first_not_of("0123456789.+-eE ") == std::string_view::npos;
}

}  // namespace

std::vector<WrittenNumber> written_numbers(std::string_view text, std::size_t wanted) {
  const std::string plain = with_commas_for_words(number_without_latex(text));
  const Bracketed list = bracketed(plain);
  if (trimmed(list.inside).empty()) return {};
  if (has_blanks_only(list))
    return numbers_of(parts_of(list.inside, Parting::blanks), Commas::part_numbers, list.unit);
  auto numbers = numbers_of(parts_of(list.inside, Parting::all_signs), Commas::part_numbers, list.unit);
  if (numbers.size() == wanted || list.inside.find('.') != std::string_view::npos) return numbers;
  auto others = numbers_of(parts_of(list.inside, Parting::no_tight_commas), Commas::are_decimal, list.unit);
  const bool has_semicolons = list.inside.find_first_of(";\n") != std::string_view::npos;
  return others.size() == wanted || has_semicolons ? others : numbers;
}

}  // namespace qdot::api
