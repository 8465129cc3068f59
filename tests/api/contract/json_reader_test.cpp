#include "api/contract/json_reader.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace qdot::api {
namespace {

JsonDocument document(std::string_view text, const JsonLimits& limits = {}) {
  auto result = read_json(text, limits);
  if (const auto* problem = std::get_if<Problem>(&result)) {
    ADD_FAILURE() << text.substr(0, 100) << ": " << problem->detail;
    return {};
  }
  return std::get<JsonDocument>(std::move(result));
}

Problem problem(std::string_view text, const JsonLimits& limits = {}) {
  auto result = read_json(text, limits);
  if (std::holds_alternative<JsonDocument>(result)) {
    ADD_FAILURE() << text.substr(0, 100) << " was read";
    return {};
  }
  return std::get<Problem>(std::move(result));
}

std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  while (count-- > 0) result += text;
  return result;
}

TEST(JsonReader, KeepsOrderTypesAndValues) {
  const std::string_view text =
      R"( {"z":1,"a":[-2,3.5,true,null,"\u00e4"],"b":{"c":{}},"big":18446744073709551616} )";
  const Json value = document(text).value;
  EXPECT_EQ(value, Json::parse(text));  // two roads
  EXPECT_EQ(value.begin().key(), "z");
  EXPECT_TRUE(value["z"].is_number_integer());
  EXPECT_EQ(value["big"].get<double>(), 18446744073709551616.0);
  EXPECT_EQ(document("\xEF\xBB\xBF{}").value, Json::object());
}

TEST(JsonReader, SaysWhereTheGrammarBreaks) {
  const Problem broken = problem("{\"a\": 1,\n \"b\": x}");
  EXPECT_EQ(broken.kind, ProblemKind::invalid_json);
  EXPECT_EQ(
      broken.detail,
      "A text stands in double quotes: \"x\". If they were there when you typed it, the shell took them: "
      "put the whole body in single quotes, -d '{\"system\": ...}'. Byte 16, line 2, column 7.");
  EXPECT_EQ(broken.members["byte"], 16);
  EXPECT_EQ(problem("{\"a\": ").detail,
            "The JSON ends too early: } is missing at its end. Byte 7, line 1, column 7.");
  EXPECT_EQ(problem("{'a': 1}").detail,
            "JSON has double quotes around its strings, not single ones. Byte 2, line 1, column 2.");
  EXPECT_EQ(problem(" \n").detail,
            "The body is empty; send a JSON object such as {\"system\": \"cart_pendulum\"}.");
}

TEST(JsonReader, RefusesWhatIsNotJson) {
  for (const char* text : {"{\"a\":1,}", "[1,]", "{a:1}", "NaN", "[Infinity]", "{} {}", "01", "+1", ".5",
                           "\"\xFF\"", "\"\\ud800\"", "\"\t\"", "// c\n1", "tru", "[1 2]", "1.", "\"a"}) {
    EXPECT_EQ(problem(text).kind, ProblemKind::invalid_json) << text;
  }
  EXPECT_EQ(problem(std::string_view("{}\0", 3)).detail, "JSON has no NUL bytes. Byte 3, line 1, column 3.");
}

TEST(JsonReader, RefusesNumbersBeyondDoublePrecision) {
  const Problem overflow = problem("{\"t_end\": 1e999}");
  EXPECT_EQ(overflow.kind, ProblemKind::invalid_json);
  EXPECT_TRUE(overflow.detail.starts_with("A number is beyond double precision.")) << overflow.detail;
  const Problem long_number = problem("[" + std::string(50'000, '9') + "]");
  EXPECT_LT(long_number.detail.size(), 200U) << "repeats the digits";
}

TEST(JsonReader, KeepsTheDigitsThatADoubleDoesNot) {
  const JsonDocument read = document(
      R"({"a": 0.1, "b": [1, 0.10000000000000000000, 0.1000000000000000055, 123456789012345678], "c/d": 1.00000000000000000001e3, "e": 1e-310})");
  const WrittenNumbers expected{
      {"#/b/2", "0.1000000000000000055"}, {"#/c~1d", "1.00000000000000000001e3"}, {"#/e", "1e-310"}};
  EXPECT_EQ(read.numbers, expected);
  EXPECT_EQ(problem("[1e-400]").kind, ProblemKind::invalid_json);
  EXPECT_EQ(document("[0e-400, -0.000]").value[0], 0.0);
  EXPECT_EQ(problem("[0." + std::string(1001, '3') + "]").kind, ProblemKind::limit_exceeded);
}

TEST(JsonReader, HoldsItsLimits) {
  EXPECT_EQ(document(repeated("[", 16) + repeated("]", 16)).duplicates.size(), 0U);
  EXPECT_EQ(problem(repeated("[", 17) + repeated("]", 17)).kind, ProblemKind::limit_exceeded);
  EXPECT_EQ(problem(repeated("{\"a\":", 60'000 / 5)).kind, ProblemKind::limit_exceeded);

  const std::string full = "[" + repeated("0,", 19'998) + "0]";  // with the array itself 20,000
  EXPECT_EQ(document(full).value.size(), 19'999U);
  EXPECT_EQ(problem("[" + repeated("0,", 19'999) + "0]").kind, ProblemKind::limit_exceeded);

  const std::string_view tiny = "[12345]";
  EXPECT_EQ(document(tiny, {.bytes = 7}).value[0], 12345);
  EXPECT_EQ(problem(tiny, {.bytes = 6}).kind, ProblemKind::payload_too_large);
}

TEST(JsonReader, ReportsEveryRepeatedKeyAndKeepsTheFirst) {
  const JsonDocument read = document(R"({"a":1,"b":[{"k":2,"k":{"x":1,"x":[2]}}],"a":[{}],"c":3})");
  EXPECT_EQ(read.value, Json::parse(R"({"a":1,"b":[{"k":2}],"c":3})"));
  ASSERT_EQ(read.duplicates.size(), 3U);
  EXPECT_EQ(read.duplicates[0].pointer, "#/b/0/k");
  EXPECT_EQ(read.duplicates[0].code, "duplicate_field");
  EXPECT_EQ(read.duplicates[0].detail, "'k' is given twice in one object.");
  EXPECT_EQ(read.duplicates[1].pointer, "#/b/0/k/x");
  EXPECT_EQ(read.duplicates[2].pointer, "#/a");
}

TEST(JsonReader, ReadsManyKeysInLinearTime) {
  std::string text = "{";
  for (int i = 0; i < 100'000; ++i) text += "\"" + std::to_string(i) + "\":0,";
  text += "\"last\":0}";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(document(text, {.bytes = 10'000'000, .nodes = 200'000}).value.size(), 100'001U);
  // Quadratic insertion takes minutes.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(JsonReader, PointsAtTheObjectOfARepeatedKeyThatIsTooLongToRepeat) {
  const std::string key(100, 'x');
  const JsonDocument read = document(R"({"a": {")" + key + R"(": {"b": 1, "b": 2}, ")" + key + R"(": 0}})");
  ASSERT_EQ(read.duplicates.size(), 2U);
  for (const FieldError& error : read.duplicates) EXPECT_EQ(error.pointer, "#/a");
}

}  // namespace
}  // namespace qdot::api
