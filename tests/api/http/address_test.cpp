#include "api/http/address.hpp"

#include <gtest/gtest.h>

namespace qdot::api {
namespace {

using Query = std::vector<std::pair<std::string, std::string>>;

TEST(Target, IsSplitAndDecoded) {
  const Target target =
      parse_target("/v1/systems/a%20b+c?theta=30deg&F=2*t%2B1&note=a+b&pretty&k=1&k=2&&x==").value();
  EXPECT_EQ(target.path, "/v1/systems/a b+c");
  EXPECT_EQ(target.query, (Query{{"theta", "30deg"},
                                 {"F", "2*t+1"},
                                 {"note", "a b"},
                                 {"pretty", ""},
                                 {"k", "1"},
                                 {"k", "2"},
                                 {"x", "="}}));
  EXPECT_EQ(parse_target("/").value().path, "/");
  EXPECT_EQ(parse_target("/?").value().query, Query{});
  EXPECT_EQ(parse_target("/a#b?c=d").value().path, "/a");
}

TEST(Target, IsRefusedWhenItCannotBeDecoded) {
  for (const char* text : {"/%", "/%4", "/%zz", "/?a=%2", "/?%=1", "/%FF", "/?a=%00", "/%+1"}) {
    EXPECT_FALSE(parse_target(text)) << text;
  }
}

TEST(Accept, ChoosesWhatIsWantedMost) {
  const std::vector<std::string> offered{"application/json", "text/csv"};
  const auto chosen = [&](std::string_view accept) {
    const std::string* type = negotiated(accept, offered);
    return type == nullptr ? "none" : *type;
  };
  EXPECT_EQ(chosen(""), "application/json");
  EXPECT_EQ(chosen("*/*"), "application/json");
  EXPECT_EQ(chosen("text/csv"), "text/csv");
  EXPECT_EQ(chosen("Text/CSV; header=present"), "text/csv");
  EXPECT_EQ(chosen("text/*"), "text/csv");
  EXPECT_EQ(chosen("application/json;q=0.5, text/csv"), "text/csv");
  EXPECT_EQ(chosen("text/html,application/xhtml+xml,*/*;q=0.8"), "application/json");
  EXPECT_EQ(chosen("application/json;q=0, */*"), "text/csv") << "the specific range decides";
  EXPECT_EQ(chosen("text/html"), "none");
  EXPECT_EQ(chosen("*/*;q=0"), "none");
  EXPECT_EQ(chosen("*/*;q=nan"), "none");
}

TEST(ContentType, LetsPlainCurlThrough) {
  const auto is_json = [](std::string_view type, std::string_view body) {
    return body_type(type, body) == BodyType::json;
  };
  EXPECT_TRUE(is_json("", "{}"));
  EXPECT_TRUE(is_json("application/json", "{}"));
  EXPECT_TRUE(is_json("application/json; charset=UTF-8", "{}"));
  EXPECT_TRUE(is_json("application/vnd.qdot+json", "{}"));
  EXPECT_TRUE(is_json("application/x-www-form-urlencoded", " \n{\"system\":\"x\"}"));
  EXPECT_FALSE(is_json("application/x-www-form-urlencoded", "system=x"));
  EXPECT_FALSE(is_json("application/json; charset=utf-16", "{}"));
  EXPECT_FALSE(is_json("text/plain", "{}"));
  EXPECT_FALSE(is_json("multipart/form-data", "{}"));
}

TEST(EntityTag, IsTheHashOfTheBytes) {
  EXPECT_EQ(entity_tag(""), "\"cbf29ce484222325\"");
  EXPECT_EQ(entity_tag("foobar"), "\"85944171f73967e8\"");  // test vector of the hash's authors
  EXPECT_TRUE(matches_entity_tag("\"x\", W/\"85944171f73967e8\"", entity_tag("foobar")));
  EXPECT_TRUE(matches_entity_tag("*", entity_tag("foobar")));
  EXPECT_FALSE(matches_entity_tag("\"x\"", entity_tag("foobar")));
  EXPECT_FALSE(matches_entity_tag("", entity_tag("foobar")));
}

}  // namespace
}  // namespace qdot::api
