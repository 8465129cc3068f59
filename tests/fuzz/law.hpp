#pragma once
// What a fuzz target says of its input. A law that does not hold ends the process, so that the fuzzer keeps
// the input.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace qdot::fuzz {

/// What one input may cost, as what a request may: a second or two under the sanitizers.
inline constexpr std::uint64_t algebra = 100'000;

inline void require(bool holds, const char* law) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", law);
  std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace qdot::fuzz
