#include "server/application.hpp"

#include <algorithm>
#include <cctype>
#include <random>
#include <string_view>
#include <utility>

#include "api/problem.hpp"
#include "server/request_log.hpp"

namespace qdot::server {
namespace {

using api::ProblemKind;

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

// Only the versioned paths compute; probes and documents never wait behind them.
bool computes(std::string_view path) { return path.starts_with("/v1/"); }

// A process that is going away is alive, but neither ready nor open for work.
bool answered_while_draining(std::string_view path) { return !computes(path) && path != "/readyz"; }

std::uint64_t fresh_number() {
  thread_local std::mt19937_64 random{std::random_device{}()};
  return random();
}

std::string fresh_id() {
  std::string id(16, '0');
  auto number = fresh_number();
  for (char& digit : id) {
    digit = "0123456789abcdef"[number & 15];
    number >>= 4;
  }
  return id;
}

// The client's own id when it is harmless in a log and in a header.
std::string request_id(const api::Request* request) {
  if (request == nullptr) return fresh_id();
  const auto sent = request->headers.find("x-request-id");
  if (sent == request->headers.end()) return fresh_id();
  const auto harmless = [](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || c == '.' || c == '_' || c == '-';
  };
  const auto& id = sent->second;
  return !id.empty() && id.size() <= 64 && std::ranges::all_of(id, harmless) ? id : fresh_id();
}

}  // namespace

struct Application::Case {
  explicit Case(std::shared_ptr<Exchange> exchange)
      : exchange(std::move(exchange)),
        request(std::get_if<api::Request>(&this->exchange->incoming)),
        refusal(std::get_if<Refusal>(&this->exchange->incoming)) {}

  [[nodiscard]] std::string_view method() const { return refusal ? refusal->method : request->method; }
  [[nodiscard]] std::string_view target() const { return refusal ? refusal->target : request->target; }
  [[nodiscard]] std::string_view path() const { return path_of(target()); }
  [[nodiscard]] api::Response problem(ProblemKind kind, std::string detail) const {
    return api::to_response({.kind = kind, .detail = std::move(detail)}, path());
  }
  [[nodiscard]] api::Response problem(ProblemKind kind) const {
    return problem(kind, std::string(api::problem_type(kind).explanation));
  }

  std::shared_ptr<Exchange> exchange;
  api::Request* request;
  const Refusal* refusal;
};

Application::Application(const ApplicationOptions& options, Service service)
    : options_(options), service_(std::move(service)), lanes_(options.lanes) {}

void Application::handle(const std::shared_ptr<Exchange>& exchange) {
  Case it(exchange);
  if (it.refusal != nullptr) return finish(it, it.problem(it.refusal->kind, it.refusal->detail));
  const auto path = it.path();
  if (draining_ && !answered_while_draining(path)) return finish(it, it.problem(ProblemKind::draining));
  if (!computes(path)) return finish(it, service_(*it.request));
  Lanes::Work work{.task = [this, it]() mutable { compute(it); }};
  if (!lanes_.submit(Lane::light, std::move(work))) finish(it, it.problem(ProblemKind::overloaded));
}

void Application::compute(Case& it) {
  const auto deadline = it.exchange->arrived + options_.deadline;
  const auto over = [&exchange = *it.exchange, deadline] {
    return exchange.abandoned() || Clock::now() > deadline;
  };
  try {
    if (over()) return finish(it, it.problem(ProblemKind::deadline));
    it.request->interrupted = over;
    finish(it, service_(*it.request));
  } catch (const std::exception&) {
    // The exchange answers for itself when the last one lets go of it.
  }
}

void Application::finish(Case& it, api::Response response) {
  const auto id = request_id(it.request);
  response.headers["X-Request-Id"] = id;
  response.headers["X-Content-Type-Options"] = "nosniff";
  if (response.status == 503) response.headers["Retry-After"] = std::to_string(1 + fresh_number() % 5);
  if (options_.log != nullptr) {
    const std::chrono::duration<double, std::milli> duration = Clock::now() - it.exchange->arrived;
    log_request(options_.log, {.id = id,
                               .method = it.method(),
                               .target = it.target(),
                               .status = response.status,
                               .bytes = response.body.size(),
                               .milliseconds = duration.count()});
  }
  it.exchange->answer(std::move(response));
}

void Application::drain() {
  draining_ = true;
  lanes_.wait_until_idle();
}

}  // namespace qdot::server
