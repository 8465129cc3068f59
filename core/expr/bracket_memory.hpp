#pragma once
// What was made of brackets before (core/expr/factored_form.hpp): the expressions of a scene, from its
// energies to the rows of its mass matrix, have most of theirs in common.

#include <optional>
#include <unordered_map>

#include "core/expr/monomial.hpp"

namespace qdot {

class BracketMemory {
 public:
  /// A bracket, and in how many levels of it alternatives are compared.
  struct Bracket {
    int levels;
    Polynomial polynomial;
  };
  /// What lookups need of a bracket: its own polynomial is not copied, and hashed once.
  struct Key {
    int levels;
    const Polynomial& polynomial;
    std::size_t hash;
  };
  [[nodiscard]] static Key key(int levels, const Polynomial& polynomial);
  [[nodiscard]] std::optional<NodeId> form_of(const Key& key) const;
  void keep(const Key& key, NodeId form);

 private:
  struct Kept {
    Bracket bracket;
    NodeId form;
  };
  std::unordered_multimap<std::size_t, Kept> kept_;
};

}  // namespace qdot
