#include "api/answers/sweep/plan.hpp"

#include <algorithm>
#include <utility>

#include "api/answers/embedded.hpp"
#include "api/answers/questions.hpp"
#include "api/answers/sweep/swept_range.hpp"
#include "api/contract/field_values.hpp"
#include "api/json/documents.hpp"
#include "api/json/pointer.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

std::vector<std::string> names_of_questions() {
  std::vector<std::string> names;
  for (const Endpoint& endpoint : questions()) names.emplace_back(endpoint.name);
  return names;
}

const Endpoint* question_called(const std::string& name, const Place& place, Errors& errors) {
  const auto found = std::ranges::find(questions(), name, &Endpoint::name);
  if (found != questions().end()) return &*found;
  FieldError error =
      unknown_name(place, "There is no question " + in_quotes(name) + ".", name, names_of_questions());
  const auto other =
      std::ranges::find_if(questions(), [&](const Endpoint& endpoint) { return is_called(endpoint, name); });
  if (other != questions().end()) error.did_you_mean = other->name;
  report(errors, std::move(error));
  return nullptr;
}

/// The fields of a query that are the sweep's own, and the rest.
std::pair<Submission, Submission> parted_query(const Submission& sent) {
  Submission own{.road = sent.road, .errors = sent.errors}, rest{.road = sent.road};
  for (const auto& [name, value] : sent.fields.items())
    (sweep_table().set().find(name) != nullptr ? own : rest).fields[name] = value;
  return {std::move(own), std::move(rest)};
}

/// An unknown field of the question that is meant for the sweep, "range" or "step".
void advise_on_range(FieldError& error) {
  const FieldInfo* part = field_by_alias(parts_of_variable(), error.parameter);
  if (error.code != "unknown_field" || part == nullptr) return;
  error.detail += " What varies runs over from=1&to=50&count=50, or over values=1,2,5.";
  error.did_you_mean = part->name;
}

/// The digits of the numbers below a pointer, by their pointers inside.
WrittenNumbers numbers_below(const WrittenNumbers& numbers, const std::string& pointer) {
  WrittenNumbers inside;
  for (const auto& [place, digits] : numbers)
    if (place.starts_with(pointer + "/"))
      inside.emplace(std::string(root_pointer) + place.substr(pointer.size()), digits);
  return inside;
}

class Planner {
 public:
  Planner(const Submission& sent, const FindSystem& find_system, std::int64_t most_rows,
          SweepRequest& request)
      : sent_(sent), find_system_(find_system), most_rows_(most_rows), request_(request), whole_(sent) {}

  std::variant<SweepPlan, Problem> plan() {
    const auto [own, rest] = parted();
    auto read = sweep_table().read(own, find_system_);
    if (auto* problem = std::get_if<Problem>(&read)) return std::move(*problem);
    request_ = std::get<Resolved<SweepRequest>>(std::move(read)).request;
    find_question(rest);
    if (!errors_.empty()) return invalid_request(std::move(errors_));
    if (auto problem = read_asked()) return std::move(*problem);
    refuse_other_formats();
    if (plan_.scene != nullptr) read_rest();
    if (!errors_.empty()) return invalid_request(std::move(errors_));
    return std::move(plan_);
  }

 private:
  [[nodiscard]] std::pair<Submission, Submission> parted() const {
    return sent_.road == Road::query ? parted_query(sent_) : std::pair(sent_, Submission{});
  }

  void find_question(const Submission& rest) {
    const Place ask = whole_.below("ask");
    if (request_.ask.is_string() && sent_.road == Road::query) {
      plan_.question = question_called(request_.ask.get<std::string>(), ask, errors_);
      plan_.asked = rest;
      return;
    }
    if (!request_.ask.is_object() || request_.ask.size() != 1) {
      report(errors_,
             wrong_type(ask, "ask", "an object with one endpoint's name, {\"modes\": {...}}", request_.ask));
      return;
    }
    const std::string& name = request_.ask.begin().key();
    const Place place = ask.below(name);
    plan_.question = question_called(name, place, errors_);
    if (!request_.ask.front().is_object()) {
      report(errors_, wrong_type(place, name, "an object", request_.ask.front()));
      return;
    }
    asked_below_ = below(below(std::string(root_pointer), "ask"), name);
    plan_.asked = {.fields = request_.ask.front(), .numbers = numbers_below(sent_.numbers, asked_below_)};
  }

  /// A mistake of the question's at its place in the whole.
  void report_inside(FieldError error) {
    if (!error.pointer.empty())
      error.pointer =
          asked_below_ + error.pointer.substr(std::min(root_pointer.size(), error.pointer.size()));
    if (sent_.road == Road::query) advise_on_range(error);
    report(errors_, std::move(error));
  }

  /// What is wrong with it beside its fields.
  std::optional<Problem> read_asked() {
    const Json& fields = plan_.asked.fields;
    const Place inside(plan_.asked);
    Errors of_scene;
    if (fields.contains("system"))
      plan_.scene = find_system_(fields["system"], inside.below("system"), of_scene);
    plan_.is_carried = fields.contains("system") && fields["system"].is_object();
    const auto same = [this](const Json& value, const Place& place, Errors& errors) {
      return plan_.scene != nullptr ? plan_.scene : find_system_(value, place, errors);
    };
    auto read = plan_.question->question.read(plan_.asked, same);
    if (auto* problem = std::get_if<Problem>(&read)) {
      if (problem->errors.empty()) return std::move(*problem);
      for (FieldError& error : problem->errors) report_inside(std::move(error));
      return std::nullopt;
    }
    plan_.echo["ask"] = Json{{std::string(plan_.question->name), std::get<Json>(std::move(read))}};
    return std::nullopt;
  }

  /// What is collected by pointers is JSON.
  void refuse_other_formats() {
    const auto format = plan_.asked.fields.find("format");
    if (format == plan_.asked.fields.end() || is_text(*format, "json")) return;
    report(errors_,
           Place(whole_)
               .below("ask")
               .below(plan_.question->name)
               .below("format")
               .error("not_applicable",
                      "The answers of the rows are read as JSON; the sweep has a 'format' of its own."));
  }

  /// The question's own parameters, of which the values of what varies may speak.
  [[nodiscard]] Json asked_parameters() const {
    const Json& fields = plan_.asked.fields;
    const std::string group = field_name(SymbolRole::parameter);
    if (plan_.asked.road == Road::body) return fields.value(group, Json::object());
    Json given = Json::object();
    for (const Parameter& parameter : plan_.scene->parameters)
      for (const std::string& name : {parameter.name, group + "." + parameter.name})
        if (fields.contains(name)) given[parameter.name] = fields[name];
    return given;
  }

  void read_rest() {
    const Json parameters = asked_parameters();
    const std::string group = field_name(SymbolRole::parameter);
    const Place asked(plan_.asked);
    const Place of_parameters = asked.below(group);
    ParameterScope scope(*plan_.scene, parameters, of_parameters);
    auto swept = read_variables(request_, *plan_.scene, *plan_.question->question.fields, whole_, scope,
                                most_rows_, errors_);
    std::vector<std::string> taken{"status", "reason"};
    if (swept) {
      refuse_given(*swept);
      for (const SweepVariable& variable : swept->variables) refuse_without_effect(variable.name);
      for (const SweepVariable& variable : swept->variables) taken.push_back(variable.name);
      plan_.swept = std::move(*swept);
    }
    const std::string file = std::string(plan_.question->name) + ".json";
    Json schema = parse_json(text_of(endpoint_files(), file)).at("schema");
    for (const char* head : {"system", "model_version", "service_version", "request"})
      schema["properties"][head] = true;
    auto columns = read_columns(request_.collect, taken, schema, whole_.below("collect"), errors_);
    if (columns) plan_.columns = std::move(*columns);
    plan_.echo["vary"] = plan_.swept.echo;
    if (plan_.swept.is_sample) {
      plan_.echo["count"] = plan_.swept.rows;
      plan_.echo["seed"] = request_.seed.value_or(0);
    }
    plan_.echo["collect"] = Json::object();
    for (const CollectedColumn& column : plan_.columns) plan_.echo["collect"][column.name] = column.pointer;
  }

  /// What varies cannot be given as well.
  void refuse_given(const SweptValues& swept) {
    const Json& fields = plan_.asked.fields;
    for (const SweepVariable& variable : swept.variables) {
      const std::string group = field_name(variable.role);
      const bool in_query = fields.contains(variable.name) || fields.contains(group + "." + variable.name);
      const bool in_body = fields.contains(group) && fields[group].contains(variable.name);
      if (plan_.asked.road == Road::query ? !in_query : !in_body) continue;
      report(errors_,
             whole_.below("vary").error("duplicate_field", in_quotes(variable.name) +
                                                               " is given and varies; leave it out of "
                                                               "the question."));
    }
  }

  /// What is asked for does not depend on the value it has, nor does a position that is said of a coordinate
  /// on where that coordinate starts: all rows would be the same.
  void refuse_without_effect(const std::string& name) {
    if (!plan_.echo.contains("ask")) return;  // the question itself is wrong
    const Json& asked = plan_.echo["ask"].front();
    for (const std::string field : {"parameter", "solve_for"}) {
      if (asked.contains(field) && asked[field] == name)
        report(errors_, whole_.below("vary").error(
                            "not_applicable", "The answer is the same for every value of " + in_quotes(name) +
                                                  ", because '" + field + "' asks for it: vary another."));
    }
    for (const SymbolRole role : {SymbolRole::position, SymbolRole::equilibrium}) {
      const std::string group = field_name(role);
      if (asked.contains(group) && asked[group].contains(name))
        report(errors_,
               whole_.below("vary").error("not_applicable", "The answer is the same wherever " +
                                                                in_quotes(name) + " starts, because '" +
                                                                group + "' has it: leave out either."));
    }
  }

  const Submission& sent_;
  const FindSystem& find_system_;
  std::int64_t most_rows_;
  SweepRequest& request_;
  Place whole_;
  SweepPlan plan_;
  Errors errors_;
  std::string asked_below_;
};

}  // namespace

std::variant<SweepPlan, Problem> plan_of(const Submission& sent, const FindSystem& find_system,
                                         std::int64_t most_rows, SweepRequest& request) {
  return Planner(sent, find_system, most_rows, request).plan();
}

Submission row_request(const SweepPlan& plan, std::size_t row) {
  Submission request = plan.asked;
  for (std::size_t i = 0; i < plan.swept.variables.size(); ++i) {
    const auto& [name, role, unit] = plan.swept.variables[i];
    const double value = plan.swept.value(row, i);
    if (request.road == Road::query) {
      std::string digits;
      append_number(digits, value);
      request.fields[field_name(role) + "." + name] = std::move(digits);
    } else {
      request.fields[field_name(role)][name] = value;
    }
  }
  return request;
}

}  // namespace qdot::api
