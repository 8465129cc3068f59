#pragma once
// The errors that the server itself finds, in the form of RFC 9457, as those of api::Service.

#include <string_view>

#include "api/service.hpp"

namespace qdot::server {

/// `kind` is the last part of the problem's type, "/errors/{kind}". Throws only std::bad_alloc.
[[nodiscard]] api::Response problem(int status, std::string_view kind, std::string_view detail,
                                    std::string_view instance);

/// The standard reason phrase of a status, "" when it has none here.
[[nodiscard]] std::string_view reason_phrase(int status);

/// The path of a request target: all before '?'.
[[nodiscard]] std::string_view path_of(std::string_view target);

}  // namespace qdot::server
