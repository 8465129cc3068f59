#include "core/symmetry/symmetries.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/zeroness.hpp"
#include "core/mechanics/jumps.hpp"
#include "core/symmetry/constrained_changes.hpp"
#include "core/symmetry/dependence.hpp"
#include "core/symmetry/exact_coefficients.hpp"
#include "core/symmetry/gauge_terms.hpp"
#include "core/symmetry/random_place.hpp"
#include "core/symmetry/time_gauges.hpp"

namespace qdot {
namespace {

/// For one search, in units of core/base/work.hpp; the proofs have their own bound each.
constexpr std::uint64_t most_work = 3'000'000;
constexpr std::uint64_t most_work_of_proof = 400'000;
/// Places in a row that show nothing new before the dependences count as all.
constexpr int enough_places = 6;
constexpr int most_places_without_value = 200;

/// The dependences among the expressions at random places, with one draw of the parameters.
std::vector<std::vector<Modular>> dependences(PlaceEvaluator& place, std::size_t columns,
                                              std::uint64_t draw_of_parameters) {
  place.keep(draw_of_parameters);
  RowSpace space(columns);
  int without_news = 0, without_value = 0;
  for (std::uint64_t seed = 1; space.rank() < columns && without_news < enough_places; ++seed) {
    spend_work(place.size() + columns * (space.rank() + 1));
    const auto values = place.values(seed);
    if (!values) {
      if (++without_value > most_places_without_value)
        throw Error(ErrorCode::too_large, "Hardly any place was found where L has a value.");
      continue;
    }
    std::vector<Modular> re, im;
    for (const Residue& value : *values) {
      re.push_back(value.re);
      im.push_back(value.im);
    }
    const bool is_new = space.add(std::move(re));
    without_news = space.add(std::move(im)) || is_new ? 0 : without_news + 1;
  }
  return space.dependences();
}

/// With smooth functions where the Lagrangian jumps: derivatives of jumps prove nothing.
Lagrangian smoothed_without_gauge_terms(const Lagrangian& lagrangian) {
  Lagrangian copy = copied(lagrangian);
  copy.lagrangian = SmoothedJumps(copy.lagrangian, copy.symbols).smooth();
  copy.lagrangian = without_gauge_terms(copy);
  return copy;
}

class SearchForSymmetries {
 public:
  SearchForSymmetries(const Lagrangian& lagrangian, std::span<const ConservedQuantity> known,
                      const MoreChanges& more)
      : result_{smoothed_without_gauge_terms(lagrangian), {}, {}, {}},
        jumps_(result_.lagrangian.graph->adopt(lagrangian.lagrangian), result_.lagrangian.symbols),
        allowed_(allowed_rates(result_.lagrangian)),
        variation_(result_.lagrangian, allowed_ ? allowed_->rates : std::vector<Replacement>{}) {
    if (allowed_) result_.on_constraints = allowed_->rates;
    constants_ = result_.lagrangian.symbols.parameters;
    constants_.push_back(result_.lagrangian.graph->symbol("pi"));  // the pitch of a screw is h/(2 pi)
    const auto is_known = [&](const std::string& name) {
      return std::ranges::any_of(known, [&](const ConservedQuantity& q) { return q.name == name; });
    };
    std::vector<bool> ignorable;
    for (const std::string& p : momentum_names(result_.lagrangian.symbols)) ignorable.push_back(is_known(p));
    result_.changes = elementary_changes(result_.lagrangian, ignorable, is_known("energy") || is_known("h"));
    add_changes(more);
    vary();
  }

  /// Of places alone.
  explicit SearchForSymmetries(const Lagrangian& lagrangian)
      : result_{smoothed_without_gauge_terms(lagrangian), {}, {}, {}},
        jumps_(result_.lagrangian.graph->adopt(lagrangian.lagrangian), result_.lagrangian.symbols),
        variation_(result_.lagrangian),
        constants_(result_.lagrangian.symbols.parameters) {
    const std::vector<bool> none(result_.lagrangian.symbols.coordinates.value.size());
    for (ElementaryChange& change : elementary_changes(result_.lagrangian, none, true)) {
      if (change.kind == ChangeKind::shift || change.kind == ChangeKind::linear)
        result_.changes.push_back(std::move(change));
    }
    vary();
  }

  /// Of the Lagrangian that was given.
  SymmetrySearch result() {
    PlaceEvaluator place(*result_.lagrangian.graph, variations_, constants_);
    const auto first = dependences(place, variations_.size(), 1);
    if (first.empty()) return with_jumps();
    const auto second = dependences(place, variations_.size(), 2);
    result_.is_complete = first.size() == second.size();
    for (std::size_t k = 0; k < std::min(first.size(), second.size()); ++k)
      try_to_claim({first[k], second[k]});
    return with_jumps();
  }

 private:
  SymmetrySearch with_jumps() {
    Expression& own = result_.lagrangian.lagrangian;
    own = jumps_.with_jumps(own);
    return std::move(result_);
  }

  void vary() {
    for (const ElementaryChange& change : result_.changes) variations_.push_back(variation_(change.change));
  }

  /// Before the linear ones, so that those may be combined with them.
  void add_changes(const MoreChanges& more) {
    std::vector<ElementaryChange> added;
    if (allowed_) added = changes_along(result_.lagrangian, *allowed_);
    if (allowed_ && more) std::ranges::move(more(result_.lagrangian), std::back_inserter(added));
    const auto is_linear = [](const ElementaryChange& change) { return change.kind >= ChangeKind::linear; };
    const auto place = std::ranges::find_if(result_.changes, is_linear);
    result_.changes.insert(place, added.begin(), added.end());
    const std::vector<ElementaryChange> gauges = gauges_of_time(result_.lagrangian);
    result_.changes.insert(result_.changes.begin(), gauges.begin(), gauges.end());
  }

  void try_to_claim(const SampledDependence& dependence) {
    const Lagrangian& lagrangian = result_.lagrangian;
    for (const AngleForm angles : {AngleForm::as_written, AngleForm::single}) {
      auto coefficients = exact_coefficients(variations_, dependence, constants_, angles);
      if (!coefficients) continue;
      PointChange change = combination(*lagrangian.graph, *coefficients, result_.changes);
      if (zeroness(variation_(change), most_work_of_proof) != Zeroness::zero) continue;
      result_.found.push_back({std::move(*coefficients), std::move(change)});
      return;
    }
    result_.is_complete = false;
  }

  SymmetrySearch result_;
  SmoothedJumps jumps_;
  std::optional<AllowedRates> allowed_;
  Variation variation_;
  std::vector<Expression> constants_;  ///< in which coefficients are
  std::vector<Expression> variations_;
};

/// None where it grows too large.
template <class... Arguments>
SymmetrySearch searched(const Lagrangian& lagrangian, const Arguments&... more) {
  const WorkScope scope(most_work);
  try {
    return SearchForSymmetries(lagrangian, more...).result();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large && error.code() != ErrorCode::not_applicable) throw;
    return {copied(lagrangian), {}, {}, {}, false};
  }
}

}  // namespace

SymmetrySearch affine_symmetries(const Lagrangian& lagrangian, std::span<const ConservedQuantity> known,
                                 const MoreChanges& more) {
  return searched(lagrangian, known, more);
}

SymmetrySearch symmetries_of_places(const Lagrangian& lagrangian) { return searched(lagrangian); }

}  // namespace qdot
