#pragma once
// What passes between the sockets or the command line and the contract: requests, responses, what a request
// will cost, and the files for browsers. Values only.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace qdot::api {

/// Whether the others are still wanted. It must not throw.
using SpreadTask = std::function<bool(std::size_t)>;

/// Calls a task with each of 0 to count - 1 in order, in several threads if there are several, until all are
/// done or not wanted any more.
using Spread = std::function<void(std::size_t count, const SpreadTask& task)>;

/// A service bounds what a request may cost; on someone's own machine it costs what it costs.
enum class Work { bounded, unbounded };

struct Request {
  std::string method{};                          ///< "GET", "POST", ...
  std::string target{};                          ///< path and query as sent, "/v1/energy?system=..."
  std::map<std::string, std::string> headers{};  ///< names in lower case
  std::string body{};
  std::function<bool()> interrupted{};  ///< optional: true when nobody waits for the answer any more
  Spread spread{};                      ///< optional: threads for a request that is made of many
  Work work{Work::bounded};
};

/// The answer to HEAD is that to GET, body included: the transport sends its length and leaves it out.
struct Response {
  int status{200};
  std::string content_type{};
  std::map<std::string, std::string> headers{};  ///< beside Content-Type: Allow, ETag, Server-Timing
  std::string body{};
  std::uint64_t evaluations{0};  ///< of equations of motion, for those who count work
};

/// What a request will cost, roughly (api/about/appraisal.hpp).
enum class Weight { light, heavy };
struct Appraisal {
  /// The pattern of its address, "/v1/systems/{name}"; "none": no such address.
  std::string_view route{"none"};
  double milliseconds{1};
  std::size_t bytes{0};  ///< of memory while it is answered, where they are many
  bool spreads{false};   ///< over threads, because it is made of many
  Weight weight{Weight::light};
};

/// A file for browsers.
struct Page {
  std::string path;               ///< "/", beside the index; "/docs"; "/page/style.css", a part of others
  std::string_view content_type;  ///< "text/html"
  std::string_view text;
};

}  // namespace qdot::api
