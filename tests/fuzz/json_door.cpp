// What passes the door for JSON is written as a text that passes again, as the same value.

#include <algorithm>

#include "api/contract/json_reader.hpp"
#include "api/json/writer.hpp"
#include "tests/fuzz/law.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace qdot;
  const auto first = api::read_json(fuzz::text_of(data, size));
  const auto* document = std::get_if<api::JsonDocument>(&first);
  if (document == nullptr) {
    const auto& problem = std::get<api::Problem>(first);
    const int status = api::problem_type(problem.kind).status;
    fuzz::require(status >= 400 && status < 500, "what does not pass is the sender's mistake");
    fuzz::require(!api::to_response(problem, "/").body.empty(), "a problem can be written");
    return 0;
  }
  for (const api::Layout layout : {api::Layout::compact, api::Layout::pretty}) {
    const std::string text = api::to_text(document->value, layout);
    const auto second = api::read_json(text, {.bytes = std::size_t{1} << 24});
    fuzz::require(std::holds_alternative<api::JsonDocument>(second), "what is written can be read");
    fuzz::require(std::get<api::JsonDocument>(second).value == document->value, "and is the same value");
  }
  return 0;
}
