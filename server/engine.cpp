#include "server/engine.hpp"

#include <httplib.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include "api/text.hpp"

static_assert(sizeof(httplib::Request) == 608, "pkg-config's flags change the layout of httplib's types");

namespace qdot::server {
namespace {

constexpr std::size_t worth_compressing = 1024;

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

bool accepts_gzip(const Incoming& incoming) {
  const auto* request = std::get_if<api::Request>(&incoming);
  if (request == nullptr) return false;
  const auto found = request->headers.find("accept-encoding");
  return found != request->headers.end() && accepts_gzip(found->second);
}

const std::string& method_of(const Incoming& incoming) {
  const auto* refusal = std::get_if<Refusal>(&incoming);
  return refusal != nullptr ? refusal->method : std::get<api::Request>(incoming).method;
}

/// A request line in, the head of an answer out.
class Memory final : public httplib::Stream {
 public:
  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* to, std::size_t size) override {
    size = std::min(size, in_.size());
    std::memcpy(to, in_.data(), size);
    in_.remove_prefix(size);
    return static_cast<ssize_t>(size);
  }
  ssize_t write(const char* from, std::size_t size) override {
    out_.append(from, size);
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return INVALID_SOCKET; }
  std::string take() { return std::move(out_); }

 private:
  std::string_view in_{"GET / HTTP/1.1\r\n\r\n"};
  std::string out_;
};

/// A server for one request, which never listens; making one costs 0.15 us.
class Engine final : httplib::Server {
 public:
  Engine(api::Response response, const Incoming& incoming, Follow follow)
      : response_(std::move(response)), incoming_(incoming), follow_(follow) {
    set_pre_routing_handler([this](const httplib::Request&, httplib::Response& answer) {
      begin(answer);
      return HandlerResponse::Handled;
    });
    set_post_routing_handler(
        [this](const httplib::Request& request, httplib::Response& answer) { complete(request, answer); });
    // Without a handler of its own httplib would tell the client what was thrown.
    set_exception_handler([](const httplib::Request&, httplib::Response&, const std::exception_ptr& thrown) {
      std::rethrow_exception(thrown);
    });
  }

  Outgoing run() {
    Memory memory;
    bool closed = false;
    const auto ask = [this](httplib::Request& request) {
      request.method = method_of(incoming_);
      if (compresses()) request.headers.emplace("Accept-Encoding", "gzip");
    };
    // The connection is not httplib's to keep: complete() says what becomes of it.
    constexpr bool close = true;
    if (!process_request(memory, close, closed, ask)) throw std::bad_alloc();
    return {memory.take(), std::move(body_), follow_};
  }

 private:
  [[nodiscard]] bool compresses() const {
    return response_.status == 200 && response_.body.size() >= worth_compressing && accepts_gzip(incoming_);
  }

  void begin(httplib::Response& answer) {
    answer.status = response_.status;
    answer.body = std::move(response_.body);
    // What httplib compresses is text; complete() says which text.
    answer.headers.emplace("Content-Type", "text/plain");
  }

  /// httplib has compressed the body, and next writes the head. Of its fields those about the body are kept.
  void complete(const httplib::Request& request, httplib::Response& answer) {
    const bool bodiless = answer.status == 204 || answer.status == 304;
    const bool compressed = answer.has_header("Content-Encoding");
    answer.headers.clear();
    const auto set = [&](const std::string& name, const std::string& value) {
      answer.set_header(name, value);
    };
    for (const auto& [name, value] : response_.headers) {
      // The tag is that of the plain bytes; compressed it is the same document, but not the same bytes.
      set(name, compressed && name == "ETag" ? "W/" + value : value);
    }
    if (compressed) set("Content-Encoding", "gzip");
    if (!bodiless) set("Content-Length", std::to_string(answer.body.size()));
    if (!bodiless && !response_.content_type.empty()) set("Content-Type", response_.content_type);
    set("Connection", follow_ == Follow::close ? "close" : "keep-alive");
    // The body goes its own way to the socket, because httplib would copy it once more.
    if (request.method != "HEAD" && !bodiless) body_ = std::move(answer.body);
    answer.body.clear();
  }

  api::Response response_;
  const Incoming& incoming_;
  const Follow follow_;
  std::string body_;
};

void append_to_list(std::string& list, std::string_view entry) {
  list.append(list.empty() ? "" : ", ").append(entry);
}

}  // namespace

Outgoing to_http(api::Response response, const Incoming& incoming, Follow follow) {
  if (response.status == 200 || response.status == 304)
    append_to_list(response.headers["Vary"], "Accept-Encoding");
  return Engine(std::move(response), incoming, follow).run();
}

}  // namespace qdot::server
