#include "api/answers/sweep/request.hpp"

#include <utility>

#include "api/answers/sweep/swept_range.hpp"
#include "api/contract/document_schema.hpp"

namespace qdot::api {
namespace {

/// A part of a variable as a field of the request itself, for the only one that varies.
template <class Member>
BoundField<SweepRequest> flat(const std::string& name, Member SweepRequest::*member,
                              FieldOptions options = {}, const std::string& besides = "") {
  const FieldInfo& part = *parts_of_variable().find(name);
  return value(name, member, part.kind, "of the only variable: " + part.description + besides,
               std::move(options));
}

std::vector<RequestField<SweepRequest>> sweep_fields() {
  const Json text{{"type", "string"}};
  const Json objects_of_pointers{{"type", "object"}, {"additionalProperties", text}};
  return {
      value(
          "ask", &SweepRequest::ask,
          AnyKind{{{"type", {"object", "string"}}, {"minProperties", 1}, {"maxProperties", 1}}},
          "an endpoint's name with a request of it, {\"modes\": {...}}. In a query: the name; the request's "
          "fields are fields of the query",
          {.need = Need::required, .aliases = {"question", "request", "endpoint"}}),
      value(
          "vary", &SweepRequest::vary,
          AnyKind{{{"anyOf",
                    {text,
                     {{"type", "object"},
                      {"minProperties", 1},
                      {"additionalProperties", value_schema(RecordKind{&parts_of_variable()})}}}}}},
          "parameters and initial values with what they run over. In a query: the name of one; its from, to "
          "and count are fields of their own",
          {.need = Need::required, .aliases = {"over", "variables", "grid", "parameter"}}),
      flat("from", &SweepRequest::from),
      flat("to", &SweepRequest::to),
      flat("count", &SweepRequest::count, {.aliases = {"samples", "n", "number", "num"}},
           "; or the rows of a sample"),
      flat("spacing", &SweepRequest::spacing),
      flat("values", &SweepRequest::values),
      flat("uniform", &SweepRequest::uniform),
      flat("normal", &SweepRequest::normal),
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
