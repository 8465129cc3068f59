#pragma once
// Seeded states at which expressions are compared: values of symbols inside their domains, some near 1 and
// some far apart, on both sides of 0. Every value is a double with a long fraction, so that no formula can
// vanish at all of them by chance.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/expr/expression.hpp"
#include "core/mechanics/scene.hpp"
#include "core/numerics/random_bits.hpp"

namespace qdot {

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
