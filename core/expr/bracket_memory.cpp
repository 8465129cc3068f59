#include "core/expr/bracket_memory.hpp"

namespace qdot {
namespace {

std::size_t stirred(std::size_t seed, std::size_t value) {
  return (seed ^ value) * 0x9e3779b97f4a7c15ULL + (seed >> 29U);
}

}  // namespace

BracketMemory::Key BracketMemory::key(int levels, const Polynomial& polynomial) {
  std::size_t hash = static_cast<std::size_t>(levels);
  for (const auto& [monomial, coefficient] : polynomial) {
    hash = stirred(hash, coefficient.hash());
    for (const Atom& atom : monomial) {
      hash = stirred(hash, atom.base);
      hash = stirred(hash, static_cast<std::size_t>(atom.p) * 64U + static_cast<std::size_t>(atom.q));
    }
  }
  return {levels, polynomial, hash};
}

std::optional<NodeId> BracketMemory::form_of(const Key& key) const {
  const auto [first, last] = kept_.equal_range(key.hash);
  for (auto it = first; it != last; ++it) {
    const Bracket& bracket = it->second.bracket;
    if (bracket.levels == key.levels && bracket.polynomial == key.polynomial) return it->second.form;
  }
  return std::nullopt;
}

void BracketMemory::keep(const Key& key, NodeId form) {
  kept_.emplace(key.hash, Kept{{key.levels, key.polynomial}, form});
}

}  // namespace qdot
