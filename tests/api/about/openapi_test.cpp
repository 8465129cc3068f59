#include "api/about/openapi.hpp"

#include <gtest/gtest.h>

#include <set>

#include "api/answers/endpoints.hpp"
#include "api/answers/simulate/request.hpp"
#include "api/contract/json_schema.hpp"
#include "api/http/problem.hpp"
#include "api/service.hpp"

namespace qdot::api::openapi_test {
namespace {

/// Two pages stand for those that the server brings.
const Service& service() {
  static const Service service({.metrics = [] { return std::string(); },
                                .pages = {{"/", "text/html", "<p>"}, {"/docs", "text/html", "<p>"}}});
  return service;
}

Response get(const std::string& target, const std::map<std::string, std::string>& headers = {}) {
  return service().handle({.method = "GET", .target = target, .headers = headers});
}

const Json& document() {
  static const Json document = Json::parse(get("/openapi.json").body);
  return document;
}

/// Calls `use` with every object of a JSON value.
template <class Use>
void for_each_object(const Json& value, Use use) {
  if (value.is_object()) use(value);
  if (!value.is_structured()) return;
  for (const Json& part : value) for_each_object(part, use);
}

const Json& body_of(const std::string& path) {
  return document()["paths"][path]["post"]["requestBody"]["content"]["application/json"];
}

TEST(Openapi, HasEveryAddressAndNoOther) {
  const Json index = Json::parse(get("/").body)["endpoints"];
  ASSERT_EQ(document()["paths"].size(), index.size());
  for (const auto& [path, methods] : index.items()) {
    for (const Json& method : methods) {
      const char* name = is_text(method, "GET") ? "get" : "post";
      EXPECT_TRUE(document()["paths"].at(path).contains(name)) << method << ' ' << path;
    }
  }
}

TEST(Openapi, ReferencesLeadSomewhere) {
  std::size_t count = 0;
  for_each_object(document(), [&](const Json& object) {
    if (!object.contains("$ref") || !object["$ref"].is_string()) return;
    ++count;
    const auto target = object["$ref"].get<std::string>();
    EXPECT_TRUE(document().contains(Json::json_pointer(target.substr(1)))) << target;
  });
  EXPECT_GT(count, 200U);
}

TEST(Openapi, NamesEveryProblemOnce) {
  std::set<std::string> types;
  for (const Json& response : document()["components"]["responses"]) {
    const Json& properties = response["content"]["application/problem+json"]["schema"]["properties"];
    for (const Json& type : properties["type"]["enum"]) EXPECT_TRUE(types.insert(type).second) << type;
  }
  EXPECT_EQ(types.size(), problem_types().size());
}

TEST(Openapi, OperationsHaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Json& methods : document()["paths"]) {
    for (const Json& operation : methods) EXPECT_TRUE(names.insert(operation["operationId"]).second);
  }
}

TEST(Openapi, FieldsAreThoseOfTheTable) {
  const Json& schema = document()["components"]["schemas"]["SimulationRequest"];
  const FieldSet& set = simulate_table().set();
  ASSERT_EQ(schema["properties"].size(), set.fields.size());
  for (const FieldInfo& field : set.fields) {
    const Json& property = schema["properties"].at(field.name);
    const Json& value = field.default_value;
    const bool has_default = !value.is_null() && !(value.is_structured() && value.empty());
    const std::string words = has_default ? " (default " + value.dump() + ")" : "";
    EXPECT_EQ(property["description"], field.description + words);
    EXPECT_FALSE(property.contains("default")) << "generated clients would take the field for required";
  }
  EXPECT_EQ(schema["required"], Json{"system"});
  EXPECT_EQ(schema["additionalProperties"], false);
}

TEST(Openapi, GetHasTheFieldsOfPost) {
  for (const auto& [path, methods] : document()["paths"].items()) {
    const Endpoint* endpoint = endpoint_at(path);
    EXPECT_EQ(endpoint != nullptr && endpoint->roads == Roads::body_and_query,
              methods.contains("post") && methods.contains("get"))
        << path;
    if (!methods.contains("post") || !methods.contains("get")) continue;
    std::set<std::string> fields, parameters;
    const auto place = body_of(path)["schema"]["$ref"].get<std::string>().substr(1);
    for (const auto& [name, field] : document()[Json::json_pointer(place)]["properties"].items())
      fields.insert(name);
    for (const Json& parameter : methods["get"]["parameters"]) {
      if (parameter.contains("name")) parameters.insert(parameter["name"]);
    }
    if (path.find('.') != std::string::npos) fields.erase("format");  // the address says it
    EXPECT_EQ(fields, parameters) << path;
  }
}

TEST(Openapi, ExamplesAreAnswered) {
  std::size_t count = 0;
  for (const auto& [path, methods] : document()["paths"].items()) {
    if (!methods.contains("post")) continue;
    if (!methods["post"]["requestBody"]["content"].contains("application/json")) continue;  // lines
    EXPECT_FALSE(body_of(path)["examples"].empty()) << path;
    for (const Json& example : body_of(path)["examples"]) {
      ++count;
      const Request request{.method = "POST", .target = path, .body = example["value"].dump()};
      EXPECT_EQ(service().handle(request).status, 200) << path << ' ' << request.body;
    }
  }
  EXPECT_GE(count, 15U);
}

TEST(Openapi, IsTheSameTextEachTimeWithAnEntityTag) {
  const Response first = get("/openapi.json");
  EXPECT_EQ(first.body, get("/openapi.json").body);
  EXPECT_EQ(get("/openapi.json", {{"if-none-match", first.headers.at("ETag")}}).status, 304);
  EXPECT_EQ(Json::parse(get("/openapi.json?pretty").body), document());
}

struct SchemaCase {
  std::string what;
  Kind kind;
  Json schema;
};

TEST(JsonSchema, SaysWhatEachKindTakes) {
  const Json text{{"$ref", "#/components/schemas/QuantityText"}};
  const std::vector<SchemaCase> cases{
      {"number",
       NumberKind{"m", {.lower = 0, .upper = 2, .lower_open = true}},
       {{"anyOf", {{{"type", "number"}, {"exclusiveMinimum", 0.0}, {"maximum", 2.0}}, text}},
        {"x-unit", "m"}}},
      {"integer", IntegerKind{1, 17}, {{"type", "integer"}, {"minimum", 1}, {"maximum", 17}}},
      {"boolean", BooleanKind{}, {{"type", "boolean"}}},
      {"text", TextKind{9}, {{"type", "string"}, {"minLength", 1}, {"maxLength", 9}}},
      {"choice", ChoiceKind{.options = {"a", "b"}}, {{"type", "string"}, {"enum", {"a", "b"}}}},
      {"set",
       ListKind{ChoiceKind{.options = {"a"}}, 1},
       {{"type", "array"},
        {"items", {{"type", "string"}, {"enum", Json::array({"a"})}}},
        {"maxItems", 1},
        {"uniqueItems", true}}},
  };
  for (const SchemaCase& one : cases) {
    Json schema = body_schema({.fields = {{.name = "x", .kind = one.kind}}})["properties"]["x"];
    schema.erase("description");
    EXPECT_EQ(schema, one.schema) << one.what;
  }
}

TEST(JsonSchema, ExcludesEveryPairOfTwoWays) {
  const FieldSet set{.fields = {}, .one_of = {{.ways = {{"a", "b"}, {"c"}, {"d"}}}}};
  const Json schema = body_schema(set);
  EXPECT_EQ(schema["allOf"].size(), 5U);  // ac, ad, bc, bd, cd
  EXPECT_EQ(schema["allOf"][0], (Json{{"not", {{"required", {"a", "c"}}}}}));
  EXPECT_EQ(schema["description"], "At most one of: a and b; c; d.");
}

TEST(Pages, AreForBrowsersAndFetchNothingFromElsewhere) {
  const std::map<std::string, std::string> browser{{"accept", "text/html,*/*;q=0.8"}};
  EXPECT_EQ(get("/").content_type, "application/json");
  for (const char* path : {"/", "/docs", "/errors/invalid-request"}) {
    const Response page = get(path, browser);
    EXPECT_EQ(page.status, 200) << path;
    EXPECT_EQ(page.content_type, "text/html; charset=utf-8") << path;
    EXPECT_TRUE(page.headers.at("Content-Security-Policy").starts_with("default-src 'none'")) << path;
  }
  EXPECT_EQ(get("/errors/invalid-request").content_type, "application/json");
  EXPECT_EQ(get("/errors/none", browser).status, 404);
}

}  // namespace
}  // namespace qdot::api::openapi_test
