#pragma once
// What expressions are worth at a place that is drawn at random, as residues (residue.hpp).
//
// Every symbol is drawn. So are the functions, which no rational function of their arguments is: the sine and
// cosine of an angle are a point of the circle, and those of sums follow from their terms by the addition
// theorems; exp likewise; log and the inverse functions are drawn for each argument; |u| = s u and
// sign u = s for a drawn s = +-1. Square roots are roots; other roots are drawn.
// So relations between expressions hold at the place, all but rare ones between roots, and others hold there
// by a chance of some 2^-61.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/expr/polynomial.hpp"
#include "core/symmetry/residue.hpp"

namespace qdot {

/// Expressions, and what is needed to evaluate them at every place.
class PlaceEvaluator {
 public:
  /// Symbols among `kept`, and functions of them alone, are drawn once by keep(), all others for each place.
  /// Throws Error(too_large) for an argument that is too long when it is multiplied out.
  PlaceEvaluator(Graph& graph, std::span<const Expression> expressions, std::span<const Expression> kept);

  void keep(std::uint64_t seed) { kept_seed_ = seed; }
  /// The expressions at a place; none where one of them has no value there.
  [[nodiscard]] std::optional<std::vector<Residue>> values(std::uint64_t seed);
  /// How many operations a place takes.
  [[nodiscard]] std::size_t size() const { return order_.size(); }

 private:
  /// A monomial that stands in arguments, with rational factors: whole multiples of 1/finest of it.
  struct Unit {
    std::int64_t finest{1};
    bool is_kept{};
  };
  struct Part {
    std::size_t unit;
    Fraction factor;
  };
  struct Circle {
    Residue cosine, sine;
  };
  void read_argument(NodeId argument);
  [[nodiscard]] bool is_kept(const Monomial& monomial) const;
  [[nodiscard]] std::uint64_t drawn(std::uint64_t what, bool is_kept) const;
  [[nodiscard]] int multiple(const Part& part) const;
  [[nodiscard]] std::optional<Residue> value(NodeId id) const;
  [[nodiscard]] std::optional<Residue> value_of(const Power& node, NodeId id) const;
  [[nodiscard]] std::optional<Residue> value_of(const Call& call) const;
  [[nodiscard]] std::optional<Circle> circle(NodeId argument) const;
  [[nodiscard]] std::optional<Residue> growth(NodeId argument) const;

  Graph& graph_;
  std::vector<NodeId> roots_, order_;
  std::vector<bool> kept_;  ///< by node
  std::map<Monomial, std::size_t, LeadingFirst> numbers_;
  std::vector<Unit> units_;
  std::map<NodeId, std::vector<Part>> arguments_;
  std::vector<Residue> values_;  ///< by node
  std::uint64_t kept_seed_{}, seed_{};
};

}  // namespace qdot
