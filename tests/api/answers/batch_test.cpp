#include "api/answers/batch/request.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "api/answers/endpoints.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {
namespace {

/// Its answers are as long as the number that is asked for, and it counts them.
std::atomic<int> made = 0;
Endpoint counting() {
  const auto handler = [](const FindSystem&, Models&) {
    return [](Call& call) {
      ++made;
      return Response{.body = std::string(std::stoul(call.request.body), '7')};
    };
  };
  return {.name = "modes", .question = {.handler = handler}};
}

TEST(Batch, WhatComesAfterTooManyBytesIsNotMade) {
  (void)endpoint_at("/v1/batch");  // knows the fields of a line
  const std::array asked{counting()};
  const Endpoint batch = batch_endpoint(asked);
  Models models;
  const Handler handler =
      batch.question.handler([](const Json&, const Place&, Errors&) { return nullptr; }, models);
  std::string lines;
  for (int i = 0; i < 14; ++i) lines += "{\"modes\": 1}\n";
  for (int i = 0; i < 32; ++i) lines += "{\"modes\": 7000000}\n";
  const Request request{.method = "POST", .target = "/v1/batch", .body = lines};
  Call call{.request = request, .target = {.path = "/v1/batch", .query = {}}};
  const Response response = handler(call);
  EXPECT_EQ(std::ranges::count(response.body, '\n'), 46);
  EXPECT_LE(response.body.size(), limits::batch_answer_bytes + 46 * 400);
  EXPECT_EQ(made, 14 + 3) << "two are answers, and one shows that it is too much";
}

}  // namespace
}  // namespace qdot::api
