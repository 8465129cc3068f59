#include "api/json/documents.hpp"

#include <gtest/gtest.h>

namespace qdot::api {
namespace {

TEST(Documents, AreReadAndWrittenInTheOrderTheyHave) {
  EXPECT_EQ(dump_json(parse_json(R"({"b": [1, 2.5, null], "a": "\u00e9"})")),
            "{\"b\":[1,2.5,null],\"a\":\"\u00e9\"}");
}

TEST(Documents, ThatAreNoneThrowOrAreDiscarded) {
  for (const char* text : {"", "{", "[1] 2", "\xff"}) {
    EXPECT_THROW((void)parse_json(text), Json::parse_error) << text;
    EXPECT_TRUE(parse_json_or_discard(text).is_discarded()) << text;
  }
}

TEST(Documents, WithOtherBytesThanUtf8ThrowOrHaveThemReplaced) {
  const Json json{{"name", "a\xff"}};
  EXPECT_THROW((void)dump_json(json), Json::type_error);
  EXPECT_EQ(dump_json_replacing(json), "{\"name\":\"a\ufffd\"}");
}

}  // namespace
}  // namespace qdot::api
