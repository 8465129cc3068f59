#include "api/answers/check/answer_sheet.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "api/answers/check/ranges.hpp"
#include "api/answers/check/request.hpp"
#include "api/contract/json_reader.hpp"
#include "api/json/limits.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t short_text = 4000;
constexpr std::size_t room_for_texts = 800'000;  // bytes of those that are longer, together

/// The cells of one row of CSV (RFC 4180), which may have line ends inside quotation marks.
std::vector<std::string> next_row(std::string_view& rest) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  std::size_t at = 0;
  for (; at < rest.size(); ++at) {
    const char c = rest[at];
    const bool is_doubled = is_quoted && c == '"' && at + 1 < rest.size() && rest[at + 1] == '"';
    if (is_doubled) {
      cells.back() += rest[at++];
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (is_quoted || (c != ',' && c != '\n' && c != '\r')) {
      cells.back() += c;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c == '\n') {
      ++at;
      break;
    }
  }
  rest.remove_prefix(at);
  return cells;
}

std::variant<Json, SheetError> answers_of_csv(std::string_view text) {
  if (next_row(text) != std::vector<std::string>{"id", "submitted"})
    return SheetError{"the answers are neither JSON nor CSV with a line id,submitted first"};
  Json answers = Json::object();
  while (!text.empty()) {
    const std::vector<std::string> row = next_row(text);
    if (row.size() == 1 && trimmed(row[0]).empty()) continue;
    if (row.size() != 2) return SheetError{"a row of the answers has not two cells"};
    if (answers.contains(row[0])) return SheetError{"there are two answers to " + in_quotes(row[0])};
    answers[row[0]] = row[1];
  }
  return answers;
}

std::variant<Json, SheetError> answers_of(std::string_view text) {
  if (constexpr std::string_view mark = "\xEF\xBB\xBF"; text.starts_with(mark))
    text.remove_prefix(mark.size());  // spreadsheets write it
  return trimmed(text).starts_with('{') ? sheet_object(text, "the answers", limits::answers_bytes)
                                        : answers_of_csv(text);
}

/// A long text for which there is no room in the request is left out, so that the other answers are graded.
Json left_out_where_too_long(const Json& submitted, std::size_t& room) {
  if (!submitted.is_string()) return submitted;
  const std::size_t bytes = submitted.get_ref<const std::string&>().size();
  if (bytes <= short_text) return submitted;
  if (bytes > room) return {{too_long, bytes}};
  room -= bytes;
  return submitted;
}

/// The item of a key with that id, or of that number where it has none; null where there is none.
Json* item_of(Json& items, const std::string& id) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool has_id = items[i].is_object() && items[i].contains("id");
    if (items[i].is_object() && (has_id ? items[i]["id"] == id : std::to_string(i + 1) == id))
      return &items[i];
  }
  return nullptr;
}

}  // namespace

std::variant<Json, SheetError> sheet_object(std::string_view text, const std::string& name,
                                            std::size_t most_bytes) {
  auto read = read_json(text, {.bytes = most_bytes, .nodes = limits::large_json_nodes});
  auto* document = std::get_if<JsonDocument>(&read);
  if (document == nullptr) return SheetError{name + ": " + std::get<Problem>(read).detail};
  if (!document->value.is_object() || !document->duplicates.empty())
    return SheetError{name + " needs a JSON object, each key once"};
  return std::move(document->value);
}

std::variant<Json, SheetError> graded_request(std::string_view key, std::string_view answers) {
  auto request = sheet_object(key, "the key", limits::large_body_bytes);
  if (std::holds_alternative<SheetError>(request)) return request;
  std::get<Json>(request).erase("variant");  // what was drawn is in the items
  request = original_key(std::get<Json>(request));
  if (std::holds_alternative<SheetError>(request)) return request;
  auto sheet = answers_of(answers);
  if (std::holds_alternative<SheetError>(sheet)) return sheet;
  Json& body = std::get<Json>(request);
  if (!body.contains("items") || !body["items"].is_array()) return SheetError{"the key has no array 'items'"};
  std::size_t room = room_for_texts;
  for (const auto& [id, submitted] : std::get<Json>(sheet).items()) {
    Json* item = item_of(body["items"], id);
    if (item == nullptr) return SheetError{"the key has no item " + in_quotes(id)};
    (*item)["submitted"] = left_out_where_too_long(submitted, room);
  }
  return request;
}

}  // namespace qdot::api
