#include "api/answers/sweep/request.hpp"

#include "api/json/limits.hpp"

namespace qdot::api {
namespace {

constexpr std::int64_t most_counted = 1'000'000'000;  ///< the rows are counted together

/// A value of the variable, in its own unit.
Json schema_of_value() { return {{"type", {"number", "string"}}}; }

Json schema_of_pair() {
  return {{"type", "array"}, {"items", schema_of_value()}, {"minItems", 2}, {"maxItems", 2}};
}

Json schema_of_variable() {
  return {{"type", "object"},
          {"properties",
           {{"from", schema_of_value()},
            {"to", schema_of_value()},
            {"count", {{"type", {"integer", "string"}}}},
            {"spacing", {{"type", "string"}, {"enum", {"linear", "log"}}}},
            {"values", {{"type", "array"}, {"items", schema_of_value()}}},
            {"uniform", schema_of_pair()},
            {"normal", schema_of_pair()}}},
          {"additionalProperties", false}};
}

BoundField<SweepRequest> of_variable(std::string name, Json SweepRequest::*member, Json schema,
                                     std::string description) {
  return value(std::move(name), member, AnyKind{std::move(schema)}, std::move(description));
}

BoundField<SweepRequest> list_of_variable(std::string name, Json SweepRequest::*member, std::size_t most,
                                          std::string description) {
  return value(std::move(name), member, ListKind{AnyKind{schema_of_value()}, most, most == 2 ? 2U : 1U},
               std::move(description));
}

std::vector<RequestField<SweepRequest>> sweep_fields() {
  const Json text{{"type", "string"}};
  const Json objects_of_pointers{{"type", "object"}, {"additionalProperties", text}};
  return {
      value(
          "ask", &SweepRequest::ask,
          AnyKind{{{"type", {"object", "string"}}, {"minProperties", 1}, {"maxProperties", 1}}},
          "an endpoint's name with a request of it, {\"modes\": {...}}; in a query the name, its fields beside",
          {.need = Need::required, .aliases = {"question", "request", "endpoint"}}),
      value("vary", &SweepRequest::vary,
            AnyKind{{{"anyOf",
                      {text,
                       {{"type", "object"},
                        {"minProperties", 1},
                        {"additionalProperties", schema_of_variable()}}}}}},
            "parameters and initial values with what they run over; or the name of one, the rest beside",
            {.need = Need::required, .aliases = {"over", "variables", "grid", "parameter"}}),
      of_variable("from", &SweepRequest::from, schema_of_value(), "first value of the only variable"),
      of_variable("to", &SweepRequest::to, schema_of_value(), "its last value"),
      integer("count", &SweepRequest::count, {1, most_counted}, "how many values it has; or rows of a sample",
              {.aliases = {"samples", "n", "number", "num"}}),
      choice("spacing", &SweepRequest::spacing, {{"linear", Spacing::linear}, {"log", Spacing::logarithmic}},
             "how its values lie: equal differences, or with 'log' equal ratios"),
      list_of_variable("values", &SweepRequest::values, static_cast<std::size_t>(limits::sweep_rows),
                       "its values one by one"),
      list_of_variable("uniform", &SweepRequest::uniform, 2, "its least and largest value in a sample"),
      list_of_variable("normal", &SweepRequest::normal, 2, "its mean and standard deviation in a sample"),
      integer("seed", &SweepRequest::seed, {0, 9'007'199'254'740'991},
              "of a sample: the same seed has the same values; 0 without it"),
      value("collect", &SweepRequest::collect,
            AnyKind{{{"anyOf", {text, objects_of_pointers, {{"type", "array"}, {"items", text}}}}}},
            "columns of the answer, each with the JSON pointer to its number; or pointers alone",
            {.need = Need::required, .aliases = {"columns", "at", "extract"}}),
      choice("format", &SweepRequest::format,
             {{"json", SweepFormat::json}, {"csv", SweepFormat::csv}, {"ndjson", SweepFormat::ndjson}},
             "form of the answer; without it, the Accept header decides"),
  };
}

}  // namespace

const RequestTable<SweepRequest>& sweep_table() {
  static const RequestTable<SweepRequest> table(sweep_fields());
  return table;
}

}  // namespace qdot::api
