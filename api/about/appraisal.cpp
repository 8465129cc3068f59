#include "api/about/appraisal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "api/contract/json_reader.hpp"
#include "api/contract/submission.hpp"
#include "api/contract/written_value.hpp"
#include "api/http/address.hpp"
#include "api/json/limits.hpp"
#include "core/integrate/methods.hpp"
#include "core/numerics/function.hpp"

namespace qdot::api {
namespace {

// Milliseconds of one core, as measured with the systems of the catalogue.
constexpr double per_second_of_motion = 0.1;   // integrated twice, to measure the error
constexpr double per_number = 4e-4;            // of a trajectory, computed and printed
constexpr double per_event = 0.3;              // of the cost of the motion
constexpr double longest = 3000;               // the limits of a run end it there
constexpr double light = 10;                   // what costs more waits in the heavy lane
constexpr std::size_t bytes_per_number = 100;  // while the answer is made

/// A body above this size is not read for its appraisal: its size alone makes it expensive.
constexpr std::size_t largest_read = 8 * 1024;
constexpr double unread = 100;  // milliseconds

/// Cost of deriving a system that the request brings along, by its number of coordinates: chains of
/// pendulums of 4, 5, 6 and 8 links take 30, 75, 300 and 1000 ms.
double derivation(const Json& fields) {
  const auto system = fields.find("system");
  if (system == fields.end() || !system->is_object()) return 0;
  const auto coordinates = system->find("coordinates");
  if (coordinates == system->end() || !coordinates->is_array()) return 0;
  return 0.5 + 0.03 * power(std::min<double>(static_cast<double>(coordinates->size()), 20), 5.0);
}

std::optional<double> number(const Json& fields, const char* name, std::string_view unit) {
  const auto field = fields.find(name);
  if (field == fields.end()) return std::nullopt;
  if (field->is_number()) return field->get<double>();
  if (!field->is_string()) return std::nullopt;
  ParameterScope numbers_only;
  const auto value = written_value(field->get_ref<const std::string&>(), unit, numbers_only);
  const auto* found = std::get_if<Real>(&value);
  return found == nullptr ? std::nullopt : std::optional(found->value);
}

/// How much more a method costs than the Taylor method, for the same motion.
double factor_of_method(const Json& fields) {
  const auto method = fields.find("method");
  if (method == fields.end() || !method->is_string()) return 1;
  const auto found = std::ranges::find(methods(), method->get_ref<const std::string&>(), &MethodRecord::name);
  return found == methods().end() ? 1 : found->relative_cost;
}

double length_of(const Json& fields) {
  if (const auto end = number(fields, "t_end", "s")) {
    return std::abs(*end - number(fields, "t_start", "s").value_or(0));
  }
  if (const auto strides = number(fields, "steps", "1")) return *strides;
  const auto times = fields.find("times");
  const bool listed = times != fields.end() && times->is_array() && !times->empty();
  return listed && times->back().is_number() ? std::abs(times->back().get<double>()) : 10;
}

std::size_t entries(const Json& fields, const char* name) {
  const auto field = fields.find(name);
  if (field == fields.end()) return 0;
  if (field->is_array()) return field->size();
  if (!field->is_string()) return 0;
  const auto& text = field->get_ref<const std::string&>();
  return 1 + static_cast<std::size_t>(std::ranges::count(text, ','));
}

/// Numbers of the trajectory; an extra has about three columns, a state about five.
double numbers_of(const Json& fields, double length) {
  double rows = number(fields, "samples", "1").value_or(101);
  if (const auto dt = number(fields, "dt", "s"); dt && *dt > 0) rows = length / *dt;
  rows = std::max(rows, static_cast<double>(entries(fields, "times")));
  const double columns = 5 + 3 * static_cast<double>(entries(fields, "include"));
  const double numbers = rows * columns;
  return numbers > 0 ? std::min(numbers, static_cast<double>(limits::numbers)) : 0;
}

Appraisal of_motion(const Json& fields, Appraisal result) {
  const double length = length_of(fields);
  const double numbers = numbers_of(fields, length);
  const double events = 1 + per_event * static_cast<double>(entries(fields, "events"));
  const double motion = length * per_second_of_motion * factor_of_method(fields) * events;
  result.milliseconds += (std::isfinite(motion) ? std::min(motion, longest) : longest) + numbers * per_number;
  result.bytes = static_cast<std::size_t>(numbers) * bytes_per_number;
  return result;
}

bool follows_motion(const Cost& cost, const Json& fields) {
  switch (cost.motion) {
    case Cost::Motion::always:
      return true;
    case Cost::Motion::up_to_t_end:
      return fields.contains("t_end");
    case Cost::Motion::none:
      break;
  }
  return false;
}

/// The fields of a request; nothing when there are none to tell a cost by.
std::optional<Json> fields_of(const Request& request) {
  if (request.method == "POST") {
    auto read = submission_of_body(request.body);
    auto* submission = std::get_if<Submission>(&read);
    return submission == nullptr ? std::nullopt : std::optional(std::move(submission->fields));
  }
  const auto target = parse_target(request.target);
  return target ? std::optional(submission_of_query(target->query).fields) : std::nullopt;
}

}  // namespace

Appraisal appraise(const Route& route, const Request& request) {
  Appraisal result{.route = route.pattern, .milliseconds = route.cost.milliseconds};
  if (request.body.size() > limits::large_body_bytes) return result;  // refused by its size
  if (request.body.size() > largest_read) {
    result.milliseconds += unread;
    result.bytes = request.body.size() * bytes_per_number;
  } else if (const auto fields = fields_of(request); fields && fields->is_object()) {
    result.milliseconds += derivation(*fields);
    if (!route.cost.each.empty()) {
      const std::size_t count = entries(*fields, std::string(route.cost.each).c_str());
      result.milliseconds *= static_cast<double>(std::max<std::size_t>(count, 1));
    }
    if (follows_motion(route.cost, *fields)) result = of_motion(*fields, result);
  }
  result.weight = result.milliseconds > light ? Weight::heavy : Weight::light;
  return result;
}

}  // namespace qdot::api
