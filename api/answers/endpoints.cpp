#include "api/answers/endpoints.hpp"

#include <algorithm>
#include <vector>

#include "api/answers/batch/request.hpp"
#include "api/answers/check/request.hpp"
#include "api/answers/embedded.hpp"
#include "api/answers/questions.hpp"
#include "api/answers/sweep/request.hpp"
#include "api/json/documents.hpp"

namespace qdot::api {

namespace {

/// What a line of a batch may ask.
std::span<const Endpoint> endpoints_of_lines() {
  static const std::vector<Endpoint> all = [] {
    std::vector<Endpoint> result(questions().begin(), questions().end());
    result.push_back(check_endpoint());
    result.push_back(sweep_endpoint());
    return result;
  }();
  return all;
}

}  // namespace

std::span<const Endpoint> endpoints() {
  static const std::vector<Endpoint> all = [] {
    std::vector<Endpoint> result(endpoints_of_lines().begin(), endpoints_of_lines().end());
    result.push_back(batch_endpoint(endpoints_of_lines()));
    return result;
  }();
  return all;
}

std::string address_of(const Endpoint& endpoint) { return "/v1/" + std::string(endpoint.name); }

namespace {

bool is_address_of(const Endpoint& endpoint, std::string_view address) {
  const std::string own = address_of(endpoint);
  return std::ranges::any_of(
      endpoint.offers, [&](const std::string& type) { return own + suffix_of(endpoint, type) == address; });
}

}  // namespace

const Endpoint* endpoint_at(std::string_view address) {
  const auto found =
      std::ranges::find_if(endpoints(), [&](const Endpoint& e) { return is_address_of(e, address); });
  return found == endpoints().end() ? nullptr : &*found;
}

bool asks_about_a_system(const Endpoint& endpoint) {
  return endpoint.question.fields->find("system") != nullptr;
}

std::string suffix_of(const Endpoint& endpoint, std::string_view media_type) {
  if (media_type == endpoint.offers.front()) return "";
  if (media_type == "text/csv") return ".csv";
  return media_type == "application/x-ndjson" ? ".ndjson" : "";
}

bool is_called(const Endpoint& endpoint, std::string_view word) {
  return word == endpoint.name || std::ranges::find(endpoint.other_names, word) != endpoint.other_names.end();
}

Json description_of(const Endpoint& endpoint) {
  return parse_json(text_of(endpoint_files(), std::string(endpoint.name) + ".json"));
}

}  // namespace qdot::api
