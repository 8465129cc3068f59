#include "api/scenes/scene_fields.hpp"

#include <algorithm>

#include "api/json/limits.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

std::string pointer_token(std::string_view name) {
  std::string token;
  for (const char letter : name) {
    if (letter == '~') {
      token += "~0";
    } else if (letter == '/') {
      token += "~1";
    } else {
      token += letter;
    }
  }
  return token;
}

std::string type_in_words(const Json& value) {
  if (value.is_null()) return "null";
  if (value.is_boolean()) return "true or false";
  return (value.is_object() || value.is_array() ? "an " : "a ") + std::string{value.type_name()};
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void report_unknown(const Cursor& object, const std::string& name, const std::vector<std::string>& names) {
  const std::string nearest = closest(name, names);
  const std::string help =
      nearest.empty() ? "The fields are " + joined(names) + "." : "Did you mean '" + nearest + "'?";
  const std::string message = "Unknown field " + api::quoted(name) + ". " + help;
  // A place repeats what was sent, so an overlong or unprintable name is reported at its object.
  const bool repeatable = printable(name, limits::name_bytes) == name;
  (repeatable ? object.field(name) : object).report("unknown_field", message);
}

}  // namespace

Cursor Cursor::field(const std::string& name) const {
  return {value_->at(name), place_ + "/" + pointer_token(name), *diagnostics_};
}

Cursor Cursor::element(std::size_t index) const {
  return {value_->at(index), place_ + "/" + std::to_string(index), *diagnostics_};
}

void Cursor::report(std::string code, std::string message) const {
  if (diagnostics_->size() < limits::listed_errors) {
    diagnostics_->push_back({place_, std::move(code), std::move(message)});
  }
}

void Cursor::report_type(std::string_view expected) const {
  report("wrong_type", "This must be " + std::string{expected} + ", not " + type_in_words(*value_) + ".");
}

bool check_object(const Cursor& cursor, const std::vector<std::string>& names) {
  if (!cursor.value().is_object()) {
    cursor.report_type("an object with the fields " + joined(names));
    return false;
  }
  for (const auto& [name, value] : cursor.value().items()) {
    if (std::find(names.begin(), names.end(), name) == names.end()) report_unknown(cursor, name, names);
  }
  return true;
}

bool check_array(const Cursor& cursor, std::size_t least, std::size_t most) {
  if (!cursor.value().is_array()) {
    cursor.report_type("an array");
    return false;
  }
  const std::size_t size = cursor.value().size();
  if (size >= least && size <= most) return true;
  cursor.report("limit", "This array has " + std::to_string(size) + " elements; it must have " +
                             (least == 0 ? "at most " : std::to_string(least) + " to ") +
                             std::to_string(most) + ".");
  return false;
}

}  // namespace qdot::api
