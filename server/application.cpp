#include "server/application.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <mutex>
#include <new>
#include <random>
#include <string_view>
#include <utility>

#include "api/http/problem.hpp"
#include "server/engine.hpp"
#include "server/refusals.hpp"
#include "server/spread.hpp"

namespace qdot::server {
namespace {

using api::ProblemKind;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr double lengthy = 1500;  // milliseconds of one core; work that costs more has a lane of its own

/// What needs more memory than heavy work may have together waits with lengthy work, so that it holds up no
/// small one.
Lane lane_of(const api::Appraisal& appraisal, const LanesOptions& lanes) {
  if (appraisal.weight == api::Weight::light) return Lane::light;
  const bool small = appraisal.milliseconds <= lengthy && appraisal.bytes <= lanes.heavy.bytes;
  return small ? Lane::heavy : Lane::lengthy;
}

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

// These are answered on the poller's thread, however loaded the lanes are: they ask about the load.
bool is_answered_at_once(std::string_view path) {
  return is_probe(path) || path == "/metrics" || path == "/version" || path == "/v1/limits";
}

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

// Not all clients come back at once.
std::string seconds_until_retry() { return std::to_string(1 + fresh_number() % 5); }

std::string_view field(const api::Request* request, const std::string& name) {
  if (request == nullptr) return {};
  const auto found = request->headers.find(name);
  return found == request->headers.end() ? std::string_view() : found->second;
}

// The client's own id, if it is harmless in a log and in a header.
std::string request_id(const api::Request* request) {
  const auto harmless = [](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || c == '.' || c == '_' || c == '-';
  };
  const auto sent = field(request, "x-request-id");
  return !sent.empty() && sent.size() <= 64 && std::ranges::all_of(sent, harmless) ? std::string(sent)
                                                                                   : fresh_id();
}

void add_queue_time(double milliseconds, api::Response& response) {
  std::array<char, 48> text;
  std::snprintf(text.data(), text.size(), "queue;dur=%.3f", milliseconds);
  auto& timing = response.headers["Server-Timing"];
  timing = timing.empty() ? text.data() : text.data() + (", " + timing);
}

/// Who waits for longer than that has hardly time left to be answered.
LanesOptions within_deadline(LanesOptions lanes, Clock::duration deadline) {
  constexpr double part_for_waiting = 0.6;
  const double longest = part_for_waiting * std::chrono::duration<double>(deadline).count();
  for (LaneLimits* limits : {&lanes.light, &lanes.heavy, &lanes.lengthy}) {
    limits->burst_wait = std::min(limits->burst_wait, longest);
    limits->longest_wait = std::min(limits->longest_wait, longest);
    limits->done_within = std::chrono::duration<double>(deadline).count();
  }
  return lanes;
}

}  // namespace

struct Application::Case {
  explicit Case(std::shared_ptr<Exchange> its_exchange)
      : exchange(std::move(its_exchange)),
        request(std::get_if<api::Request>(&exchange->incoming)),
        refusal(std::get_if<Refusal>(&exchange->incoming)) {}

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
  api::Appraisal appraisal{};
  Lane lane{Lane::light};
  double waited{0};  // milliseconds
};

struct Application::Sent {
  std::string_view id;
  int status;
  std::uint64_t evaluations{0};
};

Application::Application(const ApplicationOptions& options, ApplicationParts parts, RequestLog& log,
                         Metrics& metrics)
    : options_(options),
      parts_(std::move(parts)),
      access_(options.hosts, options.token),
      log_(log),
      metrics_(metrics),
      lanes_(within_deadline(options.lanes, options.deadline)) {}

void Application::handle(const std::shared_ptr<Exchange>& exchange) {
  try {
    receive(exchange);
  } catch (const std::bad_alloc&) {
    exchange->answer(Outgoing::out_of_memory());
  }
}

void Application::receive(const std::shared_ptr<Exchange>& exchange) {
  Case it(exchange);
  if (it.refusal != nullptr) return finish(it, it.problem(it.refusal->kind, it.refusal->detail));
  if (const auto refused = access_.refusal(*it.request)) return finish(it, it.problem(*refused));
  it.appraisal = parts_.appraise(*it.request);
  const auto path = it.path();
  if (draining_ && path == "/readyz") return finish(it, it.problem(ProblemKind::draining));
  if (is_answered_at_once(path)) return finish(it, parts_.answer(*it.request));
  if (draining_) return finish(it, it.problem(ProblemKind::draining));
  admit(it);
}

void Application::admit(Case& it) {
  it.lane = lane_of(it.appraisal, options_.lanes);
  Lanes::Work work{.cost = it.appraisal.milliseconds,
                   .bytes = it.lane == Lane::light ? 0 : it.appraisal.bytes,
                   .task = [this, it]() mutable { compute(it); },
                   .spreads = it.lane != Lane::light && it.appraisal.spreads};
  if (has_room(it.lane) && lanes_.submit(it.lane, std::move(work))) return;
  shed(it);
  if (it.lane == Lane::light) parts_.overloaded();
}

/// Light answers are short: they are made while those of others are cut off.
bool Application::has_room(Lane lane) const {
  const std::size_t most = lane == Lane::light ? 2 * options_.unsent_bytes : options_.unsent_bytes;
  return parts_.unsent_bytes() <= most;
}

void Application::shed(Case& it) {
  metrics_.count_shed();
  thread_local Refusals refusals;
  const auto id = request_id(it.request);
  const Refusals::Asked asked{.method = it.method(), .path = it.path(), .follow = follow(it)};
  send(it, {.id = id, .status = 503}, refusals.answer(asked, id, seconds_until_retry()));
}

Follow Application::follow(const Case& it) const { return draining_ ? Follow::close : it.exchange->follow; }

void Application::compute(Case& it) {
  const auto deadline = it.exchange->arrived + options_.deadline;
  const auto given_up = [this, &exchange = *it.exchange, deadline] {
    const auto now = Clock::now();
    return exchange.abandoned() || now > deadline || now.time_since_epoch().count() > drained_by_;
  };
  std::mutex going_on;  // while its thread waits for a turn in another lane, so do those that help
  const auto over = [this, &given_up, &going_on] {
    const std::lock_guard lock(going_on);
    lanes_.make_room(given_up);
    return given_up();
  };
  try {
    it.waited = Milliseconds(Clock::now() - it.exchange->arrived).count();
    if (given_up()) return finish(it, it.problem(ProblemKind::deadline));
    // While it waited, answers before it may have piled up at clients who do not read.
    if (!has_room(it.lane)) return shed(it);
    it.request->interrupted = over;
    it.request->spread = spread_over(options_.lanes.threads, Help::beside_light_work, [&](double helped) {
      Lanes::count_help(helped);
      (void)over();
    });
    auto response = parts_.answer(*it.request);
    add_queue_time(it.waited, response);
    finish(it, std::move(response));
  } catch (const std::bad_alloc&) {
    it.exchange->answer(Outgoing::out_of_memory());
  } catch (const std::exception&) {
    // The exchange answers for itself when it is destroyed.
  }
}

void Application::finish(Case& it, api::Response response) {
  const auto id = request_id(it.request);
  response.headers["X-Request-Id"] = id;
  response.headers["X-Content-Type-Options"] = "nosniff";
  if (response.status == 503) response.headers["Retry-After"] = seconds_until_retry();
  if (response.status == 401) response.headers["WWW-Authenticate"] = "Bearer";
  const Sent sent{.id = id, .status = response.status, .evaluations = response.evaluations};
  send(it, sent,
       to_http(std::move(response), {.method = it.method(),
                                     .accept_encoding = field(it.request, "accept-encoding"),
                                     .follow = follow(it)}));
}

void Application::send(Case& it, const Sent& sent, Outgoing outgoing) {
  record(it, sent, outgoing.body().size());
  lanes_.make_way(sent.status == 503 ? Lanes::Outcome::given_up : Lanes::Outcome::computed);
  it.exchange->answer(std::move(outgoing));
}

void Application::record(const Case& it, const Sent& sent, std::size_t bytes) {
  const LogEntry entry{.id = sent.id,
                       .method = it.method(),
                       .target = it.target(),
                       .status = sent.status,
                       .bytes = bytes,
                       .milliseconds = Milliseconds(Clock::now() - it.exchange->arrived).count(),
                       .waited = it.waited,
                       .abandoned = it.exchange->abandoned()};
  if (entry.abandoned) metrics_.count_abandoned();
  metrics_.count({.method = entry.method,
                  .route = it.appraisal.route,
                  .status = entry.status,
                  .seconds = entry.milliseconds / 1000,
                  .evaluations = sent.evaluations});
  log_.write(entry);
}

void Application::drain() {
  drained_by_ = (Clock::now() + options_.drain).time_since_epoch().count();
  draining_ = true;
  lanes_.wait_until_idle();
}

}  // namespace qdot::server
