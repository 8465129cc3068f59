#include "core/grading/factored_equations.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/zeroness.hpp"
#include "core/grading/ball_system.hpp"
#include "core/grading/linear_in.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t work_on_factors = 100'000;
constexpr std::size_t most_choices = 64;
constexpr int states_of_choices = 12;

/// A factor that may vanish, linear in the accelerations.
struct Factor {
  Expression value;
  bool is_obeyed{};  ///< by the right motion
  std::vector<Expression> slopes{};
};

/// Bases with positive exponents; what stands below a bar does not vanish where the whole has a value.
std::vector<Expression> bases_of(const Expression& e) {
  std::vector<NodeId> factors{e.id()};
  if (const auto* product = std::get_if<Product>(&e.node())) factors = product->factors;
  std::vector<Expression> bases;
  for (const NodeId id : factors) {
    const auto* power = std::get_if<Power>(&e.graph().node(id));
    if (power == nullptr) {
      bases.emplace_back(e.graph(), id);
    } else if (!power->exponent.is_negative()) {
      for (const Expression& inner : bases_of({e.graph(), power->base})) bases.push_back(inner);
    }
  }
  return bases;
}

/// e divided by what it shares with all its slopes: without the squares of its factors.
Expression without_squares(const Expression& e, std::span<const Expression> accelerations) {
  try {
    const Polynomial whole = multiplied_out(numerator(e).value_or(e));
    Polynomial shared = whole;
    for (const Expression& a : accelerations) {
      const Polynomial slope = multiplied_out(differentiate(to_expression(e.graph(), whole), a));
      if (!slope.empty()) shared = greatest_common_divisor(shared, slope);
    }
    const auto quotient = exact_quotient(whole, shared);
    return quotient ? to_expression(e.graph(), *quotient) : e;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return e;
  }
}

/// A sum of an even power, or more of them, and a number above zero, such as 1 + x''^2.
bool is_above_zero(const Expression& e) {
  const auto* sum = std::get_if<Sum>(&e.node());
  if (sum == nullptr) return false;
  bool has_number = false;
  for (const NodeId id : sum->terms) {
    const auto [number, rest] = split_coefficient(Expression(e.graph(), id));
    if (number.is_negative()) return false;
    const auto* literal = std::get_if<Literal>(&rest.node());
    const auto* power = std::get_if<Power>(&rest.node());
    const auto whole = power != nullptr ? power->exponent.whole(1000) : std::nullopt;
    if (literal == nullptr && !(whole && *whole % 2 == 0)) return false;
    has_number = has_number || literal != nullptr;
  }
  return has_number;
}

class FactoredEquations {
 public:
  FactoredEquations(const ExpectedSystem& system, RightMotion& right, std::uint64_t seed)
      : accelerations_(system.unknowns()), right_(right), seed_(seed) {}

  /// Takes an equation apart; false where a factor is left that may vanish and is not linear.
  bool add(const Expression& residual) {
    std::vector<Factor> factors;
    for (const Expression& base : bases_of(residual)) {
      const bool is_free = !depends_on(base, accelerations_) || is_above_zero(base);
      if (is_free) continue;
      auto linear = made_linear_in(base, accelerations_);
      if (!linear) linear = made_linear_in(without_squares(base, accelerations_), accelerations_);
      if (!linear) return false;
      Factor factor{.value = *linear};
      for (const Expression& a : accelerations_) factor.slopes.push_back(differentiate(*linear, a));
      const Decision decision = on_the_right_motion(*linear);
      if (decision == Decision::unknown) return false;
      factor.is_obeyed = decision != Decision::counterexample;
      factors.push_back(std::move(factor));
    }
    equations_.push_back(std::move(factors));
    return !equations_.back().empty();
  }

  OtherSolutionsAnswer answer() {
    std::vector<Expression> roots;
    for (const auto& factors : equations_) {
      for (const Factor& factor : factors) {
        roots.push_back(factor.value);
        roots.insert(roots.end(), factor.slopes.begin(), factor.slopes.end());
      }
    }
    gather_choices();
    if (choices_.empty()) return {};
    BallValues values(roots);
    SampledStates states(right_.symbols(), seed_);
    int seen = 0;
    bool is_determined = true;
    std::vector<int> dependent(choices_.size());
    for (int i = 0; i < 2 * states_of_choices && seen < states_of_choices; ++i) {
      State state = states.next();
      if (!right_.set(state, values)) continue;
      values.evaluate();
      ++seen;
      for (std::size_t k = 0; k < choices_.size(); ++k) {
        const Sight sight = look(choices_[k], values);
        if (sight == Sight::another) return {OtherSolutions::some, state};
        if (sight == Sight::dependent) ++dependent[k];
        if (sight != Sight::the_right_one) is_determined = false;
      }
    }
    if (seen < states_of_choices) return {};
    if (is_determined) return {OtherSolutions::none, {}};
    const bool leave_some_free = std::ranges::find(dependent, seen) != dependent.end();
    return {leave_some_free ? OtherSolutions::everything : OtherSolutions::unknown, {}};
  }

 private:
  using Choice = std::vector<const Factor*>;
  enum class Sight { the_right_one, another, dependent, unclear };

  Decision on_the_right_motion(const Expression& e) {
    return vanishing({.value = e,
                      .symbols = right_.symbols(),
                      .seed = seed_,
                      .complete = [&](State& state, BallValues& values) { return right_.set(state, values); },
                      .in_symbols = [&] { return right_.in_letters(e); }})
        .decision;
  }

  void gather_choices() {
    choices_ = {{}};
    for (const auto& factors : equations_) {
      std::vector<Choice> longer;
      for (const Choice& choice : choices_) {
        for (const Factor& factor : factors) {
          longer.push_back(choice);
          longer.back().push_back(&factor);
        }
      }
      choices_ = std::move(longer);
      if (choices_.size() > most_choices) choices_.clear();
    }
  }

  /// By s in slope s = -value, both at the right accelerations: s is how far the solution is from them.
  static Sight look(const Choice& choice, const BallValues& values) {
    BallMatrix slopes;
    std::vector<Ball> rest;
    for (const Factor* factor : choice) {
      slopes.emplace_back();
      for (const Expression& slope : factor->slopes) slopes.back().push_back(values.of(slope));
      rest.push_back(factor->is_obeyed ? Ball(0.0) : -values.of(factor->value));
    }
    const bool is_right = std::ranges::all_of(choice, &Factor::is_obeyed);
    if (!solved(slopes, rest))
      return is_right && is_singular(std::move(slopes)) ? Sight::dependent : Sight::unclear;
    const bool is_elsewhere = std::ranges::any_of(rest, [](const Ball& b) { return !b.contains_zero(); });
    if (is_right) return Sight::the_right_one;
    return is_elsewhere ? Sight::another : Sight::unclear;
  }

  std::vector<Expression> accelerations_;
  RightMotion& right_;
  std::uint64_t seed_;
  std::vector<std::vector<Factor>> equations_;
  std::vector<Choice> choices_;
};

}  // namespace

OtherSolutionsAnswer other_solutions_of_factors(const ExpectedSystem& system, RightMotion& right,
                                                std::span<const Expression> residuals, std::uint64_t seed) {
  try {
    const WorkScope scope(work_on_factors);
    FactoredEquations equations(system, right, seed);
    const bool are_linear =
        std::ranges::all_of(residuals, [&](const Expression& r) { return equations.add(r); });
    return are_linear ? equations.answer() : OtherSolutionsAnswer{};
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return {};
  }
}

}  // namespace qdot
