#include "core/grading/slip.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/grading/ball_values.hpp"
#include "core/grading/changed_terms.hpp"
#include "core/grading/term_groups.hpp"
#include "core/grading/vanishing.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t work_of_search = 150'000;
constexpr int states_to_see = 3;
constexpr std::size_t most_terms = 60;  ///< of a formula, whose slips are looked for

/// p/q with small q that a ball holds, if there is one.
std::optional<Number> small_fraction(const Ball& ball) {
  if (!ball.is_finite() || ball.radius > 1e-12) return std::nullopt;
  for (int q = 1; q <= 144; ++q) {
    const double p = std::nearbyint(ball.value() * q);
    if (std::abs(p) > 1000) return std::nullopt;
    const Ball rest = ball * Ball(static_cast<double>(q)) - Ball(p);
    if (rest.contains_zero() || rest.magnitude() < 1e-20)
      return Number::ratio(static_cast<std::int64_t>(p), q);
  }
  return std::nullopt;
}

/// A formula with its slope in the acceleration by which equations are compared.
struct Part {
  Expression value;
  std::optional<Expression> slope;  ///< none for formulas
};

class SlipSearch {
 public:
  explicit SlipSearch(const SlipQuestion& question)
      : question_(question), symbols_(question.symbols.begin(), question.symbols.end()) {
    for (const Expression& a : question.accelerations) symbols_.push_back({a, {}});
    compare_by_slopes();
    gather();
  }

  std::optional<FoundSlip> find() {
    if (!question_.accelerations.empty() && slopes_in_.empty()) return std::nullopt;
    look();
    const auto multiple = first_multiple();
    const bool is_odd = multiple && multiple->slip == Slip::factor && !is_plain(*multiple->factor);
    if (multiple && !is_odd) return multiple;
    const auto change = first_change();
    // 1/12 for 1/3 is a factor of one term, too, and says less than where it comes from.
    if (is_odd && !(change && change->slip == Slip::moment_of_inertia)) return multiple;
    return change ? change : first_group();
  }

 private:
  /// Whether the factor is one that students forget or write twice.
  static bool is_plain(const Number& factor) { return factor == Number(2) || factor == Number::ratio(1, 2); }

  std::optional<FoundSlip> first_multiple() {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (auto found = as_multiple(i)) return found;
    }
    return as_whole_multiple();
  }

  [[nodiscard]] std::optional<FoundSlip> first_change() const {
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      if (explains(i) && confirms(changes_[i].change))
        return FoundSlip{changes_[i].slip, changes_[i].term, {}, {}};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<FoundSlip> first_group() const {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (auto found = as_group(i)) return found;
    }
    return std::nullopt;
  }

  static Expression slope(const Expression& e, const Expression& x) { return differentiate(e, x); }

  /// Compares by the slopes in an acceleration that both equations contain; if there is none, by those in
  /// everything that changes, what both contain first.
  void compare_by_slopes() {
    const auto is_in_both = [&](const Expression& x) {
      return !slope(question_.submitted, x).is_zero() && !slope(question_.expected, x).is_zero();
    };
    const auto common = std::ranges::find_if(question_.accelerations, is_in_both);
    if (common != question_.accelerations.end()) {
      slopes_in_ = {*common};
      return;
    }
    slopes_in_ = question_.changing;
    if (std::stable_partition(slopes_in_.begin(), slopes_in_.end(), is_in_both) == slopes_in_.begin())
      slopes_in_.clear();
    else
      slopes_in_.insert(slopes_in_.end(), question_.accelerations.begin(), question_.accelerations.end());
  }
  [[nodiscard]] bool are_equations() const { return !slopes_in_.empty(); }

  [[nodiscard]] Part part(const Expression& e) const {
    return {e, are_equations() ? std::optional(slope(e, slopes_in_.front())) : std::nullopt};
  }

  /// Everything that is evaluated at the states.
  void gather() {
    terms_ = terms_of(question_.expected);
    if (terms_.size() > most_terms) terms_.resize(most_terms, terms_.front());
    std::vector<Expression> spoken, in_arguments, sizes;
    for (const SymbolDomain& symbol : symbols_) {
      if (!depends_on(question_.expected, symbol.symbol)) continue;
      const bool is_bounded = std::isfinite(symbol.domain.lower) || std::isfinite(symbol.domain.upper);
      spoken.push_back(symbol.symbol);
      (is_bounded ? sizes : in_arguments).push_back(symbol.symbol);
    }
    const auto is_acceleration = [&](const Expression& x) {
      return std::ranges::find(question_.accelerations, x) != question_.accelerations.end();
    };
    std::erase_if(in_arguments, is_acceleration);
    changes_ = changes_of_whole(question_.expected, question_.gravity);
    for (const Expression& term : terms_) {
      for (ChangedTerm& change : changes_of_term(term, in_arguments)) changes_.push_back(std::move(change));
      if (question_.accelerations.empty()) continue;
      for (ChangedTerm& change : changes_by_cancelled(term, sizes)) changes_.push_back(std::move(change));
    }
    std::ranges::stable_sort(changes_, {}, &ChangedTerm::slip);
    std::vector<ChangedTerm> inertia;
    for (const Expression& d : question_.inertia) {
      inertia.push_back({Slip::moment_of_inertia, d, std::nullopt});
      inertia.push_back({Slip::moment_of_inertia, -d, std::nullopt});
    }
    changes_.insert(changes_.begin(), inertia.begin(), inertia.end());
    groups_ = groups_of_terms(terms_, spoken, question_.accelerations);
    parts_ = {part(question_.submitted), part(question_.expected)};
    for (const Expression& term : terms_) parts_.push_back(part(term));
    for (const ChangedTerm& change : changes_) parts_.push_back(part(change.change));
    for (const TermGroup& group : groups_) parts_.push_back(part(group.sum));
  }

  struct Sight {
    std::vector<Ball> value, slope;
  };

  void look() {
    std::vector<Expression> roots;
    for (const Part& p : parts_) {
      roots.push_back(p.value);
      if (p.slope) roots.push_back(*p.slope);
    }
    BallValues values(roots);
    SampledStates states(symbols_, question_.seed + 2);
    for (int tries = 0; tries < 12 && sights_.size() < states_to_see; ++tries) {
      const State state = states.next();
      for (std::size_t i = 0; i < state.size(); ++i) values.set(symbols_[i].symbol, state[i]);
      values.evaluate();
      if (!values.of(question_.submitted).is_finite() || !values.of(question_.expected).is_finite()) continue;
      Sight sight;
      for (const Part& p : parts_) {
        sight.value.push_back(values.of(p.value));
        sight.slope.push_back(p.slope ? values.of(*p.slope) : Ball(0.0));
      }
      sights_.push_back(std::move(sight));
    }
  }

  /// mu with S = E + mu d, or r ~ rho + mu d, at one state.
  [[nodiscard]] Ball multiple_of(const Sight& sight, std::size_t d) const {
    const auto& [value, slope] = sight;
    if (!are_equations()) return (value[0] - value[1]) / value[d];
    return (value[1] * slope[0] - value[0] * slope[1]) / (value[0] * slope[d] - value[d] * slope[0]);
  }

  /// The same mu at all states.
  [[nodiscard]] std::optional<Number> multiple_of(std::size_t d) const {
    std::optional<Number> multiple;
    for (const Sight& sight : sights_) {
      const auto here = small_fraction(multiple_of(sight, d));
      if (!here || (multiple && !(*here == *multiple))) return std::nullopt;
      multiple = here;
    }
    return sights_.size() == states_to_see ? multiple : std::nullopt;
  }

  [[nodiscard]] std::optional<FoundSlip> as_multiple(std::size_t term) {
    const auto mu = multiple_of(2 + term);
    if (!mu || mu->is_zero() || !confirms(*mu * terms_[term])) return std::nullopt;
    const Number factor = Number(1) + *mu;
    if (factor.is_zero()) return FoundSlip{Slip::dropped_term, {}, {}, {}};
    const Slip slip = factor == Number(-1) ? Slip::sign : Slip::factor;
    return FoundSlip{slip, terms_[term], factor, {}};
  }

  [[nodiscard]] std::optional<FoundSlip> as_group(std::size_t i) const {
    const auto mu = multiple_of(2 + terms_.size() + changes_.size() + i);
    if (!mu) return std::nullopt;
    const Number factor = Number(1) + *mu;
    const bool is_known = factor == Number(-1) || factor.is_zero() || is_plain(factor);
    if (!is_known || !confirms(*mu * groups_[i].sum)) return std::nullopt;
    const Slip slip = factor.is_zero()       ? Slip::dropped_term
                      : factor == Number(-1) ? Slip::sign
                                             : Slip::factor;
    return FoundSlip{.slip = slip, .term = {}, .factor = factor, .shared = groups_[i].symbol};
  }

  [[nodiscard]] std::optional<FoundSlip> as_whole_multiple() {
    if (are_equations()) return std::nullopt;  // an equation may be multiplied
    const auto mu = multiple_of(1);
    if (!mu || mu->is_zero() || !confirms(*mu * question_.expected)) return std::nullopt;
    const Number factor = Number(1) + *mu;
    if (factor.is_zero()) return std::nullopt;
    return FoundSlip{factor == Number(-1) ? Slip::whole_sign : Slip::whole_factor, {}, factor, {}};
  }

  [[nodiscard]] bool explains(std::size_t change) const {
    const std::size_t d = 2 + terms_.size() + change;
    return sights_.size() == states_to_see && std::ranges::all_of(sights_, [&](const Sight& sight) {
             const auto& [value, slope] = sight;
             const Ball rest = are_equations()
                                   ? value[0] * (slope[1] + slope[d]) - (value[1] + value[d]) * slope[0]
                                   : value[0] - value[1] - value[d];
             return rest.is_finite() && rest.contains_zero();
           });
  }

  /// Whether the change makes the submission of the right formula, everywhere.
  [[nodiscard]] bool confirms(const Expression& change) const {
    const Expression changed = question_.expected + change;
    if (!are_equations()) return vanishes(question_.submitted - changed);
    if (vanishes(changed)) return false;  // 0 = 0 is a multiple of everything
    return std::ranges::all_of(slopes_in_, [&](const Expression& x) {
      return vanishes(question_.submitted * slope(changed, x) - changed * slope(question_.submitted, x));
    });
  }

  [[nodiscard]] bool vanishes(const Expression& e) const {
    const Decision decision =
        vanishing({.value = e, .symbols = symbols_, .seed = question_.seed + 3}).decision;
    return decision == Decision::identity || decision == Decision::values;
  }

  const SlipQuestion& question_;
  std::vector<SymbolDomain> symbols_;
  std::vector<Expression> slopes_in_;  ///< by which equations are compared; none: they are formulas
  std::vector<Expression> terms_;
  std::vector<ChangedTerm> changes_;
  std::vector<TermGroup> groups_;
  std::vector<Part> parts_;  ///< the submission, the right formula, its terms, their changes, their groups
  std::vector<Sight> sights_;
};

}  // namespace

std::optional<FoundSlip> find_slip(const SlipQuestion& question) {
  try {
    const WorkScope scope(work_of_search);
    return SlipSearch(question).find();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return std::nullopt;
  }
}

}  // namespace qdot
