#include "api/contract/submission.hpp"

#include "api/json/documents.hpp"
#include "api/json/limits.hpp"
#include "api/json/pointer.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {

Place Place::of_document(const WrittenNumbers* numbers) {
  return {Road::body, std::string(root_pointer), numbers};
}

std::string Place::written(const Json& number) const {
  if (number.is_number_integer()) return dump_json(number);
  if (numbers_ != nullptr && !numbers_->empty()) {
    const auto found = numbers_->find(words());
    if (found != numbers_->end()) return found->second;
  }
  std::string text;
  append_number(text, number.get<double>());
  return text;
}

std::string Place::words() const {
  if (above_ == nullptr) return words_;
  const bool is_index = index_ != no_index;
  if (road_ == Road::query) return is_index ? above_->words() : printable(key_, limits::name_bytes);
  std::string above = above_->words();
  if (above.empty()) above = root_pointer;
  return is_index ? api::below(std::move(above), index_) : api::below(std::move(above), key_);
}

Place Place::of_missing(std::string_view field) const {
  const bool is_request = above_ == nullptr && words_.empty();
  return is_request ? below(field) : *this;
}

FieldError Place::error(std::string code, std::string detail) const {
  FieldError error{.code = std::move(code), .detail = std::move(detail)};
  std::string words = this->words();
  if (road_ == Road::query) {
    error.parameter = std::move(words);
  } else {
    error.pointer = words.empty() ? std::string(root_pointer) : std::move(words);
  }
  return error;
}

std::variant<Submission, Problem> submission_of_body(std::string_view body, const JsonLimits& limits) {
  auto read = read_json(body, limits);
  if (auto* problem = std::get_if<Problem>(&read)) return std::move(*problem);
  auto& document = std::get<JsonDocument>(read);
  if (!document.value.is_object()) {
    return invalid_request({Place(Road::body).error("wrong_type", "A request is a JSON object, {...}.")});
  }
  return Submission{.road = Road::body,
                    .fields = std::move(document.value),
                    .errors = std::move(document.duplicates),
                    .numbers = std::move(document.numbers)};
}

Submission submission_of_query(const std::vector<std::pair<std::string, std::string>>& query) {
  Submission submission{.road = Road::query};
  for (const auto& [name, value] : query) {
    if (submission.fields.contains(name)) {
      submission.errors.push_back(
          Place(Road::query)
              .below(name)
              .error("duplicate_field", in_quotes(name) + " is given twice in the query."));
    } else {
      submission.fields[name] = value;
    }
  }
  return submission;
}

}  // namespace qdot::api
