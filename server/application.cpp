#include "server/application.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <random>
#include <string_view>
#include <utility>

#include "api/problem.hpp"
#include "server/request_log.hpp"

namespace qdot::server {
namespace {

using api::ProblemKind;

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

api::Response refused(const Refusal& refusal) {
  return api::to_response({.kind = refusal.kind, .detail = refusal.detail}, path_of(refusal.target));
}

api::Response try_later(ProblemKind kind, std::string_view path) {
  auto response =
      api::to_response({.kind = kind, .detail = std::string(api::problem_type(kind).explanation)}, path);
  response.headers.emplace("Retry-After", "1");
  return response;
}

// Only the versioned paths compute; probes and documents never wait behind them.
bool computes(std::string_view path) { return path.starts_with("/v1/"); }

// A process that is going away is alive, but neither ready nor open for work.
bool answered_while_draining(std::string_view path) { return !computes(path) && path != "/readyz"; }

std::string fresh_id() {
  thread_local std::mt19937_64 random{std::random_device{}()};
  std::string id(16, '0');
  std::ranges::generate(id, [] { return "0123456789abcdef"[random() & 15]; });
  return id;
}

// The client's own id when it is harmless in a log and in a header.
std::string request_id(const Incoming& incoming) {
  const auto* request = std::get_if<api::Request>(&incoming);
  if (!request) return fresh_id();
  const auto sent = request->headers.find("x-request-id");
  if (sent == request->headers.end()) return fresh_id();
  const auto harmless = [](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || c == '.' || c == '_' || c == '-';
  };
  const auto& id = sent->second;
  return !id.empty() && id.size() <= 64 && std::ranges::all_of(id, harmless) ? id : fresh_id();
}

}  // namespace

Application::Application(const ApplicationOptions& options, Service service)
    : options_(options), service_(std::move(service)) {}

api::Response Application::respond(const Incoming& incoming) {
  const auto start = std::chrono::steady_clock::now();
  const auto* refusal = std::get_if<Refusal>(&incoming);
  const auto* request = std::get_if<api::Request>(&incoming);
  auto response = refusal ? refused(*refusal) : admit(*request);
  const auto id = request_id(incoming);
  response.headers["X-Request-Id"] = id;
  response.headers["X-Content-Type-Options"] = "nosniff";
  if (options_.log) {
    const std::chrono::duration<double, std::milli> duration = std::chrono::steady_clock::now() - start;
    log_request(options_.log, {.id = id,
                               .method = refusal ? refusal->method : request->method,
                               .target = refusal ? refusal->target : request->target,
                               .status = response.status,
                               .bytes = response.body.size(),
                               .milliseconds = duration.count()});
  }
  return response;
}

api::Response Application::admit(const api::Request& request) {
  const auto path = path_of(request.target);
  std::unique_lock lock(mutex_);
  if (draining_ && !answered_while_draining(path)) {
    return try_later(ProblemKind::draining, path);
  }
  if (!computes(path)) {
    lock.unlock();
    return service_(request);
  }
  if (computing_ >= options_.threads) {
    if (waiting_ >= options_.queue) {
      return try_later(ProblemKind::overloaded, path);
    }
    ++waiting_;
    changed_.wait(lock, [this] { return computing_ < options_.threads; });
    --waiting_;
  }
  ++computing_;
  lock.unlock();
  return compute(request);
}

api::Response Application::compute(const api::Request& request) {
  struct Place {
    ~Place() {
      {
        const std::lock_guard lock(self.mutex_);
        --self.computing_;
      }
      self.changed_.notify_all();
    }
    Application& self;
  } place{*this};
  return service_(request);
}

void Application::drain() {
  std::unique_lock lock(mutex_);
  draining_ = true;
  changed_.wait(lock, [this] { return computing_ == 0 && waiting_ == 0; });
}

}  // namespace qdot::server
