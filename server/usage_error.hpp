#pragma once
// The command line cannot be followed as it is: an unknown option, a missing file, two options that exclude
// each other. main() prints what() and ends with the exit code for wrong usage.

#include <stdexcept>

namespace qdot::server {

/// what() says what to type instead.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace qdot::server
