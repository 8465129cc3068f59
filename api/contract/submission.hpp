#pragma once
// A request before anything is known about it: an object of named values that came along one of two roads.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "api/contract/json_reader.hpp"
#include "api/http/problem.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

enum class Road { body, query };

struct Submission {
  Road road{Road::body};
  Json fields = Json::object();      ///< in a query all values are texts and names are flat
  std::vector<FieldError> errors{};  ///< what is wrong already: names that were given twice
};

/// Where a value is, in the words of its road: "#/parameters/kk", or the query's parameter "kk".
class Place {
 public:
  /// The whole request.
  explicit Place(Road road) : road_(road) {}
  /// The whole of a document that is no request, such as the file of a scene.
  [[nodiscard]] static Place of_document();

  [[nodiscard]] Place below(std::string_view key) const;
  [[nodiscard]] Place below(std::size_t index) const;
  /// Where a field is missed. In a request it is the field itself, so that a body and a query are told the
  /// same; in an object inside, or in a document, the object, because a pointer leads to something sent.
  [[nodiscard]] Place of_missing(std::string_view field) const;

  [[nodiscard]] Road road() const { return road_; }
  [[nodiscard]] FieldError error(std::string code, std::string detail) const;

 private:
  Road road_;
  std::string name_;  ///< pointer or parameter; empty: the whole request
};

/// One JSON object.
[[nodiscard]] std::variant<Submission, Problem> submission_of_body(std::string_view body,
                                                                   const JsonLimits& limits = {});

[[nodiscard]] Submission submission_of_query(const std::vector<std::pair<std::string, std::string>>& query);

}  // namespace qdot::api
