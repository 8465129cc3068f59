#pragma once
// /v1/equations: everything that is derived from a scene, written out in one of the printed forms
// (core/expr/print/print.hpp).

#include "api/answers/endpoint.hpp"
#include "core/expr/print/print.hpp"

namespace qdot::api {

/// Symbols only: parameters and states do not enter.
struct EquationsRequest {
  SystemChoice system{};
  Form form{Form::text};
};

[[nodiscard]] const RequestTable<EquationsRequest>& equations_table();

[[nodiscard]] Endpoint equations_endpoint();

}  // namespace qdot::api
