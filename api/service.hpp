#pragma once
// The contract without sockets: request value in, response value out. The server and the command line are
// two thin callers of Service::handle.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace qdot::api {

struct Request {
  std::string method{};                          ///< "GET", "POST", ...
  std::string target{};                          ///< path and query as sent, "/v1/energy?system=..."
  std::map<std::string, std::string> headers{};  ///< names in lower case
  std::string body{};
  std::function<bool()> interrupted{};  ///< optional: true when nobody waits for the answer any more
};

/// The answer to HEAD is that to GET, body included: the transport sends its length and leaves it out.
struct Response {
  int status{200};
  std::string content_type{};
  std::map<std::string, std::string> headers{};  ///< beside Content-Type: Allow, ETag, Server-Timing
  std::string body{};
  std::uint64_t evaluations{0};  ///< of equations of motion, for those who count work
};

/// What a request will cost, roughly (api/appraisal.hpp).
enum class Weight { light, heavy };
struct Appraisal {
  /// The pattern of its address, "/v1/systems/{name}"; "none": no such address.
  std::string_view route{"none"};
  double milliseconds{1};
  std::size_t bytes{0};  ///< of memory while it is answered, where they are many
  Weight weight{Weight::light};
};

/// A file for browsers.
struct Page {
  std::string_view path;          ///< "/", beside the index; "/docs"; "/docs/style.css"
  std::string_view content_type;  ///< "text/html"
  std::string_view text;
};

struct ServiceOptions {
  std::string scenes_directory{};          ///< more scenes, one JSON file each; empty: the catalogue alone
  std::function<std::string()> metrics{};  ///< what GET /metrics answers; without it there is no such address
  std::vector<Page> pages{};
};

/// Immutable after construction and shared by threads. The constructor throws std::runtime_error with every
/// mistake of every scene file when one in scenes_directory does not load.
class Service {
 public:
  explicit Service(const ServiceOptions& options = {});
  ~Service();
  [[nodiscard]] Response handle(const Request& request) const noexcept;
  /// Takes microseconds, and less than two milliseconds for the worst request.
  [[nodiscard]] Appraisal appraise(const Request& request) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// The version of the program, as in the answers' `service_version`.
[[nodiscard]] std::string_view service_version();

}  // namespace qdot::api
