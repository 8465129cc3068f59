#pragma once
// What the rules of a request table may do that look at more than one field: report what is wrong, each error
// at its place, and correct the echo where fields depend on each other (api/contract/request_table.hpp).

#include <algorithm>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/contract/field_values.hpp"
#include "api/contract/submission.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

class Findings {
 public:
  Findings(Road road, Json& echo, Errors& errors, const std::vector<std::string>& defaulted,
           const ExactNumbers& exact)
      : root_(road), echo_(&echo), errors_(&errors), defaulted_(&defaulted), exact_(&exact) {}

  void report(const std::string& field, std::string code, std::string detail);
  void add(FieldError error) { errors_->push_back(std::move(error)); }
  /// The whole request.
  [[nodiscard]] const Place& root() const { return root_; }
  [[nodiscard]] Json& echo() { return *echo_; }
  /// Was the field left out, so that the echo has its default?
  [[nodiscard]] bool is_defaulted(std::string_view field) const {
    return std::ranges::find(*defaulted_, field) != defaulted_->end();
  }
  /// The number or the list of numbers that was typed, of which the request has the doubles.
  [[nodiscard]] Real exact(std::string_view field, double rounded) const;
  [[nodiscard]] Reals exact(std::string_view field, std::span<const double> rounded) const;
  /// Is something wrong with one of these fields already? A rule about them would only repeat it.
  [[nodiscard]] bool has_error_at(std::initializer_list<std::string_view> fields) const;

 private:
  Place root_;
  Json* echo_;
  Errors* errors_;
  const std::vector<std::string>* defaulted_;
  const ExactNumbers* exact_;
};

}  // namespace qdot::api
