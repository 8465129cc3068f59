#include "api/answers/endpoints.hpp"

#include <algorithm>
#include <vector>

#include "api/answers/check/request.hpp"
#include "api/answers/embedded.hpp"
#include "api/answers/questions.hpp"

namespace qdot::api {

std::span<const Endpoint> endpoints() {
  static const std::vector<Endpoint> all = [] {
    std::vector<Endpoint> result(questions().begin(), questions().end());
    result.push_back(check_endpoint());
    return result;
  }();
  return all;
}

std::string address_of(const Endpoint& endpoint) { return "/v1/" + std::string(endpoint.name); }

const Endpoint* endpoint_at(std::string_view address) {
  const auto found =
      std::ranges::find_if(endpoints(), [&](const Endpoint& e) { return address_of(e) == address; });
  return found == endpoints().end() ? nullptr : &*found;
}

bool asks_about_a_system(const Endpoint& endpoint) {
  return endpoint.question.fields->find("system") != nullptr;
}

Json description_of(const Endpoint& endpoint) {
  return Json::parse(text_of(endpoint_files(), std::string(endpoint.name) + ".json"));
}

}  // namespace qdot::api
