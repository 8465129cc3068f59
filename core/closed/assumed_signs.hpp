#pragma once
// What a formula assumes beside the signs of the parameters: a derivation takes sums of them to keep their
// sign, a*cos(c) > b*sin(c), where it says on which side an angle lies, or takes a square out of a root.

#include <functional>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/closed/exact_place.hpp"
#include "core/closed/exact_values.hpp"
#include "core/closed/linear_motions.hpp"
#include "core/closed/trial.hpp"
#include "core/closed/tries.hpp"

namespace qdot {

/// Expressions whose signs were asked for, and that the signs of the parameters leave open: each is positive
/// where the symbols have their values, and is held against values that have the same signs but are far from
/// these. They are the same whatever the values are.
class AssumedSigns {
 public:
  /// `given`: symbols beside the parameters that have values. Outlived by the values and the relations.
  AssumedSigns(const ExactValues& values, const Relations& relations, std::vector<Expression> given);

  /// Of what was looked for nothing is assumed; what was asked of it is asked of its formula, where one is
  /// given.
  void leave_out(const Expression& symbol, const std::optional<Expression>& formula = {});

  /// Its sign counts as asked for.
  void ask(const Expression& e);
  /// At least one of those that are positive here is assumed, unless one is known to be: all of them are
  /// known to fail together somewhere. After let_go().
  void ask_one_of(const std::vector<Expression>& conditions);
  /// So do those of what has to be positive for it to be real.
  void ask_for_value_of(const Expression& e);

  /// What is given may have the other sign, too, unless that has to be assumed.
  void let_signs_go();
  /// So may these parameters, or given symbols, of which a formula does not speak; before anything is asked.
  /// Far places are near ones, too, then, and those that `also` makes of them.
  using OtherPlace = std::function<std::optional<FarPlace>(const FarPlace&)>;
  void let_go(const std::vector<Expression>& symbols, const OtherPlace& also);

  /// Of all that was asked for until now, what has to be assumed for the claims to hold and have values, as
  /// inequalities with what is subtracted on the other side.
  [[nodiscard]] std::vector<std::string> needed_for(const Trial& trial);
  /// The same of claims that are tried where the symbols have these values.
  using HoldsAt = std::function<bool(const std::vector<RealAssignment>&)>;
  [[nodiscard]] std::vector<std::string> needed_for(const HoldsAt& holds_at);
  /// The signs of parameters, "a > 0", without which some claim fails where all that is needed for them
  /// holds: also of those that a formula does not speak of, as where a well exists only with one.
  [[nodiscard]] std::vector<std::string> signs_needed_for(const Trial& trial);
  /// What keeps a formula from the far places where it does not hold, of which so many are tried, and so many
  /// of the others that are made of them, and then places near those where it hardly holds; none where
  /// nothing that was asked for does. After let_go().
  [[nodiscard]] std::optional<std::vector<std::string>> separating(const Tried& tried, int tries,
                                                                   int other_tries);
  /// Whether anything is open that is not true at all far places.
  [[nodiscard]] bool are_there();

 private:
  struct Open {
    Expression e;              ///< positive here
    std::vector<bool> broken;  ///< at which of the far places it is not
  };

  [[nodiscard]] std::vector<std::size_t> numbers_needed_for(const HoldsAt& holds_at);
  [[nodiscard]] bool is_untried(std::size_t open, const std::vector<std::size_t>& needed) const;
  [[nodiscard]] std::vector<std::size_t> with_needed_elsewhere(std::vector<std::size_t> needed,
                                                               const HoldsAt& holds_at) const;
  [[nodiscard]] std::optional<FarPlace> with_other_sign(FarPlace place, std::size_t parameter) const;
  [[nodiscard]] bool is_sign_needed(std::size_t parameter, const Trial& trial,
                                    const std::vector<std::size_t>& needed) const;
  void take_asked();
  void ask_parts(const Expression& e);
  void take(const Expression& positive);
  void find_far_places();
  [[nodiscard]] FarPlace far_place(int number, std::minstd_rand& random) const;
  [[nodiscard]] FarPlace place_near(FarPlace place, double reach, std::minstd_rand& random) const;
  void relate(FarPlace& place) const;
  using Chosen = std::optional<std::vector<std::size_t>>;  ///< numbers of what is open
  [[nodiscard]] Chosen that_tell(Tries& all) const;
  [[nodiscard]] std::optional<FarPlace> with_factor(FarPlace place, std::size_t i, double factor) const;
  bool try_past(const Expression& positive, const FarPlace& from, std::size_t i, double step, Tries& all,
                bool by_others) const;
  void try_unbroken(Tries& all, bool by_others) const;
  bool is_refuted(Tries& all, const std::vector<std::size_t>& chosen, bool by_others,
                  std::minstd_rand& random);
  [[nodiscard]] bool hold_at(const std::vector<std::size_t>& chosen, const FarPlace& place) const;
  bool is_refuted_inside(Tries& all, const std::vector<std::size_t>& chosen, bool by_others,
                         std::minstd_rand& random);
  bool is_refuted_at_zeros(Tries& all, const std::vector<std::size_t>& chosen, bool by_others) const;
  /// As the relations say, and with what the motion makes of it where such places are tried.
  [[nodiscard]] std::optional<FarPlace> other_place(FarPlace place, bool by_others) const;
  std::optional<bool> claimed_at(const FarPlace& made_of, Tries& all, const std::vector<std::size_t>& chosen,
                                 bool by_others) const;
  [[nodiscard]] static bool is_broken(const Expression& positive, const FarPlace& place);
  [[nodiscard]] double far_number(const Expression& symbol, const Domain& domain, int number,
                                  std::minstd_rand& random) const;
  [[nodiscard]] bool is_of_parameters(const Expression& e) const;
  [[nodiscard]] std::optional<Expression> positive_of(const Expression& e, int sign) const;
  [[nodiscard]] int sign_of(const Expression& e) const;
  [[nodiscard]] int sign_of(const Polynomial& e) const;
  [[nodiscard]] Expression short_form(const Polynomial& e) const;

  const ExactValues& values_;
  const Relations& relations_;
  std::vector<Expression> given_, angles_;
  bool given_has_signs_{true};
  std::vector<Expression> let_go_;
  OtherPlace also_;
  std::map<NodeId, double> usual_;  ///< where the symbols have their values
  std::map<NodeId, int> known_;     ///< signs; 0 where it is open
  std::vector<Replacement> formulas_;
  std::size_t asked_{};  ///< so many were looked at
  std::set<std::pair<NodeId, int>> seen_;
  std::vector<FarPlace> far_;
  std::vector<Open> open_;
  std::vector<std::vector<Expression>> one_of_;  ///< of each of these is needed
};

/// What is positive inside a coordinate's domain: of an end that is 0.
[[nodiscard]] std::vector<Expression> inside_domain(const Domain& domain, const Expression& x);

/// What the formulas of a place assume so: that nothing pushes there, that it lies in the domains of the
/// coordinates and, of one coordinate, that its stiffness has its sign.
[[nodiscard]] std::vector<std::string> assumed_at(const LinearMotions& motions, const ExactPlace& place,
                                                  const ExactValues& values);

}  // namespace qdot
