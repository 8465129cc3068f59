#pragma once
// The contract without sockets: request value in, response value out. The server and the command line are
// two thin callers of Service::handle.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "api/answers/check/sheet_error.hpp"
#include "api/http/messages.hpp"
#include "api/json/layout.hpp"

namespace qdot::api {

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
  /// A variant of a key in JSON (api/answers/check/variant.hpp).
  [[nodiscard]] std::variant<std::string, SheetError> variant(std::string_view key, std::uint64_t seed,
                                                              Layout layout) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace qdot::api
