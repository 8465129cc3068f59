#include "api/scenes/scene_values.hpp"

#include <string_view>

#include "api/json/limits.hpp"
#include "api/json/text.hpp"
#include "api/scenes/scene_reader.hpp"

namespace qdot::api {
namespace {

/// The string, or null with a report when this is no string of 1 to `most` bytes.
const std::string* text_of(const Cursor& cursor, std::string_view expected, std::size_t most) {
  if (!cursor.value().is_string()) {
    cursor.report_type(expected);
    return nullptr;
  }
  const auto& text = cursor.value().get_ref<const std::string&>();
  if (!text.empty() && text.size() <= most) return &text;
  cursor.report(text.empty() ? "empty" : "limit", "This must be " + std::string{expected} + " of 1 to " +
                                                      std::to_string(most) + " bytes; it has " +
                                                      std::to_string(text.size()) + ".");
  return nullptr;
}

void report_name(const Cursor& cursor, std::string_view name) {
  cursor.report("bad_name",
                api::quoted(name) +
                    " cannot be a name: use at most 64 ASCII letters, digits and underscores after a "
                    "letter, no _dot or _ddot at the end, and neither t, pi nor a function's name.");
}

bool check_name(const Cursor& cursor, std::string_view name) {
  if (is_scene_name(name)) return true;
  report_name(cursor, name);
  return false;
}

/// A name with or without _dot.
bool is_symbol(std::string_view text) {
  if (text.ends_with("_dot")) text.remove_suffix(std::string_view{"_dot"}.size());
  return is_scene_name(text);
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// An object of at most map_entries entries whose names pass `is_key`.
template <class Reader>
void read_pairs(const Cursor& cursor, bool (*is_key)(std::string_view), Reader read, Pairs& target) {
  if (!cursor.value().is_object()) return cursor.report_type("an object");
  if (cursor.value().size() > scene_limits::map_entries) {
    return cursor.report(
        "limit", "This object must have at most " + std::to_string(scene_limits::map_entries) + " entries.");
  }
  for (const auto& [key, value] : cursor.value().items()) {
    if (!is_key(key)) {
      report_name(cursor, key);
      continue;
    }
    read(cursor.field(key), target.emplace_back(key, std::string{}).second);
  }
}

}  // namespace

void read_name(const Cursor& cursor, std::string& target) {
  if (!cursor.value().is_string()) return cursor.report_type("a name in text, such as \"theta\"");
  const auto& text = cursor.value().get_ref<const std::string&>();
  if (check_name(cursor, text)) target = text;
}

void read_symbol(const Cursor& cursor, std::string& target) {
  if (!cursor.value().is_string()) return cursor.report_type("a symbol in text, such as \"theta\"");
  const auto& text = cursor.value().get_ref<const std::string&>();
  if (!is_symbol(text)) return report_name(cursor, text);
  target = text;
}

void read_word(const Cursor& cursor, std::string& target) {
  if (const auto* text = text_of(cursor, "a short text", limits::name_bytes)) target = *text;
}

void read_prose(const Cursor& cursor, std::string& target) {
  if (const auto* text = text_of(cursor, "a text", scene_limits::text_bytes)) target = *text;
}

void read_expression(const Cursor& cursor, std::string& target) {
  if (cursor.value().is_number()) {
    target = cursor.value().dump();
  } else if (const auto* text =
                 text_of(cursor, "an expression, such as \"-l*cos(theta)\"", limits::expression_bytes)) {
    target = *text;
  }
}

void read_vector(const Cursor& cursor, std::vector<std::string>& target) {
  array(read_expression, 2, 3)(cursor, target);
}

void read_position(const Cursor& cursor, Position& target) {
  if (cursor.value().is_string()) return read_name(cursor, target.point);
  if (cursor.value().is_array()) return read_vector(cursor, target.components);
  cursor.report_type("the name of a point or an array of 2 or 3 expressions");
}

void read_sign(const Cursor& cursor, int& target) {
  const Json& value = cursor.value();
  if (value != 1 && value != -1) {
    return cursor.report("bad_value",
                         "The sign must be 1 (the reaction pushes outwards) or -1 (it pulls inwards).");
  }
  target = value.get<int>();
}

void read_crossing(const Cursor& cursor, Crossing& target) {
  const Json& value = cursor.value();
  if (value == "rising") {
    target = Crossing::rising;
  } else if (value == "falling") {
    target = Crossing::falling;
  } else if (value == "either") {
    target = Crossing::either;
  } else {
    cursor.report("bad_value", "The direction must be \"rising\", \"falling\" or \"either\".");
  }
}

void read_map(const Cursor& cursor, Pairs& target) { read_pairs(cursor, is_symbol, read_expression, target); }

void read_new_names(const Cursor& cursor, Pairs& target) {
  read_pairs(cursor, is_scene_name, read_name, target);
}

}  // namespace qdot::api
