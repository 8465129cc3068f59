#include "api/contract/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <list>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include "api/json/pointer.hpp"
#include "api/json/slips.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

/// The problem of a text that breaks the grammar at `byte`, counted from 1.
Problem syntax_problem(std::string_view text, std::size_t byte, std::string detail) {
  const std::string_view before = text.substr(0, std::min(byte - 1, text.size()));
  const auto line = static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1;
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  const std::size_t column = before.size() - line_start + 1;
  detail += " Byte " + std::to_string(byte) + ", line " + std::to_string(line) + ", column " +
            std::to_string(column) + ".";
  return {.kind = ProblemKind::invalid_json,
          .detail = std::move(detail),
          .members = {{"byte", byte}, {"line", line}, {"column", column}}};
}

Problem grammar_problem(std::string_view text, std::size_t byte) {
  std::string slip = json_slip(text);
  if (slip.empty())
    slip = byte > text.size() ? "The JSON ends too early." : "This does not fit the grammar of JSON.";
  return syntax_problem(text, byte, std::move(slip));
}

constexpr std::size_t digits_of_doubles = 15;
constexpr std::size_t most_digits = 1000;

/// Digits from the first to the last that is not 0, before the exponent.
std::size_t significant_digits(std::string_view number) {
  number = number.substr(0, number.find_first_of("eE"));
  const std::size_t first = number.find_first_of("123456789");
  if (first == std::string_view::npos) return 0;
  const std::size_t last = number.find_last_of("123456789");
  const std::string_view digits = number.substr(first, last - first + 1);
  return digits.size() - static_cast<std::size_t>(std::ranges::count(digits, '.'));
}

/// Builds the document from the events of the parser, counting as it goes. Returning false ends the parse.
class Builder {
 public:
  Builder(std::string_view text, const JsonLimits& limits) : text_(text), limits_(limits) {}

  bool null() { return add(nullptr) != nullptr; }
  bool boolean(bool value) { return add(value) != nullptr; }
  bool number_integer(std::int64_t value) { return add(value) != nullptr; }
  bool number_unsigned(std::uint64_t value) { return add(value) != nullptr; }
  bool number_float(double value, const std::string& digits) {
    const std::size_t count = significant_digits(digits);
    if (value == 0 && count > 0) {
      problem = Problem{.kind = ProblemKind::invalid_json,
                        .detail = "The number " + in_quotes(digits) + " is beyond double precision."};
      return false;
    }
    if (count > most_digits) {
      problem = Problem{.kind = ProblemKind::limit_exceeded,
                        .detail = "A number has more than " + std::to_string(most_digits) + " digits."};
      return false;
    }
    if (add(value) == nullptr) return false;
    if (count > digits_of_doubles || std::abs(value) < std::numeric_limits<double>::min())
      document.numbers.emplace(place_of_last(), digits);
    return true;
  }
  bool string(std::string& value) { return add(std::move(value)) != nullptr; }
  bool binary(Json::binary_t& /*value*/) { return false; }  // no JSON text has any

  bool start_object(std::size_t /*unknown*/) { return open(Json::object()); }
  bool start_array(std::size_t /*unknown*/) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    Frame& frame = frames_.back();
    frame.key = std::move(name);
    frame.repeated = !frame.keys.insert(frame.key).second;
    if (frame.repeated) {
      document.duplicates.push_back({.pointer = pointer(),
                                     .code = "duplicate_field",
                                     .detail = in_quotes(frame.key) + " is given twice in one object."});
    }
    return true;
  }

  template <class Exception>
  bool parse_error(std::size_t byte, const std::string& /*token*/, const Exception& error) {
    constexpr int number_overflow = 406;
    problem = error.id == number_overflow
                  ? syntax_problem(text_, byte, "A number is beyond double precision.")
                  : grammar_problem(text_, std::max<std::size_t>(byte, 1));
    return false;
  }

  JsonDocument document;
  std::optional<Problem> problem;

 private:
  struct Frame {
    Json* container{};
    std::unordered_set<std::string> keys{};
    std::string key{};  ///< the one whose value is being read
    bool repeated{false};
  };

  /// Where the value went, or nullptr when there are too many.
  Json* add(Json value) {
    if (++nodes_ > limits_.nodes) {
      problem = Problem{.kind = ProblemKind::limit_exceeded,
                        .detail = "The JSON has more than " + std::to_string(limits_.nodes) + " values."};
      return nullptr;
    }
    if (frames_.empty()) return &(document.value = std::move(value));
    Frame& frame = frames_.back();
    if (frame.container->is_array()) {
      frame.container->push_back(std::move(value));
      return &frame.container->back();
    }
    if (frame.repeated) return &discarded_.emplace_back(std::move(value));
    // The key is known to be new: the library's own insertion would search for it, in quadratic time.
    auto& members = static_cast<Json::object_t::Container&>(frame.container->get_ref<Json::object_t&>());
    members.emplace_back(frame.key, std::move(value));
    return &members.back().second;
  }

  bool open(Json container) {
    if (frames_.size() == limits_.depth) {
      problem = Problem{.kind = ProblemKind::limit_exceeded,
                        .detail = "The JSON is nested more than " + std::to_string(limits_.depth) + " deep."};
      return false;
    }
    Json* place = add(std::move(container));
    if (place == nullptr) return false;
    frames_.push_back({.container = place});
    return true;
  }

  bool close() {
    frames_.pop_back();
    return true;
  }

  /// Of the value that was added last: in an array it is counted already.
  [[nodiscard]] std::string place_of_last() const {
    return frames_.empty() ? std::string(root_pointer) : pointer();
  }

  [[nodiscard]] std::string pointer() const {
    std::string result(root_pointer);
    for (const Frame& frame : frames_) {
      if (frame.key.size() > longest_key) break;  // an array's frame has no key
      result = frame.container->is_array() ? below(std::move(result), frame.container->size() - 1)
                                           : below(std::move(result), frame.key);
    }
    return result;
  }

  std::string_view text_;
  JsonLimits limits_;
  std::size_t nodes_{0};
  std::vector<Frame> frames_;
  std::list<Json> discarded_;  ///< values of repeated keys; a list, because frames point into it
};

}  // namespace

std::variant<JsonDocument, Problem> read_json(std::string_view text, const JsonLimits& limits) {
  if (text.size() > limits.bytes) {
    return Problem{.kind = ProblemKind::payload_too_large,
                   .detail = "The body has " + std::to_string(text.size()) + " bytes; at most " +
                             std::to_string(limits.bytes) + " are read."};
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return Problem{
        .kind = ProblemKind::invalid_json,
        .detail = "The body is empty; send a JSON object such as {\"system\": \"cart_pendulum\"}."};
  }
  // The parser would take NUL for the end of the text and ignore the rest.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    return syntax_problem(text, nul + 1, "JSON has no NUL bytes.");
  }
  Builder builder(text, limits);
  if (!Json::sax_parse(text.begin(), text.end(), &builder)) {
    return builder.problem.value_or(
        Problem{.kind = ProblemKind::invalid_json, .detail = "This is not JSON."});
  }
  return std::move(builder.document);
}

}  // namespace qdot::api
