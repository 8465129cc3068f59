#pragma once
// `qdot variant KEY.json --seed N`: a key with ranges as that of one student.

#include <cstdint>
#include <string>

#include "server/commands.hpp"

namespace qdot::server {

struct VariantOptions {
  std::string key;  ///< a file; "-" or empty: stdin
  std::uint64_t seed{};
  bool pretty{false};
  std::string scenes;  ///< a directory of more scenes
};

/// Prints the variant on stdout, or on stderr why there is none.
[[nodiscard]] ExitCode print_variant(const VariantOptions& options);

}  // namespace qdot::server
