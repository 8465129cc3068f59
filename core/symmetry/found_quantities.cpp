#include "core/symmetry/found_quantities.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/listed.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/canonical.hpp"
#include "core/mechanics/dimension_check.hpp"
#include "core/mechanics/notation.hpp"
#include "core/symmetry/constrained_changes.hpp"
#include "core/symmetry/listed_quantities.hpp"
#include "core/symmetry/motion_in_space.hpp"
#include "core/symmetry/shortened_change.hpp"
#include "core/symmetry/symmetry_shape.hpp"

namespace qdot {
namespace {

using Kind = MotionInSpace::Kind;

PointChange opposite(const PointChange& change) {
  PointChange result{{}, -change.time, -change.gauge};
  for (const Expression& shift : change.shift) result.shift.push_back(-shift);
  return result;
}

/// The dimension of every symbol whose unit the scene states.
SymbolDimensions dimensions(const Scene& scene, const Symbols& symbols) {
  SymbolDimensions result;
  const auto known = [](const std::string& unit) {
    const auto parsed = parse_unit(unit);
    return parsed ? parsed->dimension : Dimension{};
  };
  const Dimension second = known("s");
  for (std::size_t k = 0; k < scene.parameters.size(); ++k)
    result[symbols.parameters[k].id()] = known(scene.parameters[k].unit);
  const auto add = [&](const Symbols::Varying& varying, std::size_t k, const std::string& unit) {
    result[varying.value[k].id()] = known(unit);
    result[varying.rate[k].id()] = known(unit) / second;
  };
  for (std::size_t k = 0; k < scene.coordinates.size(); ++k)
    add(symbols.coordinates, k, scene.coordinates[k].unit);
  for (std::size_t k = 0; k < scene.inputs.size(); ++k) add(symbols.inputs, k, scene.inputs[k].unit);
  result[symbols.t.id()] = second;
  return result;
}

/// Of each constraint that has one in a product with a number or parameters alone, such a coordinate by the
/// others; to be put in one after the other.
std::vector<Replacement> solved_positions(const Lagrangian& lagrangian) {
  const std::vector<Expression>& q = lagrangian.symbols.coordinates.value;
  std::vector<Replacement> solved;
  for (const ConstraintEquation& constraint : lagrangian.constraints) {
    if (!constraint.position) continue;
    Expression position = *constraint.position;
    for (const Replacement& known : solved) position = substitute(position, {&known, 1});
    for (const Expression& x : q) {
      const Expression slope = simplify(differentiate(position, x));
      if (slope.is_zero() || depends_on(slope, q) || depends_on(slope, lagrangian.symbols.t)) continue;
      solved.emplace_back(x, simplify(x - position / slope));
      break;
    }
  }
  return solved;
}

/// A change in words: its name, what is done, and what then is constant.
struct Words {
  std::string name, doing, kept;
};

class Wording {
 public:
  Wording(const Model& model, const SymmetrySearch& search, const Lagrangian& given,
          std::span<const Replacement> replacements)
      : scene_(model.scene),
        search_(search),
        lagrangian_(search.lagrangian),
        given_(lagrangian_.graph->adopt(given.lagrangian)),
        notation_(notation_of(model.scene)),
        places_(places_of_bodies(model.parsed, lagrangian_, replacements)),
        bodies_(names_of(model.parsed)),
        dimensions_(dimensions(model.scene, lagrangian_.symbols)),
        on_surface_(solved_positions(lagrangian_)) {}

  /// What the symmetry keeps; none where it says nothing about the motion.
  std::optional<Kept> quantity(const Symmetry& symmetry) const {
    PointChange change = with_unit_of_time(symmetry.change, lagrangian_.symbols);
    if (changes_nothing(change)) return std::nullopt;  // a constraint, written once more
    const auto motion = motion_in_space(places_, lagrangian_.symbols, change, leading(symmetry));
    if (motion && motion->reversed) change = opposite(change);
    change.gauge = gauge_on_constraints(change.gauge, lagrangian_);
    const Expression value = on_constraints(noether_quantity(lagrangian_, change));
    if (!moves(value) || !moves(put_on_surface(value))) return std::nullopt;
    const Words words = motion ? in_space(*motion) : in_coordinates(symmetry, change);
    const auto [kind, spread] = kind_of(search_, symmetry);
    const bool turns_bodies = motion && kind != KindOfChange::in_time && kind != KindOfChange::linear;
    change.gauge = gauge_on_constraints(gauge_of_given(change), lagrangian_);
    return Kept{{words.name, unit(value), value, sentence(words, change)},
                turns_bodies ? KindOfChange::in_space : kind,
                spread};
  }

  /// Whether what one symmetry keeps is what another keeps, times a constant: only constraints make it so.
  [[nodiscard]] bool keep_the_same(const Kept& a, const Kept& b) const {
    if (search_.on_constraints.empty()) return false;
    return is_multiple(put_on_surface(a.quantity.value), put_on_surface(b.quantity.value),
                       lagrangian_.symbols);
  }

 private:
  /// F for the L that was given, whose p and h the sentences speak of: what the search dropped of it, the
  /// total derivative a.q' + b, changes by the time derivative of a.xi + b tau.
  [[nodiscard]] Expression gauge_of_given(const PointChange& change) const {
    const Expression dropped = simplify(given_ - lagrangian_.lagrangian);
    if (dropped.is_zero()) return change.gauge;
    std::vector<Expression> terms{change.gauge};
    std::vector<Replacement> stopped;
    for (std::size_t i = 0; i < change.shift.size(); ++i) {
      const Expression& rate = lagrangian_.symbols.coordinates.rate[i];
      terms.push_back(differentiate(dropped, rate) * change.shift[i]);
      stopped.emplace_back(rate, lagrangian_.graph->number(0));
    }
    terms.push_back(substitute(dropped, stopped) * change.time);
    return simplify_by_degree(lagrangian_.graph->sum(terms), lagrangian_.symbols);
  }

  [[nodiscard]] static bool changes_nothing(const PointChange& change) {
    return change.time.is_zero() && std::ranges::all_of(change.shift, &Expression::is_zero);
  }

  [[nodiscard]] bool moves(const Expression& value) const {
    const Symbols::Varying& q = lagrangian_.symbols.coordinates;
    return depends_on(value, q.rate) || depends_on(value, q.value);
  }

  /// What the constraints leave of it: nothing that moves, where they alone say what it is.
  [[nodiscard]] Expression put_on_surface(const Expression& value) const {
    if (search_.on_constraints.empty()) return value;
    Expression left = substitute(value, search_.on_constraints);
    for (const Replacement& coordinate : on_surface_) left = substitute(left, {&coordinate, 1});
    return simplify_by_degree(left, lagrangian_.symbols);
  }

  /// Whether it has no value at some places.
  [[nodiscard]] bool divides_by_a_place(const Expression& e) const {
    const NodeId root = e.id();
    const auto divides = [&](NodeId id) {
      const auto* power = std::get_if<Power>(&e.graph().node(id));
      return power != nullptr && power->exponent.is_negative() &&
             depends_on(Expression(e.graph(), power->base), lagrangian_.symbols.coordinates.value);
    };
    return std::ranges::any_of(reachable(e.graph(), {&root, 1}), divides);
  }

  /// The value as the constraints allow it to be written, where that is shorter and has a value as often.
  [[nodiscard]] Expression on_constraints(const Expression& value) const {
    if (search_.on_constraints.empty()) return value;
    const Expression other =
        simplify_by_degree(substitute(value, search_.on_constraints), lagrangian_.symbols);
    const bool is_shorter = written_length(other) < written_length(value);
    return is_shorter && (divides_by_a_place(value) || !divides_by_a_place(other)) ? other : value;
  }

  [[nodiscard]] std::string written(const Expression& e) const { return print(e, Form::text, notation_); }
  [[nodiscard]] static std::vector<std::string> names_of(const ParsedScene& scene) {
    std::vector<std::string> names;
    for (const ParsedBody& body : scene.bodies) names.push_back(body.name);
    return names;
  }
  [[nodiscard]] const std::string& coordinate(std::size_t i) const { return scene_.coordinates[i].name; }

  [[nodiscard]] std::string unit(const Expression& value) const {
    return to_text(dimension_of(value, dimensions_).dimension.value_or(Dimension{}));
  }

  /// p.xi - tau h - F by its parts.
  [[nodiscard]] std::string formula(const PointChange& change) const {
    const std::vector<Expression> p = momentum_symbols(lagrangian_);
    const bool has_time = !change.time.is_zero();
    std::vector<Expression> terms{change.gauge, change.time * lagrangian_.graph->symbol("h")};
    for (std::size_t i = 0; i < p.size(); ++i) terms.push_back(-(p[i] * change.shift[i]));
    const Expression sum = lagrangian_.graph->sum(terms);
    return written(has_time ? sum : -sum);
  }

  /// Whether forces outside L do work along the change; those that keep constraints do none.
  [[nodiscard]] bool forces_work(const PointChange& change) const {
    std::vector<Expression> terms;
    for (std::size_t i = 0; i < change.shift.size(); ++i) {
      const Expression& rate = lagrangian_.symbols.coordinates.rate[i];
      terms.push_back(lagrangian_.generalized_forces[i] * (change.shift[i] - change.time * rate));
    }
    std::vector<Replacement> without;
    for (const Expression& multiplier : lagrangian_.symbols.multipliers)
      without.emplace_back(multiplier, lagrangian_.graph->number(0));
    return !simplify(substitute(lagrangian_.graph->sum(terms), without)).is_zero();
  }

  [[nodiscard]] std::string sentence(const Words& words, const PointChange& change) const {
    const bool has_work = forces_work(change);
    std::string effect = has_work ? "changes L by what the forces' work makes up for" : "changes nothing";
    if (!change.gauge.is_zero()) {
      effect = has_work ? "changes L, the forces' work included, only" : "changes L only";
      effect += " by the time derivative of " + written(change.gauge);
    }
    const std::string kept =
        words.kept.empty() || !change.gauge.is_zero() || has_work ? "" : words.kept + ", ";
    const std::string until = scene_.has_impacts() ? " is constant between impacts" : " is constant";
    return words.doing + " " + effect + ", so " + kept + formula(change) + (kept.empty() ? "" : ",") + until +
           condition(change.gauge) + ".";
  }

  /// An integral over the time divides by rates: A cos(w t)/w is none where w is zero.
  [[nodiscard]] std::string condition(const Expression& gauge) const {
    std::vector<Expression> own = lagrangian_.generalized_forces;
    own.push_back(given_);
    const std::vector<Expression> known = divisors(own);
    std::vector<std::string> rates;
    for (const Expression& e : divisors({gauge})) {
      if (!excludes_zero(e) && std::ranges::find(known, e) == known.end()) rates.push_back(written(e));
    }
    if (rates.empty()) return {};
    if (rates.size() == 1) return " where " + rates[0] + " is not zero";
    if (rates.size() == 2) return " where neither " + rates[0] + " nor " + rates[1] + " is zero";
    return " where none of " + listed(rates) + " is zero";
  }

  /// What is divided by, in the order in which it was made.
  [[nodiscard]] std::vector<Expression> divisors(const std::vector<Expression>& all) const {
    const Graph& graph = *lagrangian_.graph;
    std::vector<NodeId> roots;
    for (const Expression& e : all) roots.push_back(e.id());
    std::vector<Expression> found;
    for (const NodeId id : reachable(graph, roots)) {
      const auto* power = std::get_if<Power>(&graph.node(id));
      if (power == nullptr || !power->exponent.is_negative()) continue;
      const Expression base(*lagrangian_.graph, power->base);
      if (std::ranges::find(found, base) == found.end()) found.push_back(base);
    }
    return found;
  }

  [[nodiscard]] bool excludes_zero(const Expression& e) const {
    const auto& parameters = lagrangian_.symbols.parameters;
    const auto k = static_cast<std::size_t>(std::ranges::find(parameters, e) - parameters.begin());
    return k < parameters.size() && !scene_.parameters[k].domain.contains(0);
  }

  [[nodiscard]] Words in_space(const MotionInSpace& motion) const {
    const std::string axis(1, "xyz"[motion.axis]);
    const bool is_plane = places_[0].size() == 2;
    const std::string about = is_plane ? "the origin" : "the " + axis + " axis";
    const std::string parallel = is_plane ? "a point" : "an axis parallel to " + axis;
    const std::string turning = is_plane ? "angular_momentum" : "angular_momentum_" + axis;
    switch (motion.kind) {
      case Kind::translation:
        return {"momentum_" + axis, "Moving the whole system along " + axis, "the momentum along " + axis};
      case Kind::uniform:
        return {"boost_" + axis, "Giving the whole system a velocity along " + axis, ""};
      case Kind::rotation:
        return {turning, "Turning the whole system about " + about, "the angular momentum about " + about};
      case Kind::offset_rotation:
        return {turning, "Turning the whole system about " + parallel, "the angular momentum about it"};
      case Kind::screw:
        return {"screw_" + axis, "Moving the whole system as a screw about " + about, ""};
    }
    return {};
  }

  /// Words for a change that is best told by the coordinates that it moves.
  [[nodiscard]] Words in_coordinates(const Symmetry& symmetry, const PointChange& change) const {
    constexpr std::size_t most_names = 4;
    std::vector<std::string> names, changes;
    std::string suffix;
    for (std::size_t i = 0; i < change.shift.size(); ++i) {
      if (change.shift[i].is_zero()) continue;
      names.push_back(coordinate(i));
      changes.push_back("d" + coordinate(i) + " = " + written(change.shift[i]));
      suffix += "_" + coordinate(i);
    }
    if (!change.time.is_zero()) changes.push_back("dt = " + written(change.time));
    if (names.size() > most_names) suffix.clear();
    Words words{"symmetry" + suffix, "The small change " + listed(changes), ""};
    if (const auto turned = only_turn(search_, symmetry)) return of_turn(*turned, symmetry);
    if (is_only(search_, symmetry, ChangeKind::along)) {
      words.name = "momentum" + suffix;
      words.doing += ", which the constraints allow,";
    } else if (!change.time.is_zero()) {
      words.name = "h" + suffix;
    } else if (is_only(search_, symmetry, ChangeKind::shift)) {
      words.name = "momentum" + suffix;
      if (names.size() > 1 && is_equal(change.shift)) words.doing = "Adding the same to " + listed(names);
    } else if (is_only(search_, symmetry, ChangeKind::boost)) {
      words.name = "boost" + suffix;
    } else if (is_turning(search_, symmetry)) {
      const bool is_screw = moves_along(search_, symmetry);
      words.name = (is_screw ? "screw" : "angular_momentum") + suffix;
      words.doing = (is_screw ? "The screw motion " : "The rotation ") + listed(changes);
    }
    return words;
  }

  [[nodiscard]] Words of_turn(std::size_t turn, const Symmetry& symmetry) const {
    const ElementaryChange& change = search_.changes[turn];
    const std::string axis(1, "xyz"[change.j]);
    const std::string& given = bodies_[change.i];
    const std::string body = given.empty() ? "the body" : "'" + given + "'";
    const bool is_own = change.kind == ChangeKind::own_turn;
    Words words{"spin_" + axis, "Turning " + body + " about an axis through its centre parallel to " + axis,
                ""};
    if (is_own) words = {"own_spin_" + axis, "Turning " + body + " about its own " + axis + " axis", ""};
    if (bodies_.size() > 1 && !given.empty()) words.name += "_" + given;
    std::vector<std::string> shifts;
    for (std::size_t k = 0; k < symmetry.coefficients.size(); ++k) {
      if (symmetry.coefficients[k].is_zero() || search_.changes[k].kind != ChangeKind::shift) continue;
      const Expression shift = symmetry.coefficients[k] / symmetry.coefficients[turn];
      shifts.push_back("d" + coordinate(search_.changes[k].i) + " = " + written(simplify(shift)));
    }
    if (!shifts.empty()) {
      words.name.replace(words.name.find("spin"), 4, "roll");
      words.doing += " together with " + listed(shifts);
    }
    return words;
  }

  [[nodiscard]] static bool is_equal(const std::vector<Expression>& shifts) {
    std::vector<Expression> nonzero;
    std::ranges::copy_if(shifts, std::back_inserter(nonzero),
                         [](const Expression& e) { return !e.is_zero(); });
    return std::ranges::all_of(nonzero, [&](const Expression& e) { return e == nonzero[0]; });
  }

  const Scene& scene_;
  const SymmetrySearch& search_;
  const Lagrangian& lagrangian_;
  Expression given_;  ///< L with its total derivatives
  Notation notation_;
  std::vector<Vector> places_;
  std::vector<std::string> bodies_;  ///< names
  SymbolDimensions dimensions_;
  std::vector<Replacement> on_surface_;  ///< to be put in one after the other
};

void make_names_differ(std::vector<ConservedQuantity>& quantities) {
  std::map<std::string, int> count;
  for (ConservedQuantity& quantity : quantities) {
    const int number = ++count[quantity.name];
    if (number > 1) quantity.name += "_" + std::to_string(number);
  }
}

}  // namespace

FoundQuantities found_quantities(const Model& model, const Lagrangian& lagrangian,
                                 std::span<const Replacement> replacements,
                                 std::span<const ConservedQuantity> known) {
  const SymmetrySearch search = affine_symmetries(lagrangian, known, [&](const Lagrangian& own) {
    return turns_of_bodies(model.parsed, own, replacements);
  });
  FoundQuantities result{search.lagrangian.graph, {}, search.is_complete};
  if (search.found.empty()) return result;
  const Wording wording(model, search, lagrangian, replacements);
  std::vector<Kept> all;
  for (const Symmetry& symmetry : search.found) {
    auto kept = wording.quantity(symmetry);
    const auto is_the_same = [&](const Kept& other) { return wording.keep_the_same(*kept, other); };
    if (kept && std::ranges::none_of(all, is_the_same)) all.push_back(*std::move(kept));
  }
  result.quantities = listed_quantities(all, search.lagrangian);
  make_names_differ(result.quantities);
  return result;
}

}  // namespace qdot
