#include "core/symmetry/random_place.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/error.hpp"

namespace qdot {
namespace {

/// Steele, Lea, Flood, Fast splittable pseudorandom number generators (2014).
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

Residue real_residue(std::uint64_t bits) { return {Modular(bits), {}}; }
const Residue one{Modular(1), {}};

std::optional<Residue> quotient(Residue a, Residue b) {
  if (b.is_zero()) return std::nullopt;
  return a * inverse(b);
}

/// Functions whose values follow from those of the terms of their arguments.
bool adds_up(Function function) {
  switch (function) {
    case Function::sin:
    case Function::cos:
    case Function::tan:
    case Function::sinh:
    case Function::cosh:
    case Function::tanh:
    case Function::exp:
      return true;
    case Function::asin:
    case Function::acos:
    case Function::atan:
    case Function::log:
    case Function::abs:
    case Function::sign:
      return false;
  }
  return false;
}

// What a draw is for, so that no two share their bits; the numbers of nodes and units are below 2^32.
constexpr std::uint64_t for_symbol = 1, for_root = 2, for_side = 3, for_function = 4, for_circle = 20,
                        for_growth = 21;
constexpr std::uint64_t draw(std::uint64_t purpose, std::uint64_t number) {
  return (purpose << 32U) + number;
}

constexpr int largest_multiple = 1 << 20;

}  // namespace

PlaceEvaluator::PlaceEvaluator(Graph& graph, std::span<const Expression> expressions,
                               std::span<const Expression> kept)
    : graph_(graph), kept_(graph.size()) {
  for (const Expression& e : expressions) roots_.push_back(e.id());
  order_ = reachable(graph, roots_);
  for (const NodeId id : order_) {
    const std::span<const NodeId> below = children(graph.node(id));
    const bool is_symbol = std::holds_alternative<Symbol>(graph.node(id));
    kept_[id] = is_symbol ? std::ranges::any_of(kept, [&](const Expression& e) { return e.id() == id; })
                          : std::ranges::all_of(below, [&](NodeId child) { return kept_[child]; });
  }
  values_.resize(kept_.size());
  for (const NodeId id : order_) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call != nullptr && adds_up(call->function)) read_argument(call->argument);
  }
}

void PlaceEvaluator::read_argument(NodeId argument) {
  if (arguments_.contains(argument)) return;
  std::vector<Part>& parts = arguments_[argument];
  for (const auto& [monomial, coefficient] : multiplied_out({graph_, argument})) {
    const auto [place, is_new] = numbers_.emplace(monomial, units_.size());
    if (is_new) units_.push_back({1, is_kept(monomial)});
    const auto factor = coefficient.small();
    if (!factor || factor->denominator > largest_multiple)
      throw Error(ErrorCode::too_large, "A factor in an argument has too many digits.");
    Unit& unit = units_[place->second];
    unit.finest = std::lcm(unit.finest, factor->denominator);
    if (unit.finest > largest_multiple)
      throw Error(ErrorCode::too_large, "The factors in arguments have no small common denominator.");
    parts.push_back({place->second, *factor});
  }
}

/// Made of what is kept alone; multiplying out may have made nodes that are none of the order.
bool PlaceEvaluator::is_kept(const Monomial& monomial) const {
  return std::ranges::all_of(monomial,
                             [&](const Atom& atom) { return atom.base < kept_.size() && kept_[atom.base]; });
}

std::uint64_t PlaceEvaluator::drawn(std::uint64_t what, bool is_kept) const {
  return mixed(mixed(is_kept ? kept_seed_ : seed_) ^ mixed(what));
}

std::optional<std::vector<Residue>> PlaceEvaluator::values(std::uint64_t seed) {
  seed_ = seed;
  for (const NodeId id : order_) {
    const auto here = value(id);
    if (!here) return std::nullopt;
    values_[id] = *here;
  }
  std::vector<Residue> result;
  for (const NodeId id : roots_) result.push_back(values_[id]);
  return result;
}

std::optional<Residue> PlaceEvaluator::value(NodeId id) const {
  using Result = std::optional<Residue>;
  return std::visit(overloaded{[](const Literal& literal) -> Result {
                                 const auto residue = Modular::of(literal.value);
                                 return residue ? Result(Residue{*residue, {}}) : std::nullopt;
                               },
                               [&](const Symbol&) -> Result {
                                 return real_residue(drawn(draw(for_symbol, id), kept_[id]));
                               },
                               [&](const Sum& sum) -> Result {
                                 Residue total;
                                 for (const NodeId term : sum.terms) total = total + values_[term];
                                 return total;
                               },
                               [&](const Product& product) -> Result {
                                 const auto coefficient = Modular::of(product.coefficient);
                                 if (!coefficient) return std::nullopt;
                                 Residue result{*coefficient, {}};
                                 for (const NodeId factor : product.factors)
                                   result = result * values_[factor];
                                 return result;
                               },
                               [&](const Power& node) -> Result { return value_of(node, id); },
                               [&](const Call& call) -> Result { return value_of(call); }},
                    graph_.node(id));
}

std::optional<Residue> PlaceEvaluator::value_of(const Power& node, NodeId id) const {
  const auto exponent = node.exponent.small();
  if (!exponent || std::abs(exponent->numerator) > largest_multiple) return std::nullopt;
  const int whole = static_cast<int>(exponent->numerator);
  if (exponent->denominator == 1) return power(values_[node.base], whole);
  if (exponent->denominator == 2) {
    const auto root = square_root(values_[node.base]);
    return root ? power(*root, whole) : std::nullopt;
  }
  const std::uint64_t what =
      draw(for_root, node.base) + static_cast<std::uint64_t>(exponent->denominator << 40U);
  return power(real_residue(drawn(what, kept_[id])), whole);
}

std::optional<Residue> PlaceEvaluator::value_of(const Call& call) const {
  const bool is_kept = kept_[call.argument];
  switch (call.function) {
    case Function::sin:
    case Function::cos:
    case Function::tan: {
      const auto point = circle(call.argument);
      if (!point) return std::nullopt;
      if (call.function == Function::tan) return quotient(point->sine, point->cosine);
      return call.function == Function::sin ? point->sine : point->cosine;
    }
    case Function::exp:
      return growth(call.argument);
    case Function::sinh:
    case Function::cosh:
    case Function::tanh: {
      const auto up = growth(call.argument);
      if (!up || up->is_zero()) return std::nullopt;
      const Residue down = inverse(*up), half{inverse(Modular(2)), {}};
      if (call.function == Function::tanh) return quotient(*up - down, *up + down);
      return half * (call.function == Function::sinh ? *up - down : *up + down);
    }
    case Function::abs:
    case Function::sign: {
      const bool is_negative = drawn(draw(for_side, call.argument), is_kept) % 2 == 1;
      const Residue side = is_negative ? Residue{} - one : one;
      return call.function == Function::sign ? side : side * values_[call.argument];
    }
    case Function::asin:
    case Function::acos:
    case Function::atan:
    case Function::log:
      break;
  }
  const auto purpose = for_function + static_cast<std::uint64_t>(call.function);
  return real_residue(drawn(draw(purpose, call.argument), is_kept));
}

int PlaceEvaluator::multiple(const Part& part) const {
  const std::int64_t finest = units_[part.unit].finest;
  const std::int64_t times = part.factor.numerator * (finest / part.factor.denominator);
  return std::abs(times) <= largest_multiple ? static_cast<int>(times) : 0;
}

/// cos u + j sin u is the product of the terms' own; 2 s/(1 + s^2) and (1 - s^2)/(1 + s^2) are the circle.
std::optional<PlaceEvaluator::Circle> PlaceEvaluator::circle(NodeId argument) const {
  Circle total{one, {}};
  const auto turned = [](const Circle& a, const Circle& b) {
    return Circle{a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
  };
  for (const Part& part : arguments_.at(argument)) {
    const Residue s = real_residue(drawn(draw(for_circle, part.unit), units_[part.unit].is_kept));
    const auto scale = quotient(one, one + s * s);
    int times = multiple(part);
    if (!scale || times == 0) return std::nullopt;
    Circle power{(one - s * s) * *scale, (s + s) * *scale};
    if (times < 0) power.sine = Residue{} - power.sine;
    for (times = std::abs(times); times != 0; times /= 2) {
      if (times % 2 == 1) total = turned(total, power);
      power = turned(power, power);
    }
  }
  return total;
}

std::optional<Residue> PlaceEvaluator::growth(NodeId argument) const {
  Residue total = one;
  for (const Part& part : arguments_.at(argument)) {
    const Residue base = real_residue(drawn(draw(for_growth, part.unit), units_[part.unit].is_kept));
    const int times = multiple(part);
    const auto factor = power(base, times);
    if (!factor || times == 0) return std::nullopt;
    total = total * *factor;
  }
  return total;
}

}  // namespace qdot
