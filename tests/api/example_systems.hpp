#pragma once
// Two systems for the tests of requests, with names that clash on purpose; and the lookup that finds them.

#include <memory>
#include <string>
#include <variant>

#include "api/contract/request_table.hpp"

namespace qdot::api {

/// A forced pendulum of the names that requests use: parameters m, k, l, g; coordinates l_s and theta; input
/// F.
inline std::shared_ptr<const Scene> spring_pendulum() {
  constexpr Domain positive{.lower = 0, .lower_open = true};
  auto scene = std::make_shared<Scene>();
  scene->name = "spring_pendulum";
  scene->parameters = {{"m", "kg", "0.5", positive, "mass", ""},
                       {"k", "N/m", "40", {.lower = 0}, "stiffness", ""},
                       {"Omega", "rad/s", "1", {}, "rate of rotation", ""},
                       {"dt", "1", "2", {}, "a name that a field has too", ""}};
  scene->coordinates = {{"l", "m", "0.5", "0", "", positive, "length", ""},
                        {"theta", "rad", "0.1", "0", "l", {}, "angle", "\\theta"}};
  scene->inputs = {{"F", "N", "0", "force"}};
  scene->points = {{"bob", {"l*sin(theta)", "-l*cos(theta)"}}};
  return scene;
}

inline std::shared_ptr<const Scene> find_example(const Json& value, const Place& place, Errors& errors) {
  if (is_text(value, "spring_pendulum")) return spring_pendulum();
  errors.push_back(place.error("unknown_system", "There is no such system."));
  return nullptr;
}

template <class Request>
std::variant<Resolved<Request>, Problem> read_body(const RequestTable<Request>& table,
                                                   std::string_view body) {
  auto submission = submission_of_body(body);
  if (auto* problem = std::get_if<Problem>(&submission)) return *problem;
  return table.read(std::get<Submission>(submission), find_example);
}

template <class Request>
std::variant<Resolved<Request>, Problem> read_query(
    const RequestTable<Request>& table, const std::vector<std::pair<std::string, std::string>>& query) {
  return table.read(submission_of_query(query), find_example);
}

/// "#/parameters/kk unknown_field k|...": place, code and suggestion of each error, for short comparisons.
template <class Outcome>
std::string errors_of(const Outcome& outcome) {
  const auto* problem = std::get_if<Problem>(&outcome);
  if (problem == nullptr) return "none";
  std::string text;
  for (const FieldError& error : problem->errors) {
    if (!text.empty()) text += " | ";
    text += error.pointer + error.parameter + " " + error.code;
    if (!error.did_you_mean.empty()) text += " " + error.did_you_mean;
  }
  return text;
}

/// The detail of the only error.
template <class Outcome>
std::string detail_of(const Outcome& outcome) {
  const auto* problem = std::get_if<Problem>(&outcome);
  return problem == nullptr || problem->errors.size() != 1 ? errors_of(outcome) : problem->errors[0].detail;
}

}  // namespace qdot::api
