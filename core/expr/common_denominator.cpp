#include "core/expr/common_denominator.hpp"

#include <algorithm>
#include <set>

namespace qdot {
namespace {

constexpr std::size_t most_terms = 6;
constexpr int most_powers = 3;

/// The power p/q of a bracket in a monomial, 0/q where it has none.
Atom power_of(const Monomial& monomial, NodeId bracket, int q) {
  const auto found = std::ranges::find(monomial, bracket, &Atom::base);
  return found == monomial.end() ? Atom{bracket, 0, q} : *found;
}

/// Sums that stand below or under a root, each with the denominator of its exponent.
std::set<std::pair<NodeId, int>> brackets(const Graph& graph, const Polynomial& polynomial) {
  std::set<std::pair<NodeId, int>> found;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      const bool is_multiplied_out = atom.q == 1 && atom.p > 0;
      if (!is_multiplied_out && std::holds_alternative<Sum>(graph.node(atom.base)))
        found.emplace(atom.base, atom.q);
    }
  }
  return found;
}

class OverBracket {
 public:
  OverBracket(Graph& graph, NodeId bracket, int q)
      : bracket_(bracket), q_(q), opened_(multiplied_out(Expression(graph, bracket))) {}

  std::optional<Polynomial> of(const Polynomial& polynomial) const {
    if (opened_.size() > most_terms) return std::nullopt;
    int lowest = most_powers * q_, highest = -lowest;
    for (const auto& [monomial, coefficient] : polynomial) {
      const Atom power = power_of(monomial, bracket_, q_);
      if (!is_alike(power)) continue;
      lowest = std::min(lowest, power.p);
      highest = std::max(highest, power.p);
    }
    if (highest < lowest || highest - lowest > most_powers * q_) return std::nullopt;
    Polynomial above, rest;
    for (const auto& [monomial, coefficient] : polynomial) {
      const Atom power = power_of(monomial, bracket_, q_);
      if (!is_alike(power) || (power.p - lowest) % q_ != 0) {
        add(rest, monomial, coefficient);
        continue;
      }
      Polynomial term{{times(monomial, bracket_, -power.p, power.q), coefficient}};
      for (int k = lowest; k < power.p; k += q_) term = term * opened_;
      add(above, term);
    }
    for (auto less = exact_quotient(above, opened_); less && !above.empty();
         less = exact_quotient(above, opened_)) {
      above = *std::move(less);
      lowest += q_;
    }
    add(rest, scaled(above, times({}, bracket_, lowest, q_), Number(1)));
    return rest.size() <= polynomial.size() ? std::optional(std::move(rest)) : std::nullopt;
  }

 private:
  /// A whole power belongs to whole ones, a half to halves; whole ones above are multiplied out already.
  [[nodiscard]] bool is_alike(const Atom& power) const { return power.q == q_ && (q_ > 1 || power.p <= 0); }

  NodeId bracket_;
  int q_;
  Polynomial opened_;
};

}  // namespace

std::vector<Polynomial> over_common_denominators(Graph& graph, const Polynomial& polynomial) {
  std::vector<Polynomial> found;
  for (const auto& [bracket, q] : brackets(graph, polynomial)) {
    if (auto together = OverBracket(graph, bracket, q).of(polynomial)) found.push_back(*std::move(together));
  }
  return found;
}

}  // namespace qdot
