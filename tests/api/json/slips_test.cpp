#include "api/json/slips.hpp"

#include <gtest/gtest.h>

namespace qdot::api {
namespace {

void expect_named(std::string_view text, std::string_view words) {
  EXPECT_NE(json_slip(text).find(words), std::string::npos) << text << ": " << json_slip(text);
}

TEST(JsonSlips, FindsNothingInJson) {
  for (const char* text : {"{}", "[]", "0", "-1.5e+3", "\"a\\u00e9\\\"\"", "[1, -0.5, true, false, null]",
                           " {\"a\": {\"b\": []}, \"c\": \"//\"} \n", "\xEF\xBB\xBF{}"}) {
    EXPECT_EQ(json_slip(text), "") << text;
  }
}

TEST(JsonSlips, NamesCommasTooManyAndTooFew) {
  expect_named("{\"a\": 1,}", "comma before the closing }");
  expect_named("[1, 2, ]", "comma before the closing ]");
  expect_named("[1,,2]", "leave it out");
  expect_named("{\"a\": 1 \"b\": 2}", "A comma is missing before '\"b\": 2}'");
  expect_named("{, \"a\": 1}", "leave it out");
}

TEST(JsonSlips, NamesQuotes) {
  expect_named("{'a': 1}", "double quotes around its strings");
  expect_named("{\"a\": “b”}", "straight double quotes");
  expect_named("{a: 1}", "\"a\"");
  expect_named("{\"a\": cart_pendulum}", "\"cart_pendulum\"");
  expect_named("{\"a\": \"b}", "closing double quote is missing");
  expect_named("{\"a\": \"b\n\"}", "ends on the line on which it begins");
  expect_named("\"C:\\q\"", "\\q means nothing");
}

TEST(JsonSlips, NamesSignsThatLookLikeOthers) {
  expect_named("{\"\"a\"\": 1}", "Two double quotes");
  expect_named("{\"a\": \"\"b\"\"}", "Two double quotes");
  expect_named("{\"a\": `b`}", "double quotes");
  expect_named("{\"a\": 1; \"b\": 2}", "not a semicolon");
  expect_named(
      "{\"a\":\xC2\xA0"
      "1}",
      "not an ordinary space");
  expect_named("[\"a\tb\"]", "\\t");
  expect_named("[object Object]", "JSON.stringify");
}

TEST(JsonSlips, NamesWordsOfOtherLanguages) {
  expect_named("[NaN]", "no NaN");
  expect_named("[-Infinity]", "no -Infinity");
  expect_named("[None]", "null, not None");
  expect_named("[True]", "true, not True");
  expect_named("{} // end", "comments");
  expect_named("{\"a\": 1 # one\n}", "comments");
  expect_named("/* a */ {}", "comments");
}

TEST(JsonSlips, NamesWhatNumbersDoNotHave) {
  expect_named("[.5]", "0.5");
  expect_named("[5.]", "5.0");
  expect_named("[+5]", "no +");
  expect_named("[007]", "zero");
  expect_named("[0x10]", "decimal");
  expect_named("[2*m*g/l]", "in double quotes");
  expect_named("[30 deg]", "in double quotes");
  expect_named("[30deg]", "\"30deg\"");
  expect_named("[-]", "digit after its minus");
  expect_named("[1_000]", "1000");
  expect_named("[−5]", "the sign -");
  expect_named("{\"a\": 9,81}", "9.81");
}

TEST(JsonSlips, NamesBracketsAndColons) {
  expect_named("{\"a\": [1}", "Here [ is closed by }");
  expect_named("{\"a\": [1", "]} is missing");
  expect_named("{}}", "one too many");
  expect_named("{} {}", "leave out what follows");
  expect_named("{\"a\" = 1}", "not =");
  expect_named("{\"a\" 1}", "it is missing");
  expect_named("{\"a\": }", "A value is missing");
  expect_named("]", "A value is missing");
}

}  // namespace
}  // namespace qdot::api
