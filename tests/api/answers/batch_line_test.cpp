#include "api/answers/batch/line.hpp"

#include <gtest/gtest.h>

#include "api/answers/endpoints.hpp"
#include "api/json/members.hpp"

namespace qdot::api {
namespace {

const FieldSet& fields() { return *endpoint_at("/v1/batch")->question.fields; }

std::string answered(std::string_view line) {
  return answered_line(line, fields(), [](const std::string& endpoint, const std::string& body) {
    return Response{.content_type = "application/json", .body = "[\"" + endpoint + "\"," + body + "]\n"};
  });
}

TEST(BatchLine, PassesTheRequestOnAsItWasWritten) {
  EXPECT_EQ(answered(R"({"id": 1.50, "modes": {"k" : 1.000000000000000000001, "a": ["}", "\"", {}]} })"),
            "{\"id\":1.50,\"status\":200,\"answer\":[\"modes\","
            R"({"k" : 1.000000000000000000001, "a": ["}", "\"", {}]}]})"
            "\n");
}

TEST(BatchLine, FindsTheEndpointInEscapes) {
  EXPECT_EQ(answered(R"({"mod\u0065s":{}})"), "{\"id\":null,\"status\":200,\"answer\":[\"modes\",{}]}\n");
}

TEST(BatchLine, KeepsTheIdOfALineThatIsWrong) {
  EXPECT_TRUE(
      answered(R"({"id": "a\"b", "mods": {}})").starts_with(R"({"id":"a\"b","status":422,"answer":{)"));
  EXPECT_EQ(id_of_line(R"({"id": "a\"b", "mods": {}})", fields()), R"("a\"b")");
  EXPECT_EQ(id_of_line("{", fields()), "null");
}

TEST(BatchLine, RepeatsNoLongId) {
  const std::string line = R"({"id": ")" + std::string(300, 'x') + R"(", "modes": {}})";
  EXPECT_TRUE(answered(line).find("too_long") != std::string::npos);
  EXPECT_LT(answered(R"({"id": ")" + std::string(5000, 'x') + R"(", "modes": {}})").size(), 1000U);
}

TEST(BatchLine, DuplicatesInsideARequestAreTheRequestsOwn) {
  EXPECT_TRUE(answered(R"({"id":1,"modes":{"a":1,"a":2}})").find(R"("status":200)") != std::string::npos);
  EXPECT_TRUE(answered(R"({"id":1,"id":2,"modes":{}})").find("duplicate_field") != std::string::npos);
}

TEST(Members, AreTheTextsOfTheValues) {
  const auto members =
      members_of("\xEF\xBB\xBF {\t\"a\" :1 ,\"b\":\"x,}\\\\\" , \"c\": [ {\"d\":[]} ] ,\"e\":true}\r");
  ASSERT_EQ(members.size(), 4U);
  EXPECT_EQ(members[0].second, "1");
  EXPECT_EQ(members[1].second, "\"x,}\\\\\"");
  EXPECT_EQ(members[2].second, "[ {\"d\":[]} ]");
  EXPECT_EQ(members[3].second, "true");
  EXPECT_TRUE(members_of("{ }").empty());
}

}  // namespace
}  // namespace qdot::api
