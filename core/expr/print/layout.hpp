#pragma once
// What all printers share: the order of terms and factors, and what stands above and below a fraction bar.

#include <compare>
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/expr/expression.hpp"
#include "core/expr/print/notation.hpp"

namespace qdot {

/// base^exponent, exponent > 0.
struct WrittenPower {
  NodeId base{0};
  Number exponent{1};
};

/// A term as it is written: sign, then over/under * above/below. `over` and `under` are positive; `under` is
/// an integer, and so is `over` unless it is to be written as a decimal.
struct WrittenTerm {
  bool negative{false};
  Number over{1};
  Number under{1};
  std::vector<WrittenPower> above;
  std::vector<WrittenPower> below;
};

/// u^n, whose exponent is no number, n without its sign.
struct RaisedCall {
  NodeId base;
  WrittenTerm exponent;
};

/// The order in which an expression and everything below it is written.
class Layout {
 public:
  Layout(const Expression& e, const Notation& notation);

  [[nodiscard]] const Graph& graph() const { return graph_; }
  /// The terms of a sum in order.
  [[nodiscard]] const std::vector<NodeId>& terms(NodeId sum) const { return traits_.at(sum).children; }
  /// Any node but a sum as one term.
  [[nodiscard]] WrittenTerm term(NodeId id) const;
  /// exp(n log u) as a power; none for other calls.
  [[nodiscard]] std::optional<RaisedCall> raised(const Call& call) const;
  /// Whether a base gets brackets as a factor or under an exponent: anything but a symbol, a call or a plain
  /// number.
  [[nodiscard]] bool is_compound(NodeId base) const;

 private:
  struct Traits {
    double acceleration{0};        ///< degree in the accelerations
    double velocity{0};            ///< degree in the velocities (of a sum: both of its first term)
    bool calls{false};             ///< whether a function occurs
    bool varies{false};            ///< whether a coordinate, velocity or acceleration occurs
    bool is_number{true};          ///< no symbol occurs
    Place place;                   ///< of a symbol
    std::vector<NodeId> children;  ///< of sums and products, in order
  };

  [[nodiscard]] Traits traits(NodeId id) const;
  [[nodiscard]] Traits sum_traits(const Sum& sum) const;
  [[nodiscard]] Traits product_traits(const Product& product) const;
  [[nodiscard]] Traits power_traits(const Power& power) const;
  [[nodiscard]] std::vector<NodeId> factors(NodeId id) const;
  [[nodiscard]] std::weak_ordering compare_terms(NodeId a, NodeId b) const;
  [[nodiscard]] std::weak_ordering compare_factors(NodeId a, NodeId b) const;
  [[nodiscard]] std::weak_ordering compare_bases(NodeId a, NodeId b) const;
  [[nodiscard]] int rank(NodeId base) const;
  [[nodiscard]] bool is_negative(NodeId term) const;

  const Graph& graph_;
  const Notation& notation_;
  std::unordered_map<NodeId, Traits> traits_;
};

/// Whether f^n(x) is a usual way to write f(x)^n: sin^2(x).
[[nodiscard]] bool takes_inner_exponent(Function function);

/// Whether an argument may stand without brackets, sin x: a symbol, and no factor in brackets follows.
[[nodiscard]] bool is_bare(const Layout& layout, NodeId argument, bool bracket_follows);

/// The bound on a printed form: sharing in the graph may stand for an exponentially long formula.
inline constexpr std::size_t longest_print = std::size_t{1} << 20;

/// `written`, unless it passes longest_print; then throws Error(too_large).
[[nodiscard]] std::string bounded(std::string written);

/// Whether a number >= 0 is better written as a decimal: 981/100 as 9.81, but 3/4 and 53/6 as they are.
[[nodiscard]] bool prefers_decimal(const Number& value);

/// A number >= 0 that is an integer or has finitely many decimals, exactly: 12, 0.0125, 6.02e+23.
[[nodiscard]] std::string decimal_text(const Number& value);

/// An integer >= 0 with all its digits.
[[nodiscard]] std::string integer_text(const Number& value);

/// Whether decimal_text has a power of ten.
[[nodiscard]] bool is_scientific(const Number& value);

}  // namespace qdot
