#include "server/problem.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace qdot::server {
namespace {

constexpr std::size_t max_echo = 200;  // bytes of a request that an answer repeats

constexpr std::array<std::pair<int, std::string_view>, 23> phrases{{
    {200, "OK"},
    {204, "No Content"},
    {304, "Not Modified"},
    {400, "Bad Request"},
    {403, "Forbidden"},
    {404, "Not Found"},
    {405, "Method Not Allowed"},
    {406, "Not Acceptable"},
    {408, "Request Timeout"},
    {411, "Length Required"},
    {413, "Content Too Large"},
    {414, "URI Too Long"},
    {415, "Unsupported Media Type"},
    {417, "Expectation Failed"},
    {421, "Misdirected Request"},
    {422, "Unprocessable Content"},
    {429, "Too Many Requests"},
    {431, "Request Header Fields Too Large"},
    {500, "Internal Server Error"},
    {501, "Not Implemented"},
    {503, "Service Unavailable"},
    {504, "Gateway Timeout"},
    {505, "HTTP Version Not Supported"},
}};

}  // namespace

std::string_view reason_phrase(int status) {
  for (const auto& [code, phrase] : phrases) {
    if (code == status) return phrase;
  }
  return "";
}

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

api::Response problem(int status, std::string_view kind, std::string_view detail, std::string_view instance) {
  const nlohmann::ordered_json body{{"type", "/errors/" + std::string(kind)},
                                    {"title", reason_phrase(status)},
                                    {"status", status},
                                    {"detail", detail},
                                    {"instance", path_of(instance).substr(0, max_echo)}};
  api::Response response;
  response.status = status;
  response.content_type = "application/problem+json";
  // A target may hold any bytes; what is not UTF-8 is replaced.
  response.body = body.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  return response;
}

}  // namespace qdot::server
