#pragma once

#include <stdexcept>

namespace qdot::server {

/// The command line cannot be followed as it is; what() says what to type.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace qdot::server
