#pragma once
// What is printed has arrived, or the command says that it has not: a disk may be full.

#include <ostream>
#include <stdexcept>
#include <string_view>

namespace qdot::server {

/// What was to be printed could not be written; what() says why.
struct CannotWrite : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws CannotWrite with the reason that errno has for `what`, such as "the answer".
[[noreturn]] void refuse_to_lose(std::string_view what);

/// Prints the text, and all that the stream still holds. Throws CannotWrite.
void write_out(std::ostream& stream, std::string_view text);

}  // namespace qdot::server
