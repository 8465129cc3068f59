// Requests and scenes are read by the same tables: the same slip has the same code in both, and every place
// that is reported can be found in what was sent.

#include <gtest/gtest.h>

#include <functional>

#include "api/scenes/catalogue.hpp"
#include "api/scenes/scene_reader.hpp"
#include "tests/api/example_systems.hpp"

namespace qdot::api {
namespace {

enum class Colour { red, green };

struct TestRequest {
  SystemChoice system{};
  std::optional<double> dt{};
  std::optional<int> count{};
  Colour colour{};
  std::vector<std::string> events{};
  std::vector<double> times{};
};

const RequestTable<TestRequest>& table() {
  using R = TestRequest;
  static const RequestTable<R> table(
      {system_field<R>(), number("dt", &R::dt, {"s"}, "a step"),
       integer("count", &R::count, {1, 10}, "a number"),
       choice("colour", &R::colour, {{"red", Colour::red}, {"green", Colour::green}}, "a colour"),
       list("events", &R::events, TextKind{20}, 3, "events"),
       list("times", &R::times, NumberKind{"s"}, 2, "instants")},
      {{{{"count"}, {"dt"}}}});
  return table;
}

std::vector<FieldError> request_errors(const Json& change) {
  Json request{{"system", "spring_pendulum"}};
  request.merge_patch(change);
  const auto outcome = read_body(table(), request.dump());
  const auto* problem = std::get_if<Problem>(&outcome);
  return problem == nullptr ? std::vector<FieldError>{} : problem->errors;
}

std::vector<FieldError> scene_errors(const Json& change) {
  Json scene = Json::parse(R"({"name": "cart", "coordinates": [{"name": "x", "unit": "m"}],
                               "bodies": [{"kind": "particle", "mass": 1, "position": ["x", 0]}]})");
  scene.merge_patch(change);
  return read_scene(scene).errors;
}

struct Slip {
  std::string what;
  std::string code;
  Json in_request;
  Json in_scene;
};

TEST(OneValidator, TheSameSlipHasTheSameCodeInRequestsAndScenes) {
  const Json event{{"name", "e"}, {"expression", "x"}};
  const auto event_with = [&](const std::string& field, const Json& value) {
    Json changed = event;
    changed[field] = value;
    return Json{{"events", Json::array({changed})}};
  };
  const std::vector<Slip> slips{
      {"a misspelled field", "unknown_field", {{"colur", "red"}}, {{"titel", "Cart"}}},
      {"a field that is missing", "missing", {{"system", nullptr}}, {{"name", nullptr}}},
      {"a word of another list", "not_allowed", {{"colour", "blue"}}, event_with("direction", "up")},
      {"a number for a word", "wrong_type", {{"colour", 1}}, event_with("direction", 1)},
      {"a text for an array", "wrong_type", {{"events", "x"}}, {{"springs", "x"}}},
      {"an object for a text", "wrong_type", {{"events", {Json::object()}}}, {{"title", Json::object()}}},
      {"an empty text", "empty", {{"events", {""}}}, {{"title", ""}}},
      {"an overlong text",
       "too_long",
       {{"events", {std::string(21, 'x')}}},
       {{"title", std::string(1001, 'x')}}},
      {"an overlong array", "too_many", {{"times", {1, 2, 3}}}, {{"gravity", {1, 2, 3, 4}}}},
      {"two ways at once", "exclusive", {{"dt", 1}, {"count", 1}}, {{"lagrangian", "x_dot^2"}}},
  };
  for (const Slip& slip : slips) {
    for (const auto& errors : {request_errors(slip.in_request), scene_errors(slip.in_scene)}) {
      ASSERT_EQ(errors.size(), 1U) << slip.what;
      EXPECT_EQ(errors[0].code, slip.code) << slip.what;
      EXPECT_EQ(errors[0].did_you_mean.empty(), slip.code != "unknown_field") << slip.what;
    }
  }
}

/// The pointer of RFC 6901 that a URI fragment stands for.
Json::json_pointer pointer_of(const std::string& fragment) {
  std::string text;
  for (std::size_t i = 1; i < fragment.size(); ++i) {
    if (fragment[i] == '%') {
      text += static_cast<char>(std::stoi(fragment.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      text += fragment[i];
    }
  }
  return Json::json_pointer(text);
}

/// Calls `use` with every value of `root` below `place`, and its place.
void for_each_place(const Json& value, const Json::json_pointer& place,
                    const std::function<void(const Json::json_pointer&, const Json&)>& use) {
  use(place, value);
  for (const auto& [key, inner] : value.items()) {
    if (value.is_object()) for_each_place(inner, place / key, use);
    if (value.is_array()) for_each_place(inner, place / static_cast<std::size_t>(std::stoul(key)), use);
  }
}

/// `document` with each of its members in turn left out, of another type, and with one member too many.
void for_each_mutation(const Json& document, const std::function<void(const Json&)>& use) {
  const std::string overlong(100, 'x');
  for_each_place(document, Json::json_pointer(), [&](const Json::json_pointer& place, const Json& value) {
    for (const Json& other :
         {Json(), Json(true), Json(7), Json("x y"), Json(""), Json::array(), Json::object()}) {
      Json changed = document;
      changed[place] = other;
      use(changed);
    }
    if (value.is_object()) {
      for (const std::string& key : {std::string("extra"), std::string("a/b~c %\xC3\xA4\n"), overlong}) {
        Json changed = document;
        changed[place][key] = Json{{"b", 1}};
        use(changed);
      }
    }
    if (place.empty()) return;
    Json changed = document;
    Json& parent = changed[place.parent_pointer()];
    if (parent.is_array()) {
      parent.erase(std::stoul(place.back()));
    } else {
      parent.erase(place.back());
    }
    use(changed);
  });
}

TEST(OneValidator, EveryPointerLeadsIntoTheDocumentThatWasSent) {
  const Place place = Place(Road::body).below("system");
  std::size_t count = 0;
  const Catalogue catalogue = Catalogue::built_in();
  for (const CatalogueEntry& entry : catalogue.entries()) {
    for_each_mutation(entry.json, [&](const Json& scene) {
      const Json request{{"system", scene}};
      for (const FieldError& error : read_scene(scene, place).errors) {
        ++count;
        ASSERT_TRUE(request.contains(pointer_of(error.pointer))) << error.pointer << ' ' << error.detail;
      }
    });
  }
  EXPECT_GT(count, 1000U);
}

TEST(OneValidator, EveryPointerLeadsIntoTheRequestUnlessTheFieldIsMissing) {
  const Json whole{{"system", "spring_pendulum"},
                   {"count", 3},
                   {"colour", "red"},
                   {"events", {"theta=0"}},
                   {"times", {0, 1.5}}};
  std::size_t count = 0;
  for_each_mutation(whole, [&](const Json& request) {
    if (!request.is_object()) return;
    const auto outcome = read_body(table(), request.dump());
    const auto* problem = std::get_if<Problem>(&outcome);
    if (problem == nullptr) return;
    for (const FieldError& error : problem->errors) {
      ++count;
      EXPECT_NE(request.contains(pointer_of(error.pointer)), error.code == "missing") << error.pointer;
    }
  });
  EXPECT_GT(count, 30U);
}

}  // namespace
}  // namespace qdot::api
