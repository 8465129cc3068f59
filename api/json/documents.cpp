#include "api/json/documents.hpp"

namespace qdot::api {

Json parse_json(std::string_view text) { return Json::parse(text); }
Json parse_json_or_discard(std::string_view text) { return Json::parse(text, nullptr, false); }

std::string dump_json(const Json& json) { return json.dump(); }
std::string dump_json_replacing(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace qdot::api
