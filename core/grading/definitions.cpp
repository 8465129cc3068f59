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

/// The coordinate or velocity that a text writes, if it writes nothing else.
std::optional<std::string> state_variable(std::string_view text, const Symbols& symbols,
                                          const Vocabulary& vocabulary) {
  const ReadSubmission read = read_submission(text, symbols.t.graph(), vocabulary);
  if (read.equations.size() != 1 || read.equations[0].right) return std::nullopt;
  for (const auto* symbols_of_state : {&symbols.coordinates.value, &symbols.coordinates.rate}) {
    const auto found = std::ranges::find(*symbols_of_state, read.equations[0].left);
    if (found != symbols_of_state->end()) return std::get<Symbol>(found->node()).name;
  }
  return std::nullopt;
}

/// x1' = x2 behind definitions of both, by which they are the same velocity.
bool says_it_again(std::string_view left, std::string_view right, const Symbols& symbols,
                   const Vocabulary& declared, const Vocabulary& vocabulary) {
  if (state_variable(left, symbols, declared) || state_variable(right, symbols, declared)) return false;
  const auto one = state_variable(left, symbols, vocabulary);
  return one && one == state_variable(right, symbols, vocabulary);
}

bool defines(std::string_view line, const Symbols& symbols, const Vocabulary& declared,
             Vocabulary& vocabulary) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return false;
  std::string_view word = without_ends(line.substr(equals + 1));
  std::string_view other = without_ends(line.substr(0, equals));
  if (!is_new_word(word, vocabulary)) std::swap(word, other);
  if (!is_new_word(word, vocabulary)) return says_it_again(word, other, symbols, declared, vocabulary);
  const auto name = state_variable(other, symbols, vocabulary);
  return name && vocabulary.add(std::string(word), *name);
}

/// Where the equation ends that begins at `first`: at the end of a line, a ; or a comma outside brackets.
std::size_t end_of_equation(std::string_view plain, std::size_t first) {
  int depth = 0;
  for (std::size_t i = first; i < plain.size(); ++i) {
    const char c = plain[i];
    if (c == '(' || c == '[' || c == '{') ++depth;
    if (c == ')' || c == ']' || c == '}') --depth;
    if (c == '\n' || c == ';' || (c == ',' && depth <= 0)) return i;
  }
  return plain.size();
}

}  // namespace

std::string without_definitions(std::string_view text, const Symbols& symbols, Vocabulary& vocabulary) {
  const std::string plain = plain_notation(text);
  const Vocabulary declared = vocabulary;
  std::string rest;
  for (std::size_t first = 0; first < plain.size();) {
    const std::size_t end = end_of_equation(plain, first);
    const std::string line = plain.substr(first, end - first);
    if (!defines(line, symbols, declared, vocabulary)) rest += line + plain.substr(end, 1);
    first = end + 1;
  }
  return rest;
}

}  // namespace qdot
