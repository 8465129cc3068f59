#include "core/expr/parse.hpp"

namespace qdot {
namespace {

constexpr const char* event_forms = "write an event as theta=0, theta=0+ (rising) or theta=0- (falling)";

/// Parses a part of the text that begins at byte `begin`.
Expression parse_part(std::string_view part, std::size_t begin, Graph& graph,
                      std::span<const std::string> allowed_symbols) {
  try {
    return parse(part, graph, allowed_symbols);
  } catch (const Error& error) {
    throw Error(error.code(), error.what(), begin + error.offset());
  }
}

/// Cuts the sign that says which crossings count off the end of `text`.
Crossing take_passage(std::string_view& text) {
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos || (text[last] != '+' && text[last] != '-')) return Crossing::either;
  const Crossing passage = text[last] == '+' ? Crossing::rising : Crossing::falling;
  text = text.substr(0, last);
  return passage;
}

}  // namespace

ParsedEvent parse_event(std::string_view text, Graph& graph, std::span<const std::string> allowed_symbols) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) throw Error(ErrorCode::syntax, event_forms, text.size());
  const std::size_t second = text.find('=', equals + 1);
  if (second != std::string_view::npos) throw Error(ErrorCode::syntax, event_forms, second);
  std::string_view right = text.substr(equals + 1);
  const Crossing passage = take_passage(right);
  const Expression value = parse_part(text.substr(0, equals), 0, graph, allowed_symbols);
  return {value - parse_part(right, equals + 1, graph, allowed_symbols), passage};
}

}  // namespace qdot
