#pragma once
// Which node has which hash. Graphs are copied for every answer, so it is one vector: open addressing, at
// most half full, a free slot ends a search.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/expr/node.hpp"

namespace qdot {

class NodeIndex {
 public:
  static constexpr NodeId none = ~NodeId{0};

  /// The node with this hash for which `is_it(id)`; none if there is none.
  template <class IsIt>
  [[nodiscard]] NodeId find(std::size_t hash, const IsIt& is_it) const {
    if (slots_.empty()) return none;
    for (std::size_t i = start(hash); slots_[i].id != none; i = next(i)) {
      if (slots_[i].hash == hash && is_it(slots_[i].id)) return slots_[i].id;
    }
    return none;
  }

  void add(std::size_t hash, NodeId id) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    place({hash, id});
    ++count_;
  }

 private:
  struct Slot {
    std::size_t hash{};
    NodeId id{none};
  };
  static constexpr std::size_t first_size = 64;

  [[nodiscard]] std::size_t start(std::size_t hash) const {
    constexpr std::uint64_t spread = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
    return static_cast<std::size_t>((hash * spread) >> shift_);
  }
  [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 == slots_.size() ? 0 : i + 1; }

  void place(const Slot& slot) {
    std::size_t i = start(slot.hash);
    while (slots_[i].id != none) i = next(i);
    slots_[i] = slot;
  }

  void grow() {
    std::vector<Slot> old(slots_.empty() ? first_size : 2 * slots_.size());
    old.swap(slots_);
    for (shift_ = 64; (slots_.size() >> (64 - shift_)) > 1;) --shift_;
    for (const Slot& slot : old) {
      if (slot.id != none) place(slot);
    }
  }

  std::vector<Slot> slots_;  ///< a power of 2
  std::size_t count_{};
  unsigned shift_{64};  ///< leaves as many bits of a spread hash as the number of slots has
};

}  // namespace qdot
