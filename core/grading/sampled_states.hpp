#pragma once
// Seeded states at which expressions are compared: values of symbols inside their domains, some near 1 and
// some far apart, on both sides of 0. Every value is a double with a long fraction, so that no formula can
// vanish at all of them by chance.
// Source of the random numbers: Steele, Lea, Flood, Fast splittable pseudorandom number generators, OOPSLA
// 2014 (SplitMix64).

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/expr/expression.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot {

/// SplitMix64.
class RandomBits {
 public:
  explicit RandomBits(std::uint64_t seed) : state_(seed) {}
  [[nodiscard]] std::uint64_t operator()();
  /// In [0, 1).
  [[nodiscard]] double fraction();

 private:
  std::uint64_t state_;
};

/// A number of the same bits for the same text.
[[nodiscard]] std::uint64_t hash_of(std::string_view text);

/// A symbol and where its values lie.
struct SymbolDomain {
  Expression symbol;
  Domain domain;
};

class SampledStates {
 public:
  SampledStates(std::span<const SymbolDomain> symbols, std::uint64_t seed)
      : symbols_(symbols.begin(), symbols.end()), random_(seed) {}

  /// Values in the order of the symbols. Every second state is a wide one.
  [[nodiscard]] std::vector<double> next();

 private:
  std::vector<SymbolDomain> symbols_;
  RandomBits random_;
  bool is_wide_{true};
};

}  // namespace qdot
