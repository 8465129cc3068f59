#include "core/grading/definitions.hpp"

#include <algorithm>
#include <optional>

#include "core/grading/student_functions.hpp"
#include "core/grading/student_parser.hpp"

namespace qdot {
namespace {

std::string_view without_ends(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool is_new_word(std::string_view text, const Vocabulary& vocabulary) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto continues = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !text.empty() && is_letter(text.front()) && std::ranges::all_of(text, continues) &&
         !vocabulary.find(text) && !is_function_word(text);
}

/// The velocity that a text writes, if it writes nothing else.
std::optional<std::string> velocity(std::string_view text, const Symbols& symbols,
                                    const Vocabulary& vocabulary) {
  const ReadSubmission read = read_submission(text, symbols.t.graph(), vocabulary);
  if (read.equations.size() != 1 || read.equations[0].right) return std::nullopt;
  const auto& rates = symbols.coordinates.rate;
  const auto found = std::ranges::find(rates, read.equations[0].left);
  if (found == rates.end()) return std::nullopt;
  return std::get<Symbol>(found->node()).name;
}

bool defines(std::string_view line, const Symbols& symbols, Vocabulary& vocabulary) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return false;
  std::string_view word = without_ends(line.substr(equals + 1));
  std::string_view other = without_ends(line.substr(0, equals));
  if (!is_new_word(word, vocabulary)) std::swap(word, other);
  if (!is_new_word(word, vocabulary)) return false;
  const auto name = velocity(other, symbols, vocabulary);
  return name && vocabulary.add(std::string(word), *name);
}

}  // namespace

std::string without_definitions(std::string_view text, const Symbols& symbols, Vocabulary& vocabulary) {
  const std::string plain = plain_notation(text);
  std::string rest;
  for (std::size_t first = 0; first < plain.size();) {
    const std::size_t end = std::min(plain.find_first_of("\n;", first), plain.size());
    const std::string line = plain.substr(first, end - first);
    if (!defines(line, symbols, vocabulary)) rest += line + plain.substr(end, 1);
    first = end + 1;
  }
  return rest;
}

}  // namespace qdot
