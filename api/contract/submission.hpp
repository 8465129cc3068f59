#pragma once
// A request before anything is known about it: an object of named values that came along one of two roads.

#include <concepts>
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
  WrittenNumbers numbers{};          ///< of a body
};

/// Where a value is, in the words of its road: "#/parameters/kk", or the query's parameter "kk". The words
/// are put together only for an error: until then a place refers to the place above it and to its own key,
/// which have to live as long. A place below a temporary one keeps its words.
class Place {
 public:
  /// The whole request.
  explicit Place(Road road) : road_(road) {}
  /// The same with the digits of its numbers, which have to live as long.
  explicit Place(const Submission& submission) : road_(submission.road), numbers_(&submission.numbers) {}
  /// The whole of a document that is no request, such as the file of a scene.
  [[nodiscard]] static Place of_document(const WrittenNumbers* numbers = nullptr);

  [[nodiscard]] Place below(std::string_view key) const& { return {*this, key, no_index}; }
  [[nodiscard]] Place below(std::size_t index) const& { return {*this, {}, index}; }
  [[nodiscard]] Place below(std::string_view key) && {
    return {road_, std::as_const(*this).below(key).words(), numbers_};
  }
  [[nodiscard]] Place below(std::size_t index) && {
    return {road_, std::as_const(*this).below(index).words(), numbers_};
  }
  template <std::same_as<std::string> Temporary>
  Place below(Temporary&& key) const = delete;
  /// Where a field is missed. In a request it is the field itself, so that a body and a query get the same
  /// error; in an object inside, or in a document, the object, because a pointer leads to something sent.
  [[nodiscard]] Place of_missing(std::string_view field) const;

  [[nodiscard]] Road road() const { return road_; }
  [[nodiscard]] FieldError error(std::string code, std::string detail) const;
  /// The number here as it was written: the decimal, not the double nearest to it.
  [[nodiscard]] std::string written(const Json& number) const;

 private:
  static constexpr auto no_index = static_cast<std::size_t>(-1);

  Place(Road road, std::string words, const WrittenNumbers* numbers)
      : road_(road), words_(std::move(words)), numbers_(numbers) {}
  Place(const Place& above, std::string_view key, std::size_t index)
      : road_(above.road_), above_(&above), key_(key), index_(index), numbers_(above.numbers_) {}
  [[nodiscard]] std::string words() const;

  Road road_;
  const Place* above_{};
  std::string_view key_{};
  std::size_t index_{no_index};
  std::string words_{};  ///< where there is no place above: pointer or parameter; empty: the whole request
  const WrittenNumbers* numbers_{};  ///< may be null
};

/// One JSON object.
[[nodiscard]] std::variant<Submission, Problem> submission_of_body(std::string_view body,
                                                                   const JsonLimits& limits = {});

[[nodiscard]] Submission submission_of_query(const std::vector<std::pair<std::string, std::string>>& query);

}  // namespace qdot::api
