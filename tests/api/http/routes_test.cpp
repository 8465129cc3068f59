#include "api/http/routes.hpp"

#include <gtest/gtest.h>

namespace qdot::api {
namespace {

Routes example() {
  Routes routes;
  const Handler none = [](Call&) { return Response{}; };
  routes.add({"GET", "/", none});
  routes.add({"GET", "/v1/systems", none});
  routes.add({"GET", "/v1/systems/{name}", none});
  routes.add({"GET", "/v1/energy", none});
  routes.add({"POST", "/v1/energy", none});
  return routes;
}

TEST(Routes, MatchPatterns) {
  const Routes routes = example();
  const auto pattern = [&](std::string_view method, std::string_view path) {
    const auto match = routes.match(method, path);
    return match.route == nullptr ? "none" : match.route->method + " " + match.route->pattern;
  };
  EXPECT_EQ(pattern("GET", "/"), "GET /");
  EXPECT_EQ(pattern("HEAD", "/v1/systems"), "GET /v1/systems");
  EXPECT_EQ(pattern("POST", "/v1/energy"), "POST /v1/energy");
  EXPECT_EQ(pattern("GET", "/v1/systems/cart_pendulum"), "GET /v1/systems/{name}");
  EXPECT_EQ(routes.match("GET", "/v1/systems/cart_pendulum").captures,
            std::vector<std::string>{"cart_pendulum"});
  for (const char* path :
       {"", "//", "/v1", "/v1/", "/v1/systems/", "/v1/systems/a/b", "/v1/energy/", "v1/energy", "*"}) {
    EXPECT_EQ(pattern("GET", path), "none") << path;
    EXPECT_EQ(routes.match("GET", path).allow, "") << path;
  }
}

TEST(Routes, KnowTheMethodsOfAPath) {
  const Routes routes = example();
  EXPECT_EQ(routes.match("DELETE", "/v1/energy").allow, "GET, HEAD, POST, OPTIONS");
  EXPECT_EQ(routes.match("POST", "/v1/systems").allow, "GET, HEAD, OPTIONS");
  EXPECT_EQ(routes.match("POST", "/v1/systems").route, nullptr);
}

TEST(Timing, IsAHeaderInMilliseconds) {
  Timing timing;
  EXPECT_EQ(timing.header(), "");
  timing.lap("parse");
  timing.lap("solve");
  EXPECT_TRUE(timing.header().starts_with("parse;dur=0.")) << timing.header();
  EXPECT_NE(timing.header().find(", solve;dur="), std::string::npos) << timing.header();
}

}  // namespace
}  // namespace qdot::api
