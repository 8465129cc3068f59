#pragma once
// Random numbers that are the same everywhere, from a seed. Source: Steele, Lea, Flood, Fast splittable
// pseudorandom number generators, OOPSLA 2014 (SplitMix64).

#include <cstdint>

namespace qdot {

class RandomBits {
 public:
  /// As if `drawn` of them had been taken before.
  explicit RandomBits(std::uint64_t seed, std::uint64_t drawn = 0) : state_(seed + drawn * step) {}

  [[nodiscard]] std::uint64_t operator()() {
    std::uint64_t z = (state_ += step);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

  /// In [0, 1).
  [[nodiscard]] double fraction() { return static_cast<double>((*this)() >> 11U) * 0x1p-53; }

 private:
  static constexpr std::uint64_t step = 0x9E3779B97F4A7C15U;
  std::uint64_t state_;
};

}  // namespace qdot
