#include "api/contract/submission.hpp"

#include "api/json/limits.hpp"
#include "api/json/pointer.hpp"
#include "api/json/text.hpp"

namespace qdot::api {

Place Place::of_document() {
  Place place(Road::body);
  place.name_ = root_pointer;
  return place;
}

Place Place::below(std::string_view key) const {
  Place place(road_);
  place.name_ = road_ == Road::query ? printable(key, limits::name_bytes)
                                     : api::below(name_.empty() ? std::string(root_pointer) : name_, key);
  return place;
}

Place Place::below(std::size_t index) const {
  Place place(*this);
  if (road_ == Road::body) place.name_ = api::below(name_, index);
  return place;
}

Place Place::of_missing(std::string_view field) const { return name_.empty() ? below(field) : *this; }

FieldError Place::error(std::string code, std::string detail) const {
  FieldError error{.code = std::move(code), .detail = std::move(detail)};
  if (road_ == Road::query) {
    error.parameter = name_;
  } else {
    error.pointer = name_.empty() ? std::string(root_pointer) : name_;
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
  return Submission{
      .road = Road::body, .fields = std::move(document.value), .errors = std::move(document.duplicates)};
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
