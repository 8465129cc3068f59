#include "core/expr/exact_number.hpp"

#include <map>

#include "core/base/error.hpp"

namespace qdot {
namespace {

constexpr std::int64_t largest_power = 64;

class ExactNumber {
 public:
  using Found = std::optional<Number>;

  ExactNumber(Graph& graph, const std::function<Found(const Expression&)>& of_symbol)
      : graph_(graph), of_symbol_(of_symbol) {}

  Found operator()(NodeId root) {
    const NodeId roots[]{root};
    for (const NodeId id : reachable(graph_, roots)) {
      const Found found = std::visit([&](const auto& x) { return of(x, id); }, graph_.node(id));
      if (!found) return std::nullopt;
      done_[id] = *found;
    }
    return done_.at(root);
  }

 private:
  Found of(const Literal& x, NodeId) const { return x.value; }
  Found of(const Symbol&, NodeId id) const { return of_symbol_({graph_, id}); }
  Found of(const Call&, NodeId) const { return std::nullopt; }
  Found of(const Sum& x, NodeId) const {
    Number sum = 0;
    for (const NodeId id : x.terms) sum = sum + done_.at(id);
    return sum;
  }
  Found of(const Product& x, NodeId) const {
    Number product = x.coefficient;
    for (const NodeId id : x.factors) product = product * done_.at(id);
    return product;
  }
  Found of(const Power& x, NodeId) const {
    const auto exponent = x.exponent.whole(largest_power);
    const Number& base = done_.at(x.base);
    if (!exponent || (base.is_zero() && *exponent < 0)) return std::nullopt;
    return power(base, static_cast<int>(*exponent));
  }

  Graph& graph_;
  const std::function<Found(const Expression&)>& of_symbol_;
  std::map<NodeId, Number> done_;
};

}  // namespace

std::optional<Number> exact_number(
    const Expression& e, const std::function<std::optional<Number>(const Expression& symbol)>& of_symbol) {
  try {
    return ExactNumber(e.graph(), of_symbol)(e.id());
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return std::nullopt;
  }
}

}  // namespace qdot
