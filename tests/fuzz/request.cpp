// A whole request: whatever is asked, the answer is of the contract, and asked again it is the same.
// The first line is method and target, the rest the body.

#include <string>

#include "api/json/json.hpp"
#include "api/service.hpp"
#include "tests/fuzz/law.hpp"

namespace {

using namespace qdot;

constexpr int patience = 300;  // questions whether anybody still waits, a few hundred evaluations each

api::Response answer(const api::Service& service, std::string_view input) {
  const std::size_t end = std::min(input.find('\n'), input.size());
  const std::string_view line = input.substr(0, end);
  const std::size_t blank = std::min(line.find(' '), line.size());
  int asked = 0;
  return service.handle({.method = std::string(line.substr(0, blank)),
                         .target = std::string(line.substr(std::min(blank + 1, line.size()))),
                         .headers = {},
                         .body = std::string(input.substr(std::min(end + 1, input.size()))),
                         .interrupted = [&asked] { return ++asked > patience; }});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const api::Service service;
  const std::string_view input = fuzz::text_of(data, std::min<std::size_t>(size, 4000));
  const api::Response first = answer(service, input);
  fuzz::require(first.status != 500, "a defect is not the client's");
  fuzz::require(first.status >= 200 && first.status < 600, "a status is one");
  if (first.content_type.ends_with("json")) {
    fuzz::require(first.body.ends_with('\n'), "a body ends in a newline");
    const api::Json body = api::Json::parse(first.body, nullptr, false);
    fuzz::require(body.is_object(), "a body is an object");
    fuzz::require(first.status == 200 || body["status"] == first.status, "a problem has its status");
  }
  fuzz::require(answer(service, input).body == first.body, "the same request has the same answer");
  return 0;
}
