#pragma once
// What this processor has beside the instructions that all of its kind have.

namespace qdot {

[[nodiscard]] inline bool has_avx2() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

/// Vectors of four doubles with fused multiply-adds.
[[nodiscard]] inline bool has_avx2_and_fma() {
#ifdef __x86_64__
  return has_avx2() && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace qdot
