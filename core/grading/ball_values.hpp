#pragma once
// Expressions evaluated in balls (core/numerics/ball.hpp), with what a value near 0 is worth as evidence.
//
// That a difference vanishes at a place says something only if each part of it was large enough to be seen
// there: 1e-40 x beside 1, or 1 - tanh(50), cannot be told from 0 by any place where they are small.

#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/expr/expression.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {

class BallValues {
 public:
  explicit BallValues(std::span<const Expression> roots);

  /// Sets a symbol; one that is not set has no value.
  void set(const Expression& symbol, const Ball& value);
  void evaluate();

  [[nodiscard]] const Ball& of(const Expression& e) const { return values_[index_.at(e.id())]; }
  /// Whether e vanishes here as far as can be seen: by cancellation to 1e-20 of what cancels.
  [[nodiscard]] bool vanishes(const Expression& e) const { return vanishes(e.id()); }
  /// Whether every part could be seen.
  [[nodiscard]] bool is_evidence() const { return is_evidence_; }

  /// Arguments of abs and sign.
  [[nodiscard]] const std::vector<Expression>& kinks() const { return kinks_; }

 private:
  [[nodiscard]] const Ball& at(NodeId id) const { return values_[index_.at(id)]; }
  [[nodiscard]] Ball value_of(NodeId id);
  [[nodiscard]] Ball sum_of(const Sum& sum);
  [[nodiscard]] Ball power_of(const Power& power);
  [[nodiscard]] Ball call_of(const Call& call);
  [[nodiscard]] bool vanishes(NodeId id) const;

  Graph* graph_;
  std::vector<NodeId> order_;
  std::unordered_map<NodeId, std::size_t> index_;
  std::vector<Ball> values_;
  std::vector<Expression> kinks_;
  bool is_evidence_{true};
};

}  // namespace qdot
