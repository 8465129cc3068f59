#include "api/about/appraisal.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "api/answers/endpoints.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {
namespace {

/// What the service's route to an endpoint is, as far as an appraisal looks at it.
const Route& route_to(const std::string& address) {
  static std::map<std::string, Route> routes;
  return routes.try_emplace(address, Route{.pattern = address, .cost = endpoint_at(address)->cost})
      .first->second;
}
Appraisal of(const std::string& address, const std::string& body) {
  return appraise(route_to(address), {.method = "POST", .target = address, .body = body});
}
Appraisal of_query(const std::string& query) {
  return appraise(route_to("/v1/simulate"), {.method = "GET", .target = "/v1/simulate?" + query});
}
std::string motion(const std::string& more) { return R"({"system": "cart_pendulum", )" + more + "}"; }

TEST(Appraisal, ALongerMotionCostsMore) {
  double before = 0;
  for (const char* end : {"1", "10", "100", "1000"}) {
    const double cost = of("/v1/simulate", motion(R"("t_end": )" + std::string(end))).milliseconds;
    EXPECT_GT(cost, before);
    before = cost;
  }
  EXPECT_EQ(of("/v1/simulate", motion(R"("t_end": 10)")).weight, Weight::light);
  EXPECT_EQ(of("/v1/simulate", motion(R"("t_end": 1000)")).weight, Weight::heavy);
}

TEST(Appraisal, SoDoRowsColumnsEventsAndDearMethods) {
  const double plain = of("/v1/simulate", motion(R"("t_end": 10)")).milliseconds;
  for (const char* more :
       {R"("samples": 100000)", R"("dt": 1e-4)", R"("samples": 5000, "include": ["energy", "momenta"])",
        R"("events": ["theta=0", "x=0"])", R"("method": "bdf")", R"("t_start": -500)"}) {
    EXPECT_GT(of("/v1/simulate", motion(R"("t_end": 10, )" + std::string(more))).milliseconds, plain) << more;
  }
  const auto large = of("/v1/simulate", motion(R"("t_end": 10, "samples": 100000)"));
  EXPECT_GT(large.bytes, std::size_t{10} << 20);
}

TEST(Appraisal, SoDoesCompression) {
  const std::string body = motion(R"("t_end": 1, "samples": 4000)");
  EXPECT_EQ(of("/v1/simulate", body).weight, Weight::light);
  const auto compressed = appraise(route_to("/v1/simulate"), {.method = "POST",
                                                              .target = "/v1/simulate",
                                                              .headers = {{"accept-encoding", "gzip, br"}},
                                                              .body = body});
  EXPECT_EQ(compressed.weight, Weight::heavy);
}

TEST(Appraisal, BothRoadsAreAppraisedAlike) {
  const auto body = of("/v1/simulate", motion(R"("t_end": "2 min", "samples": 300)"));
  const auto query = of_query("system=cart_pendulum&t_end=2%20min&samples=300");
  EXPECT_DOUBLE_EQ(body.milliseconds, query.milliseconds);
  EXPECT_EQ(body.weight, Weight::heavy);
}

TEST(Appraisal, TimesMayBeWrittenInMoreThanOneWay) {
  const double numbers = of("/v1/simulate", motion(R"("times": [0, 500])")).milliseconds;
  EXPECT_GT(numbers, 40);
  EXPECT_DOUBLE_EQ(of("/v1/simulate", motion(R"("times": ["0", "500 s"])")).milliseconds, numbers);
  EXPECT_DOUBLE_EQ(of("/v1/simulate", motion(R"("times": "0,500")")).milliseconds, numbers);
  EXPECT_DOUBLE_EQ(of_query("system=cart_pendulum&times=0,500").milliseconds, numbers);
}

TEST(Appraisal, MoreDigitsAndQuickSystemsCostMore) {
  const auto of_system = [](const std::string& name) {
    return of("/v1/simulate", R"({"t_end": 100, "system": ")" + name + "\"}").milliseconds;
  };
  EXPECT_GT(of_system("compass_walker"), 10 * of_system("cart_pendulum"));
  EXPECT_GT(of_system("rod_pendulum"), 3 * of_system("cart_pendulum"));
  EXPECT_GT(of("/v1/simulate", motion(R"("t_end": 100, "precision": "extended")")).milliseconds,
            20 * of_system("cart_pendulum"));
}

TEST(Appraisal, ASystemThatTheRequestBringsHasToBeDerived) {
  const auto chain = [](int links) {
    std::string coordinates;
    for (int i = 0; i < links; ++i) coordinates += R"(,{"name": "x"})";
    return of("/v1/energy", R"({"system": {"coordinates": [)" + coordinates.substr(1) + "]}}");
  };
  EXPECT_EQ(chain(1).weight, Weight::light);
  EXPECT_EQ(chain(8).weight, Weight::heavy);
}

TEST(Appraisal, ABatchCostsWhatItsLinesCost) {
  const std::string line = R"({"id": 1, "simulate": )" + motion(R"("t_end": 50)") + "}\n";
  const double one = of("/v1/batch", line).milliseconds;
  std::string lines;
  for (int i = 0; i < 200; ++i) lines += line;  // more than is read
  EXPECT_GT(one, of("/v1/simulate", motion(R"("t_end": 50)")).milliseconds);
  EXPECT_NEAR(of("/v1/batch", lines).milliseconds / one, 200, 1);
  EXPECT_EQ(of("/v1/batch", lines).weight, Weight::heavy);
  EXPECT_EQ(of("/v1/batch", R"({"id": 1, "energy": {"system": "cart_pendulum"}})").weight, Weight::light);
  EXPECT_NEAR(of("/v1/batch", std::string(40000, ' ') + "\n" + line).milliseconds, one, 0.2);
  const std::string sweep = R"({"sweep": {"ask": {"modes": {"system": "cart_pendulum"}},)"
                            R"( "vary": {"k": {"from": 1, "to": 2, "count": 1000}}}})";
  EXPECT_EQ(of("/v1/batch", sweep).weight, Weight::heavy);
  const auto unread = of("/v1/batch", R"({"id": ")" + std::string(40000, 'x') + "\"}");
  EXPECT_GE(unread.bytes, limits::batch_answer_bytes);
  for (const char* wrong : {"", "\n\n", "[", "{}\n[]", R"({"energy": 3})"})
    EXPECT_EQ(of("/v1/batch", wrong).weight, Weight::light) << wrong;
}

TEST(Appraisal, ASweepCostsWhatItsRowsCost) {
  const auto sweep = [](const std::string& vary) {
    return of("/v1/sweep",
              R"({"ask": {"simulate": )" + motion(R"("t_end": 50)") + R"(}, "vary": )" + vary + "}");
  };
  const double one = of("/v1/simulate", motion(R"("t_end": 50)")).milliseconds;
  const auto grid = sweep(R"({"k": {"from": 1, "to": 2, "count": 20}, "m": {"values": [1, 2, 3]}})");
  EXPECT_NEAR(grid.milliseconds, 60 * one, one);
  EXPECT_EQ(grid.weight, Weight::heavy);
  EXPECT_TRUE(grid.spreads);
  EXPECT_FALSE(of("/v1/simulate", motion(R"("t_end": 1000)")).spreads);
  EXPECT_NEAR(sweep(R"({"k": {"uniform": [1, 2]}}, "count": 50)").milliseconds, 50 * one, one);
  EXPECT_LT(sweep(R"({"k": {"from": 1, "to": 2, "count": 1e300}})").milliseconds, 1e6);
  for (const char* wrong : {"null", "{}", "[]", "3", R"({"k": 3})"}) EXPECT_GT(sweep(wrong).milliseconds, 0);
  const auto query = appraise(
      route_to("/v1/sweep"),
      {.method = "GET",
       .target = "/v1/sweep?ask=simulate&system=cart_pendulum&t_end=50&vary=k&from=1&to=2&count=40"});
  EXPECT_NEAR(query.milliseconds, 40 * one, one);
}

TEST(Appraisal, ACheckCostsWhatItsItemsAreHeldAgainst) {
  const auto check = [](const std::string& expect, int count = 1) {
    std::string items;
    for (int i = 0; i < count; ++i)
      items += R"(,{"id": ")" + std::to_string(i) + R"(", "expect": )" + expect + "}";
    return of("/v1/check", R"({"items": [)" + items.substr(1) + "]}");
  };
  const std::string turning = R"({"turning_points": {"system": "free_spin_pendulum"}, "at": "/theta_max"})";
  EXPECT_EQ(check(turning).weight, Weight::light);
  EXPECT_GT(check(turning, 9).milliseconds, 8 * check(turning).milliseconds);
  for (const char* dear : {R"({"gait": {"system": "compass_walker"}, "at": "/gaits/0/step_time"})",
                           R"({"accuracy": {"system": "cart_pendulum"}, "at": "/rows/0"})",
                           R"({"simulate": {"system": "cart_pendulum", "t_end": 1000}, "at": "/t_reached"})"})
    EXPECT_EQ(check(dear).weight, Weight::heavy) << dear;
  for (const char* wrong : {"3", "[]", R"({"energy": 3})", R"({"equation": []})", "null"})
    EXPECT_EQ(check(wrong).weight, Weight::light) << wrong;
}

TEST(Appraisal, WhatCannotBeReadIsCheapUnlessItIsLarge) {
  for (const char* body :
       {"", "{", "[]", "null", R"({"t_end": "soon", "samples": {}, "times": 3, "system": []})",
        R"({"t_end": 1e999})", R"({"dt": 0, "t_end": []})"}) {
    const auto found = of("/v1/simulate", body);
    EXPECT_EQ(found.weight, Weight::light) << body;
    EXPECT_GT(found.milliseconds, 0) << body;
  }
  EXPECT_EQ(of("/v1/simulate", "{" + std::string(40000, ' ') + "}").weight, Weight::heavy);
  EXPECT_EQ(of("/v1/simulate", std::string(limits::large_body_bytes + 1, ' ')).weight, Weight::light);
}

TEST(Appraisal, ExtremeNumbersStayFinite) {
  for (const char* more : {R"("t_end": 1e308, "t_start": -1e308)", R"("t_end": 1, "dt": 1e-308)",
                           R"("t_end": 1, "samples": 1e308)", R"("steps": 1e300)", R"("times": [1e308])"}) {
    const auto found = of("/v1/simulate", motion(more));
    EXPECT_GT(found.milliseconds, 0) << more;
    EXPECT_LT(found.milliseconds, 1e4) << more;
    EXPECT_LT(found.bytes, std::size_t{1} << 30) << more;
  }
}

}  // namespace
}  // namespace qdot::api
