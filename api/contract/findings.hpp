#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/contract/field_values.hpp"
#include "api/contract/submission.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

/// What a check may do: report, and correct the echo where fields depend on each other.
class Findings {
 public:
  Findings(Road road, Json& echo, Errors& errors, const std::vector<std::string>& defaulted)
      : root_(road), echo_(&echo), errors_(&errors), defaulted_(&defaulted) {}

  void report(const std::string& field, std::string code, std::string detail);
  void add(FieldError error) { errors_->push_back(std::move(error)); }
  /// The whole request.
  [[nodiscard]] const Place& root() const { return root_; }
  [[nodiscard]] Json& echo() { return *echo_; }
  /// Was the field left out, so that the echo has its default?
  [[nodiscard]] bool is_defaulted(std::string_view field) const {
    return std::ranges::find(*defaulted_, field) != defaulted_->end();
  }
  /// Is something wrong with one of these fields already? A rule about them would only repeat it.
  [[nodiscard]] bool has_error_at(std::initializer_list<std::string_view> fields) const;

 private:
  Place root_;
  Json* echo_;
  Errors* errors_;
  const std::vector<std::string>* defaulted_;
};

}  // namespace qdot::api
