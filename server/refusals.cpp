#include "server/refusals.hpp"

#include <cstddef>
#include <utility>

#include "api/http/problem.hpp"
#include "server/engine.hpp"

namespace qdot::server {
namespace {

constexpr std::size_t most_texts = 64;  // strangers may ask for as many addresses as they like
constexpr std::string_view seconds_mark = "{seconds}";
constexpr std::string_view id_mark = "{id}";

Outgoing with_marks(const Refusals::Asked& asked) {
  constexpr auto kind = api::ProblemKind::overloaded;
  auto response = api::to_response({.kind = kind, .detail = std::string(api::problem_type(kind).explanation)},
                                   asked.path);
  response.headers["Retry-After"] = seconds_mark;
  response.headers["X-Content-Type-Options"] = "nosniff";
  response.headers["X-Request-Id"] = id_mark;
  return to_http(std::move(response), {.method = asked.method, .follow = asked.follow});
}

/// Removes what stands before `mark` from `text`, and the mark.
std::string cut_at(std::string_view mark, std::string_view& text) {
  const auto place = text.find(mark);
  std::string before(text.substr(0, place));
  text.remove_prefix(place + mark.size());
  return before;
}

}  // namespace

const Refusals::Text& Refusals::text(const Asked& asked) {
  std::string key(asked.path);
  key += asked.method == "HEAD" ? " without a body" : " ";
  key += asked.follow == Follow::close ? " and closed" : "";
  if (const auto found = texts_.find(key); found != texts_.end()) return found->second;
  if (texts_.size() >= most_texts) texts_.clear();
  const Outgoing formed = with_marks(asked);
  std::string_view head = formed.head();
  Text text{.until_seconds = cut_at(seconds_mark, head), .until_id = cut_at(id_mark, head)};
  text.until_body = head;
  text.body = formed.body();
  return texts_.emplace(std::move(key), std::move(text)).first->second;
}

Outgoing Refusals::answer(const Asked& asked, std::string_view request_id, std::string_view seconds) {
  const Text& formed = text(asked);
  std::string head;
  head.reserve(formed.until_seconds.size() + seconds.size() + formed.until_id.size() + request_id.size() +
               formed.until_body.size());
  head.append(formed.until_seconds).append(seconds).append(formed.until_id).append(request_id);
  head.append(formed.until_body);
  return {std::move(head), formed.body, asked.follow};
}

}  // namespace qdot::server
