#include "core/grading/vanishing.hpp"

#include <algorithm>
#include <array>

#include "core/expr/polynomial.hpp"
#include "core/expr/zeroness.hpp"

namespace qdot {
namespace {

constexpr int enough = 12;  // states at which everything was seen
constexpr int enough_of_rounded = 40;
constexpr int most_tries = 80;  // with those that say nothing
constexpr int most_tries_where_one_exists = 1000;

/// Whether e cannot be negative, as its form shows.
bool is_never_negative(const Expression& e, std::span<const SymbolDomain> symbols) {
  Graph& graph = e.graph();
  const auto never = [&](NodeId id) { return is_never_negative({graph, id}, symbols); };
  return std::visit(
      overloaded{[](const Literal& x) { return !x.value.is_negative(); },
                 [&](const Symbol& x) {
                   const auto known = std::ranges::find(symbols, e, &SymbolDomain::symbol);
                   return x.name == "pi" || (known != symbols.end() && known->domain.lower >= 0);
                 },
                 [&](const Sum& x) { return std::ranges::all_of(x.terms, never); },
                 [&](const Product& x) {
                   return !x.coefficient.is_negative() && std::ranges::all_of(x.factors, never);
                 },
                 [&](const Power& x) {
                   const auto whole = x.exponent.whole(1000);
                   return never(x.base) || !x.exponent.is_integer() || (whole && *whole % 2 == 0);
                 },
                 [&](const Call& x) {
                   return x.function == Function::exp || x.function == Function::cosh ||
                          x.function == Function::abs;
                 }},
      e.node());
}

class Vanishing {
 public:
  explicit Vanishing(const VanishingQuestion& question)
      : question_(question), values_(std::array{question.value}) {
    for (const Expression& kink : values_.kinks()) {
      const bool is_open =
          !is_never_negative(kink, question.symbols) && !is_never_negative(-kink, question.symbols);
      sides_.push_back({!is_open, !is_open});
    }
  }

  VanishingAnswer answer() {
    if (question_.value.is_zero()) return {Decision::identity, {}};
    SampledStates states(question_.symbols, question_.seed);
    int seen = 0;
    const int wanted = question_.tolerance > 0 ? enough_of_rounded : enough;
    for (int i = 0; i < most_tries && seen < wanted; ++i) {
      State state = states.next();
      const Sight sight = look(state);
      if (sight == Sight::not_zero) return {Decision::counterexample, state};
      if (sight == Sight::zero) ++seen;
    }
    if (is_rounded_) return {seen == wanted ? Decision::rounded : Decision::unknown, {}};
    return by_algebra(seen, states);
  }

 private:
  enum class Sight { zero, not_zero, nothing };

  Sight look(State& state) {
    for (std::size_t i = 0; i < state.size(); ++i) values_.set(question_.symbols[i].symbol, state[i]);
    if (question_.complete && !question_.complete(state, values_)) return Sight::nothing;
    values_.evaluate();
    const Ball& value = values_.of(question_.value);
    if (!value.is_finite()) return Sight::nothing;
    if (!value.contains_zero()) {
      if (!is_tolerable(value, state)) return Sight::not_zero;
      is_rounded_ = true;
      return values_.is_evidence() ? Sight::zero : Sight::nothing;
    }
    if (!values_.is_evidence() || !values_.vanishes(question_.value)) return Sight::nothing;
    note_sides();
    return Sight::zero;
  }

  [[nodiscard]] bool is_tolerable(const Ball& value, const State& state) const {
    return question_.tolerance > 0 && value.magnitude() <= question_.tolerance * question_.size(state);
  }

  void note_sides() {
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const Ball& argument = values_.of(values_.kinks()[i]);
      if (argument.contains_zero()) continue;
      (argument.middle.high > 0 ? sides_[i].above : sides_[i].below) = true;
    }
  }

  VanishingAnswer by_algebra(int seen, SampledStates& states) {
    const auto form = question_.in_symbols ? question_.in_symbols() : std::optional(question_.value);
    const Zeroness found = form ? zeroness(*form) : Zeroness::unknown;
    if (found == Zeroness::zero) return {Decision::identity, {}};
    if (found == Zeroness::not_zero) return search(*form, states);
    const bool saw_both_sides =
        std::ranges::all_of(sides_, [](const Sides& s) { return s.above && s.below; });
    return {seen >= enough && saw_both_sides ? Decision::values : Decision::unknown, {}};
  }

  /// It is not zero everywhere, so somewhere it can be seen not to be; multiplied out, so that what cancels
  /// is gone and does not hide what is left.
  VanishingAnswer search(const Expression& form, SampledStates& states) {
    const Expression left = expand(form);
    BallValues values(std::array{left});
    for (int i = 0; i < most_tries_where_one_exists; ++i) {
      const State state = states.next();
      for (std::size_t k = 0; k < state.size(); ++k) values.set(question_.symbols[k].symbol, state[k]);
      values.evaluate();
      const Ball& value = values.of(left);
      if (value.is_finite() && !value.contains_zero()) return {Decision::counterexample, state};
    }
    return {};
  }

  struct Sides {
    bool above{}, below{};
  };

  const VanishingQuestion& question_;
  BallValues values_;
  std::vector<Sides> sides_;
  bool is_rounded_{};
};

}  // namespace

VanishingAnswer vanishing(const VanishingQuestion& question) { return Vanishing(question).answer(); }

}  // namespace qdot
