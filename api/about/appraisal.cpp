#include "api/about/appraisal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "api/answers/endpoints.hpp"
#include "api/contract/json_reader.hpp"
#include "api/contract/submission.hpp"
#include "api/contract/written_value.hpp"
#include "api/http/address.hpp"
#include "api/json/limits.hpp"
#include "api/json/text.hpp"
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
constexpr double text_of_bytes = 0.18;         // of them, in the answer
constexpr double most_compressed = 1 << 20, per_compressed_byte = 5e-5;

/// A body above this size is not read for its appraisal: its size alone makes it expensive.
constexpr std::size_t largest_read = 32 * 1024;
constexpr double unread = 100;                                    // milliseconds
constexpr std::size_t unread_bytes = limits::batch_answer_bytes;  // of what may be any answer
constexpr double of_extended = 50;                                // times what the motion costs in doubles

struct OfSystem {
  std::string_view name;
  double factor;  ///< of the others' cost
};
constexpr std::array dear_systems{OfSystem{"compass_walker", 12}, OfSystem{"rod_pendulum", 4},
                                  OfSystem{"rod_spring_pendulum", 4}};

/// Cost of deriving a system that the request brings along, by its number of coordinates: chains of
/// pendulums of 4, 5, 6 and 8 links take 30, 75, 300 and 1000 ms.
double derivation(const Json& fields) {
  const auto system = fields.find("system");
  if (system == fields.end() || !system->is_object()) return 0;
  const auto coordinates = system->find("coordinates");
  if (coordinates == system->end() || !coordinates->is_array()) return 0;
  return 0.5 + 0.03 * power(std::min<double>(static_cast<double>(coordinates->size()), 20), 5.0);
}

std::optional<double> number_in(const std::string& text, std::string_view unit) {
  ParameterScope numbers_only;
  const auto value = written_value(text, unit, numbers_only);
  const auto* found = std::get_if<Real>(&value);
  return found == nullptr ? std::nullopt : std::optional(found->value);
}

std::optional<double> number_in(const Json& value, std::string_view unit) {
  if (value.is_number()) return value.get<double>();
  if (!value.is_string()) return std::nullopt;
  return number_in(value.get_ref<const std::string&>(), unit);
}

std::optional<double> number(const Json& fields, const char* name, std::string_view unit) {
  const auto field = fields.find(name);
  return field == fields.end() ? std::nullopt : number_in(*field, unit);
}

/// How much more a method costs than the Taylor method, for the same motion.
double factor_of_method(const Json& fields) {
  const auto method = fields.find("method");
  if (method == fields.end() || !method->is_string()) return 1;
  const auto found = std::ranges::find(methods(), method->get_ref<const std::string&>(), &MethodRecord::name);
  return found == methods().end() ? 1 : found->relative_cost;
}

/// Of the systems that are known by name.
double factor_of_system(const Json& fields) {
  const auto system = fields.find("system");
  if (system == fields.end() || !system->is_string()) return 1;
  const auto found = std::ranges::find(dear_systems, system->get_ref<const std::string&>(), &OfSystem::name);
  return found == dear_systems.end() ? 1 : found->factor;
}

double factor_of_precision(const Json& fields) {
  const auto precision = fields.find("precision");
  return precision != fields.end() && is_text(*precision, "extended") ? of_extended : 1;
}

/// Of a list, or of a query's text.
std::optional<double> last_time(const Json& fields) {
  const auto times = fields.find("times");
  if (times == fields.end()) return std::nullopt;
  if (times->is_array()) return times->empty() ? std::nullopt : number_in(times->back(), "s");
  if (!times->is_string()) return number_in(*times, "s");
  const auto& text = times->get_ref<const std::string&>();
  return number_in(text.substr(text.rfind(',') + 1), "s");
}

double length_of(const Json& fields) {
  if (const auto end = number(fields, "t_end", "s")) {
    return std::abs(*end - number(fields, "t_start", "s").value_or(0));
  }
  if (const auto strides = number(fields, "steps", "1")) return *strides;
  return std::abs(last_time(fields).value_or(10));
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
  const double motion = length * per_second_of_motion * factor_of_method(fields) * factor_of_system(fields) *
                        factor_of_precision(fields) * events;
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

/// The fields of a body; nothing when there are none to tell a cost by.
std::optional<Json> fields_of_body(std::string_view body) {
  auto read = submission_of_body(body);
  auto* submission = std::get_if<Submission>(&read);
  return submission == nullptr ? std::nullopt : std::optional(std::move(submission->fields));
}

std::optional<Json> fields_of(const Request& request) {
  if (request.method == "POST") return fields_of_body(request.body);
  const auto target = parse_target(request.target);
  return target ? std::optional(submission_of_query(target->query).fields) : std::nullopt;
}

Appraisal of_fields(const Cost& cost, const Json& fields) {
  Appraisal result{.milliseconds = cost.milliseconds};
  if (!fields.is_object()) return result;
  result.milliseconds += derivation(fields);
  if (!cost.each.empty()) {
    const std::size_t count = entries(fields, std::string(cost.each).c_str());
    result.milliseconds *= static_cast<double>(std::max<std::size_t>(count, 1));
  }
  return follows_motion(cost, fields) ? of_motion(fields, result) : result;
}

Appraisal of_question(const Cost& cost, const Json& fields);

/// Of the request {"modes": {...}}, which asks another endpoint.
Appraisal of_asked(const Json& asked) {
  Appraisal sum{.milliseconds = 0};
  for (const auto& [name, fields] : asked.items()) {
    const Endpoint* endpoint = endpoint_at("/v1/" + name);
    if (endpoint == nullptr) continue;
    const Appraisal one = of_question(endpoint->cost, fields);
    sum.milliseconds += one.milliseconds;
    sum.bytes += one.bytes;
  }
  return sum;
}

/// A long batch is appraised by its first lines.
Appraisal of_lines(const Cost& cost, std::string_view body) {
  if (body.empty()) return {};
  const auto lines = static_cast<double>(std::ranges::count(body, '\n') + (body.ends_with('\n') ? 0 : 1));
  Appraisal sum{.milliseconds = 0};
  double read = 0;
  std::size_t left = largest_read;
  while (!body.empty()) {
    const std::string_view line = trimmed(body.substr(0, body.find('\n')));
    if (line.size() > left) break;
    left -= line.size();
    const auto fields = fields_of_body(line);
    const Appraisal one = of_asked(fields && fields->is_object() ? *fields : Json::object());
    sum.milliseconds += cost.milliseconds + one.milliseconds;
    sum.bytes += one.bytes;
    ++read;
    body.remove_prefix(std::min(body.find('\n'), body.size() - 1) + 1);
  }
  if (read == 0)
    return {.milliseconds = unread, .bytes = std::max(body.size() * bytes_per_number, unread_bytes)};
  return {.milliseconds = sum.milliseconds * lines / read,
          .bytes = static_cast<std::size_t>(static_cast<double>(sum.bytes) * lines / read),
          .spreads = lines > 1};
}

/// How many values a variable of a sweep has; `fields` are the variable's own or those of a query.
double count_of(const Json& fields) {
  if (const std::size_t listed = entries(fields, "values"); listed > 0) return static_cast<double>(listed);
  return number(fields, "count", "1").value_or(1);
}

/// The product of what the variables have, or the size of a sample.
double rows_of_sweep(const Json& fields) {
  const auto vary = fields.find("vary");
  double rows = count_of(fields);
  if (vary != fields.end() && vary->is_object())
    for (const auto& [name, variable] : vary->items()) rows *= variable.is_object() ? count_of(variable) : 1;
  return rows >= 1 ? rows : 1;
}

/// Of a sweep: what one row costs, times the rows.
Appraisal of_rows(const Json& fields) {
  if (!fields.is_object()) return {};
  const auto ask = fields.find("ask");
  if (ask == fields.end()) return {};
  const Json asked = ask->is_string() ? Json{{ask->get<std::string>(), fields}} : *ask;
  if (!asked.is_object()) return {};
  const Appraisal one = of_asked(asked);
  const double rows = std::min(rows_of_sweep(fields), static_cast<double>(limits::sweep_rows));
  return {.milliseconds = one.milliseconds * rows, .bytes = one.bytes, .spreads = rows > 1};
}

/// Of a check: for each item what it takes to read and to compare, and the answer that it is held against.
Appraisal of_items(const Cost& cost, const Json& fields) {
  Appraisal sum{.milliseconds = cost.milliseconds};
  const auto items = fields.is_object() ? fields.find("items") : fields.end();
  if (!fields.is_object() || items == fields.end() || !items->is_array() || items->empty()) return sum;
  sum.milliseconds = 0;
  for (const Json& item : *items) {
    sum.milliseconds += cost.milliseconds;
    const auto expect = item.is_object() ? item.find("expect") : item.end();
    if (!item.is_object() || expect == item.end() || !expect->is_object()) continue;
    const Appraisal asked = of_asked(*expect);
    sum.milliseconds += asked.milliseconds;
    sum.bytes = std::max(sum.bytes, asked.bytes);
    for (const char* formula : {"equation", "expression"}) {
      const auto found = expect->find(formula);
      if (found != expect->end() && found->is_object()) sum.milliseconds += derivation(*found);
    }
  }
  return sum;
}

Appraisal of_question(const Cost& cost, const Json& fields) {
  switch (cost.made_of) {
    case Cost::MadeOf::items:
      return of_items(cost, fields);
    case Cost::MadeOf::rows:
      return of_rows(fields);
    default:
      return of_fields(cost, fields);
  }
}

Appraisal of_request(const Cost& cost, const Request& request) {
  if (cost.made_of == Cost::MadeOf::lines) return of_lines(cost, request.body);
  if (request.body.size() > largest_read)
    return {.milliseconds = cost.milliseconds + unread,
            .bytes = std::max(request.body.size() * bytes_per_number, unread_bytes)};
  const auto fields = fields_of(request);
  return fields ? of_question(cost, *fields) : Appraisal{.milliseconds = cost.milliseconds};
}

/// Of a long answer that the client wants compressed, as far as answers are (server/engine.cpp).
double compression(const Request& request, std::size_t bytes) {
  const auto accepted = request.headers.find("accept-encoding");
  if (accepted == request.headers.end() || accepted->second.find("gzip") == std::string::npos) return 0;
  const double text = static_cast<double>(bytes) * text_of_bytes;
  return text < most_compressed ? text * per_compressed_byte : 0;
}

}  // namespace

Appraisal appraise(const Route& route, const Request& request) {
  Appraisal result{.milliseconds = route.cost.milliseconds};
  if (request.body.size() <= limits::large_body_bytes)  // else it is refused by its size
    result = of_request(route.cost, request);
  result.milliseconds += compression(request, result.bytes);
  result.route = route.pattern;
  result.weight = result.milliseconds > light ? Weight::heavy : Weight::light;
  return result;
}

}  // namespace qdot::api
