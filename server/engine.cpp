#include "server/engine.hpp"

#include <httplib.h>

#include <algorithm>
#include <charconv>
#include <new>
#include <string>
#include <utility>

#include "api/json/text.hpp"

static_assert(sizeof(httplib::Request) == 608, "pkg-config's flags change the layout of httplib's types");

namespace qdot::server {
namespace {

constexpr std::size_t worth_compressing = 1024;
/// httplib compresses thoroughly: 50 ms for 1 MiB. What is longer would overrun the deadline of its request.
constexpr std::size_t compressed_in_time = std::size_t{1} << 20;

/// "gzip;q=0.5": its quality, 1 without one.
double quality(std::string_view parameters) {
  const auto mark = parameters.find("q=");
  double value = 1;
  if (mark != parameters.npos)
    std::from_chars(parameters.data() + mark + 2, parameters.data() + parameters.size(), value);
  return value;
}

/// Does Accept-Encoding want gzip? "gzip;q=0" says no; "*" stands for all that are not named. httplib looks
/// for the word alone, and prefers Brotli.
bool accepts_gzip(std::string_view accept_encoding) {
  double named = -1;
  double any = 0;
  while (!accept_encoding.empty()) {
    const auto part = accept_encoding.substr(0, accept_encoding.find(','));
    accept_encoding.remove_prefix(std::min(part.size() + 1, accept_encoding.size()));
    const auto name = api::lower_case(api::trimmed(part.substr(0, part.find(';'))));
    if (name == "gzip" || name == "x-gzip") named = quality(part);
    if (name == "*") any = quality(part);
  }
  return (named < 0 ? any : named) > 0;
}

/// A server that never listens. It has one request at a time, so each thread has its own.
class Engine final : httplib::Server {
 public:
  Engine() {
    set_pre_routing_handler([this](const httplib::Request&, httplib::Response& answer) {
      begin(answer);
      return HandlerResponse::Handled;
    });
    set_post_routing_handler(
        [this](const httplib::Request&, httplib::Response& answer) { complete(answer); });
    // Without a handler httplib would tell the client what was thrown.
    set_exception_handler([](const httplib::Request&, httplib::Response&, const std::exception_ptr& thrown) {
      std::rethrow_exception(thrown);
    });
  }

  Outgoing run(api::Response response, const Form& form) {
    response_ = std::move(response);
    form_ = form;
    body_.clear();  // an answer for which memory ran out may have left it
    constexpr std::string_view any_request = "GET / HTTP/1.1\r\n\r\n";
    httplib::detail::BufferStream stream;
    stream.write(any_request.data(), any_request.size());
    const auto describe = [this](httplib::Request& request) {
      request.method = form_.method;
      if (compresses()) request.headers.emplace("Accept-Encoding", "gzip");
    };
    // What becomes of the connection is not httplib's to say; see complete().
    constexpr bool close = true;
    bool closed = false;
    if (!process_request(stream, close, closed, describe)) throw std::bad_alloc();
    return {stream.get_buffer().substr(any_request.size()), std::move(body_), form_.follow};
  }

 private:
  [[nodiscard]] bool compresses() const {
    return response_.status == 200 && response_.body.size() >= worth_compressing &&
           response_.body.size() <= compressed_in_time && accepts_gzip(form_.accept_encoding);
  }

  void begin(httplib::Response& answer) {
    answer.status = response_.status;
    answer.body = std::move(response_.body);
    // httplib compresses text, but does not know all kinds of it by name; complete() says which it is.
    answer.headers.emplace("Content-Type", "text/plain");
  }

  /// The body is now as it will be sent, and the head is written next. httplib's own fields are replaced:
  /// they promise ranges, and to keep the connection for five requests.
  void complete(httplib::Response& answer) {
    const bool bodiless = answer.status == 204 || answer.status == 304;
    const bool compressed = answer.has_header("Content-Encoding");
    answer.headers.clear();
    for (const auto& [name, value] : response_.headers) {
      // The tag is that of the plain bytes; compressed it is the same document, but not the same bytes.
      answer.set_header(name, compressed && name == "ETag" ? "W/" + value : value);
    }
    if (compressed) answer.set_header("Content-Encoding", "gzip");
    if (!bodiless) answer.set_header("Content-Length", std::to_string(answer.body.size()));
    if (!bodiless && !response_.content_type.empty())
      answer.set_header("Content-Type", response_.content_type);
    answer.set_header("Connection", form_.follow == Follow::close ? "close" : "keep-alive");
    // The body goes its own way to the socket: httplib would copy it twice, which takes 40 us for 100 kB.
    if (form_.method != "HEAD" && !bodiless) body_ = std::move(answer.body);
    answer.body.clear();
  }

  api::Response response_;
  Form form_;
  std::string body_;
};

}  // namespace

Outgoing to_http(api::Response response, const Form& form) {
  if (response.status == 200 || response.status == 304) {
    auto& vary = response.headers["Vary"];
    vary += vary.empty() ? "Accept-Encoding" : ", Accept-Encoding";
  }
  thread_local Engine engine;
  return engine.run(std::move(response), form);
}

}  // namespace qdot::server
