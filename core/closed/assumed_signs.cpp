#include "core/closed/assumed_signs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/closed/far_numbers.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/rational_function.hpp"
#include "core/mechanics/notation.hpp"
#include "core/numerics/function.hpp"

namespace qdot {
namespace {

constexpr int far_places = 32;

bool is_number(const Polynomial& e) { return e.size() == 1 && e.begin()->first.empty(); }

/// 10*a and 17 as a and 1.7.
void take_bound(Graph& graph, Polynomial& side, Polynomial& bound) {
  if (side.size() != 1 || !is_number(bound)) return;
  const auto& [monomial, coefficient] = *side.begin();
  if (!std::holds_alternative<Symbol>(to_expression(graph, {{monomial, Number(1)}}).node())) return;
  bound = scaled(bound, {}, Number(1) / coefficient);
  side = {{monomial, Number(1)}};
}

std::string inequality(const ExactValues& values, const Expression& e) {
  Graph& graph = e.graph();
  Polynomial above, below;
  for (const auto& [monomial, coefficient] : multiplied_out(e)) {
    const bool is_below = coefficient.is_negative();
    add(is_below ? below : above, monomial, is_below ? -coefficient : coefficient);
  }
  const Notation notation = notation_of(values.model().scene);
  if (above.empty()) return print(-e, Form::text, notation) + " < 0";
  if (below.empty()) return print(e, Form::text, notation) + " > 0";
  const auto root = exact_root(above), root_below = exact_root(below);
  const auto is_positive = [&](const Polynomial& a) {
    return values.value(to_expression(graph, a)).value > 0;
  };
  if (root && root_below && is_positive(*root) && is_positive(*root_below)) {
    above = *root;
    below = *root_below;
  }
  const auto written = [&](const Polynomial& side) {
    return print(to_expression(graph, side), Form::text, notation);
  };
  take_bound(graph, above, below);
  take_bound(graph, below, above);
  return is_number(above) ? written(below) + " < " + written(above) : written(above) + " > " + written(below);
}

}  // namespace

AssumedSigns::AssumedSigns(const ExactValues& values, const Relations& relations,
                           std::vector<Expression> given)
    : values_(values),
      relations_(relations),
      given_(std::move(given)),
      angles_(angles_among(values.symbols())) {
  const auto take = [&](const Expression& symbol) {
    const double value = values.value(symbol).value;
    usual_[symbol.id()] = value;
    known_[symbol.id()] = value > 0 ? 1 : value < 0 ? -1 : 0;
  };
  std::ranges::for_each(values.symbols(), take);
  std::ranges::for_each(given_, take);
}

void AssumedSigns::leave_out(const Expression& symbol, const std::optional<Expression>& formula) {
  known_.erase(symbol.id());
  if (formula) formulas_.emplace_back(symbol, *formula);
}

void AssumedSigns::ask(const Expression& e) {
  const Real value = values_.value(e);
  const bool may_vanish = std::abs(value.value) <= value.error;  // h - V(c) at rest at c
  if (may_vanish || !value.is_finite() || sign_of(e) != 0 || !is_of_parameters(e)) return;
  if (const auto positive = positive_of(e, value.value > 0 ? 1 : -1)) take(*positive);
  if (also_) ask_parts(e);
}

/// Of a fraction both parts: their product has its sign where both have the other one, too.
void AssumedSigns::ask_parts(const Expression& e) {
  const RationalFunction f = rational_function(e);
  if (sign_of(f.above) != 0 || sign_of(f.below) != 0) return;
  for (const Polynomial* part : {&f.above, &f.below}) {
    const Expression own = to_expression(*values_.graph(), *part);
    const Real value = values_.value(own);
    if (!(std::abs(value.value) > value.error) || !is_of_parameters(own)) continue;
    if (const auto positive = positive_of(own, value.value > 0 ? 1 : -1)) take(*positive);
  }
}

void AssumedSigns::let_signs_go() {
  given_has_signs_ = false;
  for (const Expression& e : given_) {
    int& sign = known_[e.id()];
    const Expression positive = sign < 0 ? -e : e;
    const bool is_known = std::exchange(sign, 0) != 0;
    if (is_known) take(positive);
  }
}

void AssumedSigns::let_go(const std::vector<Expression>& symbols, const OtherPlace& also) {
  let_go_ = symbols;
  also_ = also;
  for (const Expression& e : symbols) {
    int& sign = known_[e.id()];
    const Expression positive = sign < 0 ? -e : e;
    const bool is_known = std::exchange(sign, 0) != 0;
    if (!is_known) continue;
    take(positive);
    take(pow(e, Number(2)));
  }
}

/// Places of which nothing is claimed count for little.
std::optional<std::vector<std::string>> AssumedSigns::separating(const Tried& tried, int tries,
                                                                 int other_tries) {
  constexpr int most_per_try = 3, rounds = 5, most_scarce = 6, per_scarce = 6;
  take_asked();
  std::minstd_rand random;
  Tries all(tried);
  int anywhere = 0, others = 0;
  for (int number = 0; number < most_per_try * std::max(tries, other_tries); ++number) {
    if (anywhere == tries && others == other_tries) break;
    const FarPlace place = far_place(number, random);
    if (anywhere < tries && all.add(place, place)) ++anywhere;
    const auto other = others < other_tries ? also_(place) : std::nullopt;
    if (other && all.add(*other, place)) ++others;
  }
  for (int round = 0; round < rounds; ++round) {
    for (const FarPlace& scarce : all.scarce(most_scarce)) {
      for (int i = 0; i < per_scarce; ++i) {
        const FarPlace near = place_near(scarce, 2 / ((1.0 + round) * (1.0 + round)), random);
        const auto other = other_tries > 0 ? also_(near) : std::optional(near);
        if (other) all.add(*other, near);
      }
    }
  }
  try_unbroken(all, other_tries > 0);
  Chosen chosen = that_tell(all);
  for (int round = 0; round < rounds && chosen; ++round) {
    if (!is_refuted(all, *chosen, other_tries > 0, random)) break;
    chosen = that_tell(all);
  }
  if (chosen && is_refuted_at_zeros(all, *chosen, other_tries > 0)) chosen = that_tell(all);
  if (!chosen) return std::nullopt;
  std::vector<std::string> needed;
  for (const std::size_t i : *chosen) needed.push_back(inequality(values_, open_[i].e));
  return needed;
}

bool AssumedSigns::is_broken(const Expression& positive, const FarPlace& place) {
  return !(rough_value(positive, place) > 0);
}

bool AssumedSigns::are_there() {
  take_asked();
  return std::ranges::any_of(
      open_, [](const Open& open) { return std::ranges::find(open.broken, true) != open.broken.end(); });
}

std::vector<std::string> AssumedSigns::needed_for(const Trial& trial) {
  return needed_for([&](const std::vector<RealAssignment>& place) { return trial.holds_at(place); });
}

std::vector<std::string> AssumedSigns::needed_for(const HoldsAt& holds_at) {
  std::vector<std::string> needed;
  for (const std::size_t i : numbers_needed_for(holds_at)) needed.push_back(inequality(values_, open_[i].e));
  return needed;
}

/// Places at which one condition alone is broken say most, so they are first.
std::vector<std::size_t> AssumedSigns::numbers_needed_for(const HoldsAt& holds_at) {
  take_asked();
  std::vector<std::pair<std::vector<std::size_t>, std::size_t>> tried;  // what is broken, and where
  for (std::size_t place = 0; place < far_.size(); ++place) {
    std::vector<std::size_t> broken;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (open_[i].broken[place]) broken.push_back(i);
    }
    if (!broken.empty()) tried.emplace_back(std::move(broken), place);
  }
  std::ranges::stable_sort(tried, {}, [](const auto& t) { return t.first.size(); });
  std::vector<bool> is_needed(open_.size());
  for (const auto& [broken, place] : tried) {
    const bool is_told = std::ranges::any_of(broken, [&](std::size_t i) { return is_needed[i]; });
    if (!is_told && !holds_at(far_[place])) is_needed[broken[0]] = true;
  }
  std::vector<std::size_t> needed;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (is_needed[i]) needed.push_back(i);
  }
  return with_needed_elsewhere(std::move(needed), holds_at);
}

void AssumedSigns::take_asked() {
  for (; asked_ < values_.asked().size(); ++asked_) {
    const auto [asked, sign] = values_.asked()[asked_];
    const Expression e = formulas_.empty() ? asked : substitute(asked, formulas_);
    if (sign == 0 || !seen_.emplace(e.id(), sign).second || sign_of(e) != 0 || !is_of_parameters(e)) continue;
    if (const auto positive = positive_of(e, sign)) take(*positive);
  }
}

void AssumedSigns::take(const Expression& positive) {
  constexpr std::size_t longest_told = 40;
  if (also_ && written_length(positive) > longest_told) return;
  if (std::ranges::find(open_, positive, &Open::e) != open_.end()) return;
  if (far_.empty() && !also_) find_far_places();
  Open open{positive, {}};
  for (const FarPlace& place : far_) open.broken.push_back(is_broken(positive, place));
  const auto is_longer = [&](const Open& other) {
    return written_length(other.e) > written_length(positive);
  };
  open_.insert(std::ranges::find_if(open_, is_longer), std::move(open));
}

void AssumedSigns::find_far_places() {
  std::minstd_rand random;
  for (int number = 0; number < far_places; ++number) far_.push_back(far_place(number, random));
}

/// Exponents keep the values with which the formulas were derived.
FarPlace AssumedSigns::far_place(int number, std::minstd_rand& random) const {
  FarPlace place;
  for (std::size_t i = 0; i < values_.symbols().size(); ++i) {
    const Parameter& p = values_.model().scene.parameters[i];
    const double far = far_number(values_.symbols()[i], p.domain, number, random);
    const bool is_exponent = values_.model().parsed.exponents.put_in.contains(p.name);
    place.emplace_back(values_.symbols()[i], is_exponent ? values_.parameters()[i] : far);
  }
  for (const Expression& e : given_) {
    const double far = far_number(e, {}, number, random);
    place.emplace_back(e, !given_has_signs_ && random() % 2 == 0 ? -far : far);
  }
  relate(place);
  return place;
}

void AssumedSigns::relate(FarPlace& place) const {
  for (const auto& [symbol, value] : relations_.replacements)
    std::ranges::find(place, symbol, &RealAssignment::first)->second = evaluate_exactly(value, place);
}

/// Some parameters become up to 1 + reach times as large, or as small; signs and exponents stay.
FarPlace AssumedSigns::place_near(FarPlace place, double reach, std::minstd_rand& random) const {
  for (std::size_t i = 0; i < values_.symbols().size(); ++i) {
    const Parameter& p = values_.model().scene.parameters[i];
    const double x = scaled_value(place[i].second.value, 1 + reach, p.domain, random);
    const bool is_exponent = values_.model().parsed.exponents.put_in.contains(p.name);
    if (random() % 2 == 0 && !is_exponent) place[i].second = x;
  }
  relate(place);
  return place;
}

/// Where signs are let go: of any size, of that of the value, and near it. Angles go beyond a turn, too.
double AssumedSigns::far_number(const Expression& symbol, const Domain& domain, int number,
                                std::minstd_rand& random) const {
  const double value = usual_.at(symbol.id());
  const int kind = also_ ? number % 3 : 0;
  const bool is_angle = std::ranges::find(angles_, symbol) != angles_.end();
  const double x = is_angle && kind < 2 && random() % 2 == 0 ? far_angle(value, domain, random)
                   : kind == 0                               ? far_value(value, domain, random)
                   : kind == 1                               ? scaled_value(value, 12, domain, random)
                                                             : scaled_value(value, 1.6, domain, random);
  const bool turns = also_ && random() % 3 == 0 && domain.contains(-x);  // the same places for all formulas
  return turns && std::ranges::find(let_go_, symbol) != let_go_.end() ? -x : x;
}

/// Whether it speaks of nothing but the known symbols and small numbers: places near which something was
/// looked for are long ones.
bool AssumedSigns::is_of_parameters(const Expression& e) const {
  constexpr std::size_t most_bits = 32;
  const NodeId root = e.id();
  return std::ranges::all_of(reachable(e.graph(), {&root, 1}), [&](NodeId id) {
    const Node& node = e.graph().node(id);
    if (const auto* symbol = std::get_if<Symbol>(&node)) return symbol->name == "pi" || known_.contains(id);
    const auto* literal = std::get_if<Literal>(&node);
    return literal == nullptr || literal->value.bits() <= most_bits;
  });
}

/// An expression that is positive as long as e has its sign; none where that is always so.
std::optional<Expression> AssumedSigns::positive_of(const Expression& e, int sign) const {
  const RationalFunction f = rational_function(e);
  Polynomial product{{Monomial{}, Number(sign)}};
  for (const Polynomial* part : {&f.above, &f.below}) {
    const int decided = sign_of(*part);
    product = decided == 0 ? product * *part : scaled(product, {}, Number(decided));
  }
  const bool is_decided = product.empty() || sign_of(product) != 0;
  return is_decided ? std::nullopt : std::optional(short_form(product));
}

namespace {

/// Of two terms of a sum, or 0.
int common_sign(int a, int b) { return a == b ? a : 0; }

}  // namespace

/// 0 where the symbols' signs leave it open. Roots are taken to have values.
int AssumedSigns::sign_of(const Expression& e) const {
  Graph& graph = *values_.graph();
  const auto of = [&](NodeId id) { return sign_of(Expression(graph, id)); };
  const Node& node = e.node();
  if (const auto* literal = std::get_if<Literal>(&node)) return literal->value.sign();
  if (const auto* symbol = std::get_if<Symbol>(&node)) {
    if (symbol->name == "pi") return 1;
    const auto known = known_.find(e.id());
    return known == known_.end() ? 0 : known->second;
  }
  if (const auto* sum = std::get_if<Sum>(&node)) {
    int sign = of(sum->terms[0]);
    for (const NodeId id : sum->terms) sign = sign == 0 ? 0 : common_sign(sign, of(id));
    return sign;
  }
  if (const auto* product = std::get_if<Product>(&node)) {
    int sign = product->coefficient.sign();
    for (const NodeId id : product->factors) sign = sign == 0 ? 0 : sign * of(id);
    return sign;
  }
  if (const auto* power = std::get_if<Power>(&node)) {
    const auto exponent = power->exponent.small();
    const bool is_odd = exponent && exponent->denominator % 2 != 0 && exponent->numerator % 2 != 0;
    if (is_odd) return of(power->base);
    return std::ranges::find(let_go_, power->base, &Expression::id) == let_go_.end() ? 1 : 0;
  }
  const Function function = std::get<Call>(node).function;
  return function == Function::exp || function == Function::cosh ? 1 : 0;
}

int AssumedSigns::sign_of(const Polynomial& e) const {
  int sign = 0;
  for (const auto& [monomial, coefficient] : e) {
    const int term = coefficient.sign() * sign_of(to_expression(*values_.graph(), monomial));
    if (term == 0 || (sign != 0 && term != sign)) return 0;
    sign = term;
  }
  return sign;
}

/// Without numbers and factors that are positive anyway.
Expression AssumedSigns::short_form(const Polynomial& e) const {
  Graph& graph = *values_.graph();
  Monomial front;
  Number number = content(e);
  for (const Atom& atom : common_monomial(e)) {
    const int sign = sign_of(pow(Expression(graph, atom.base), Number::ratio(atom.p, atom.q)));
    if (sign == 0) continue;
    front = times(front, atom.base, -atom.p, atom.q);
    number = Number(sign) * number;
  }
  return to_expression(graph, scaled(e, front, Number(1) / number));
}

}  // namespace qdot
