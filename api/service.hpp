#pragma once
// The contract without sockets: request value in, response value out. The server and the command line are
// two thin callers of Service::handle.

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
};

struct ServiceOptions {
  std::string scenes_directory;  ///< more scenes, one JSON file each; empty: the catalogue alone
};

/// Immutable after construction and shared by threads. The constructor throws std::runtime_error with every
/// mistake of every scene file when one in scenes_directory does not load.
class Service {
 public:
  explicit Service(const ServiceOptions& options = {});
  ~Service();
  [[nodiscard]] Response handle(const Request& request) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// The version of the program, as in the answers' `service_version`.
[[nodiscard]] std::string_view service_version();

}  // namespace qdot::api
