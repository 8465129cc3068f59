#pragma once
// /v1/sweep: one question over a grid or a sample of a system's parameters and initial values. Each row is
// the answer to one request, and columns are numbers found in it by JSON Pointer (RFC 6901).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/answers/endpoint.hpp"

namespace qdot::api {

enum class SweepFormat { json, csv, ndjson };

/// The fields as they were given. One variable may be said flat, as in a query: {"vary": "k", "from": 1,
/// ...}.
struct SweepRequest {
  Json ask{};      ///< {"modes": {...}}; in a query "modes", whose fields stand beside
  Json vary{};     ///< {"k": {"from": 1, "to": 50, "count": 50}}; or the name of the only variable
  Json collect{};  ///< {"omega": "/modes/0/omega"}; or pointers
  Json from{}, to{}, values{}, uniform{}, normal{};  ///< of the only variable; null: not given
  std::optional<std::int64_t> count{};               ///< of the only variable, or of a sample
  std::optional<std::string> spacing{};              ///< "linear" or "log"
  std::optional<std::int64_t> seed{};
  std::optional<SweepFormat> format{};  ///< none: what the Accept header says
};

[[nodiscard]] const RequestTable<SweepRequest>& sweep_table();

[[nodiscard]] Endpoint sweep_endpoint();

}  // namespace qdot::api
