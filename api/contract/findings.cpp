#include "api/contract/findings.hpp"

#include <algorithm>
#include <utility>

namespace qdot::api {
namespace {

/// Is `error` about the value at `place`, or about something inside it?
bool concerns(const FieldError& error, const FieldError& place) {
  if (!place.parameter.empty()) return error.parameter == place.parameter;
  return error.pointer == place.pointer || error.pointer.starts_with(place.pointer + "/");
}

}  // namespace

void Findings::report(const std::string& field, std::string code, std::string detail) {
  errors_->push_back(root_.below(field).error(std::move(code), std::move(detail)));
}

Real Findings::exact(std::string_view field, double rounded) const {
  return exact(field, std::span(&rounded, 1)).exact(0);
}

Reals Findings::exact(std::string_view field, std::span<const double> rounded) const {
  Reals numbers(rounded);
  const auto typed = exact_->find(field);
  if (typed == exact_->end()) return numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers.set(i, typed->second[i]);
  return numbers;
}

bool Findings::has_error_at(std::initializer_list<std::string_view> fields) const {
  return std::ranges::any_of(fields, [&](std::string_view field) {
    const FieldError place = root_.below(field).error("", "");
    return std::ranges::any_of(*errors_, [&](const FieldError& error) { return concerns(error, place); });
  });
}

}  // namespace qdot::api
