#include "api/about/examples.hpp"

#include <algorithm>
#include <vector>

#include "api/about/practice_sheet.hpp"
#include "api/answers/endpoints.hpp"

namespace qdot::api {
namespace {

void append(Json& examples, const Json& summary, Json value) {
  examples["example_" + std::to_string(examples.size() + 1)] = {{"summary", summary},
                                                                {"value", std::move(value)}};
}

void append_from_sheet(const std::string& path, Json& examples) {
  for (const Json& exercise : practice_sheet()) {
    for (const Json& part : exercise["parts"]) {
      const Json& request = part["request"];
      const bool is_known = std::ranges::any_of(
          examples, [&](const Json& example) { return example["value"] == request["body"]; });
      if (request["path"] != path || is_known) continue;
      const std::string place = std::to_string(exercise["number"].get<int>()) +
                                (part.contains("part") ? " " + part["part"].get<std::string>() : "");
      append(examples, "Problem " + place + ": " + exercise["title"].get<std::string>(), request["body"]);
    }
  }
}

}  // namespace

Json request_examples(const std::string& path, const Json& more, const Catalogue& catalogue) {
  Json examples = Json::object();
  append_from_sheet(path, examples);
  std::size_t turn = 0;
  const Endpoint* endpoint = endpoint_at(path);
  const bool has_system = endpoint != nullptr && asks_about_a_system(*endpoint);
  for (const Json& example : more) {
    std::vector<std::string> names;
    for (const CatalogueEntry& entry : catalogue.entries()) {
      if (!example.contains("needs") || entry.json.contains(example["needs"].get<std::string>()))
        names.push_back(entry.scene.name);
    }
    Json body = Json::object();
    if (has_system) body["system"] = names.at(turn++ % names.size());
    body.update(example["body"]);
    append(examples, example["summary"], std::move(body));
  }
  return examples;
}

}  // namespace qdot::api
