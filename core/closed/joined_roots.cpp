#include "core/closed/joined_roots.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "core/expr/polynomial.hpp"

namespace qdot {
namespace {

class Powers {
 public:
  Powers(Graph& graph, const SignOf& sign) : graph_(graph), sign_(sign) {}

  /// Takes e^exponent in; false where a root of what may be negative would be taken apart.
  [[nodiscard]] bool take(const Expression& e, const Number& exponent) {
    const auto [base, power] = split_power(e);
    const Number total = power * exponent;
    if (!(e == base)) {
      has_roots_ = has_roots_ || !power.is_integer();
      if (is_one_thing(base) && exponent.is_integer()) return add(base, total);  // it has a root as it is
      return (power.is_integer() && exponent.is_integer()) || is_positive(base) ? take(base, total) : false;
    }
    if (const Number* number = base.number()) return take_number(*number, total);
    const auto* product = std::get_if<Product>(&base.node());
    if (product == nullptr) {
      add(base, total);
      return exponent.is_integer() || is_positive(base);
    }
    const Product parts = *product;
    if (!parts.coefficient.is_one() && !take(graph_.number(parts.coefficient), total)) return false;
    return std::ranges::all_of(parts.factors, [&](NodeId id) { return take({graph_, id}, total); });
  }

  [[nodiscard]] bool has_roots() const { return has_roots_; }

  [[nodiscard]] Expression joined() const {
    Expression result = graph_.number(1);
    std::map<std::int64_t, std::vector<std::pair<Expression, std::int64_t>>> roots;
    for (const auto& [id, exponent] : exponents_) {
      const Expression base(graph_, id);
      const auto small = exponent.small();
      if (!small || small->denominator == 1) {
        result = result * pow(base, exponent);
        continue;
      }
      const std::int64_t whole = small->numerator / small->denominator;
      result = result * pow(base, Number(whole));
      roots[small->denominator].emplace_back(base, small->numerator - whole * small->denominator);
    }
    for (const auto& [q, parts] : roots) result = result * root(q, parts);
    return result;
  }

 private:
  /// 1/4 as 2^-2, so that it joins what other roots hold of 2.
  [[nodiscard]] bool take_number(const Number& number, const Number& exponent) {
    const auto small = number.small();
    if (!small || small->numerator <= 0) return exponent.is_integer() && add(graph_.number(number), exponent);
    for (const auto& [whole, side] : {std::pair(small->numerator, 1), std::pair(small->denominator, -1)}) {
      const auto [root, power] = primitive_root(whole);
      if (root != 1) add(graph_.number(root), Number(side * power) * exponent);
    }
    return true;
  }

  /// whole = root^power with the largest power.
  static std::pair<std::int64_t, std::int64_t> primitive_root(std::int64_t whole) {
    constexpr std::int64_t most = 1'000'000;
    for (std::int64_t root = 2; whole <= most && root * root <= whole; ++root) {
      std::int64_t left = whole, power = 0;
      for (; left % root == 0; ++power) left /= root;
      if (left == 1) return {root, power};
      if (power > 0 && power < 2) break;
    }
    return {whole, 1};
  }

  bool add(const Expression& base, const Number& exponent) {
    Number& sum = exponents_[base.id()];
    sum = sum + exponent;
    return true;
  }

  static bool is_one_thing(const Expression& base) {
    return std::holds_alternative<Symbol>(base.node()) || std::holds_alternative<Sum>(base.node());
  }

  [[nodiscard]] bool is_positive(const Expression& e) const { return sign_(multiplied_out(e)) > 0; }

  [[nodiscard]] Expression root(std::int64_t q,
                                const std::vector<std::pair<Expression, std::int64_t>>& parts) const {
    std::int64_t common = 0;
    for (const auto& [base, p] : parts) common = std::gcd(common, p);
    if (parts.size() == 1) return pow(parts[0].first, Number::ratio(parts[0].second, q));
    const bool is_below = std::ranges::all_of(parts, [](const auto& part) { return part.second < 0; });
    if (is_below) common = -common;
    Expression inside = graph_.number(1);
    for (const auto& [base, p] : parts) inside = inside * pow(base, Number(p / common));
    return pow(inside, Number::ratio(common, q));
  }

  Graph& graph_;
  const SignOf& sign_;
  std::map<NodeId, Number> exponents_;
  bool has_roots_{};
};

struct RootsInProduct {
  std::size_t above{}, below{};
  [[nodiscard]] std::size_t all() const { return above + below; }
};

RootsInProduct roots_in_product(const Expression& e) {
  const auto* product = std::get_if<Product>(&e.node());
  const std::vector<NodeId> factors = product != nullptr ? product->factors : std::vector{e.id()};
  RootsInProduct found;
  for (const NodeId id : factors) {
    const Number exponent = split_power({e.graph(), id}).exponent;
    if (!exponent.is_integer()) ++(exponent.is_negative() ? found.below : found.above);
  }
  return found;
}

Expression joined_product(const Expression& e, const SignOf& sign) {
  Powers powers(e.graph(), sign);
  if (!powers.take(e, Number(1)) || !powers.has_roots()) return e;
  constexpr std::size_t one_operation = 2;  // spares too little: m*l^2*sqrt(g/l) is how one writes it
  const Expression result = powers.joined();
  const RootsInProduct before = roots_in_product(e), after = roots_in_product(result);
  if (after.all() < before.all()) return written_length(result) <= written_length(e) ? result : e;
  const std::size_t spared = after.below < before.below ? 0 : one_operation;
  return written_length(result) + spared < written_length(e) ? result : e;
}

}  // namespace

Expression with_joined_roots(const Expression& e, const SignOf& sign) {
  const auto* sum = std::get_if<Sum>(&e.node());
  if (sum == nullptr) return joined_product(e, sign);
  const std::vector<NodeId> terms = sum->terms;
  Expression result = e.graph().number(0);
  for (const NodeId id : terms) result = result + joined_product({e.graph(), id}, sign);
  return written_length(result) < written_length(e) ? result : e;
}

}  // namespace qdot
