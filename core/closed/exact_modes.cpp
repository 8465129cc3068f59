#include "core/closed/exact_modes.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/closed/linear_motions.hpp"
#include "core/closed/trial.hpp"
#include "core/expr/parse.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_coordinates = 6;

/// One solution of the eigenvalue problem with its forms.
struct Candidate {
  Expression square;  ///< |lambda|
  bool oscillates{};
  std::vector<Expression> shape;  ///< of all coordinates, or empty
  std::optional<ExactMode> form;  ///< none where it is too long
};

bool is_number(const Expression& e) {
  const NodeId root = e.id();
  return std::ranges::none_of(reachable(e.graph(), {&root, 1}),
                              [&](NodeId id) { return std::holds_alternative<Symbol>(e.graph().node(id)); });
}

class Derivation {
 public:
  Derivation(const Statics& statics, const LinearMotions& motions, const ExactPlace& place,
             const ExactValues& values)
      : statics_(statics), motions_(motions), place_(place), values_(values), graph_(*motions.graph) {}

  [[nodiscard]] std::vector<Candidate> candidates(const Relations& relations) const {
    std::vector<Candidate> found;
    for (const LinearMode& mode : modes_at(motions_, place_, relations.replacements)) {
      if (mode.lambda.is_zero() || !is_true(mode, relations)) continue;
      found.push_back(candidate(mode, relations));
    }
    return found;
  }

 private:
  [[nodiscard]] std::size_t total() const { return values_.model().scene.coordinates.size(); }
  [[nodiscard]] Expression written(const Surd& x) const { return to_expression(graph_, x); }

  /// The equations hold at other values of the parameters, too.
  [[nodiscard]] bool is_true(const LinearMode& mode, const Relations& relations) const {
    Trial trial(values_, relations);
    trial.set(motions_.x, place_.x());
    for (const Expression& force : motions_.forces) trial.vanishes({force});
    for (std::size_t i = 0; i < motions_.x.size(); ++i) {
      std::vector<Expression> terms;
      for (std::size_t j = 0; j < motions_.x.size(); ++j) {
        if (mode.shape[j].is_zero()) continue;
        const Expression v = written(mode.shape[j]);
        terms.push_back(motions_.stiffness[i][j] * v);
        terms.push_back(-(motions_.mass[i][j] * written(mode.lambda) * v));
      }
      trial.vanishes(std::move(terms));
    }
    return trial.passes();
  }

  [[nodiscard]] Candidate candidate(const LinearMode& mode, const Relations& relations) const {
    const bool oscillates = values_.value(written(mode.lambda)).value > 0;
    const Surd square = oscillates ? mode.lambda : -mode.lambda;
    Candidate result{written(square), oscillates, {}, std::nullopt};
    const std::optional<ClosedForm> form = closed_form(values_, result.square, relations);
    if (!form) return result;
    ExactMode exact{*form, {}, {}, {}, {}, {}, {}};
    exact.rate = closed_form(values_, positive_root(graph_, square, values_.sign_of()), relations);
    if (oscillates) exact.period = period(square, relations);
    exact.lambda = scaled_lambda(mode.lambda, relations);
    const std::vector<Surd> shape = whole_shape(mode, relations);
    for (const Surd& component : shape) result.shape.push_back(written(component));
    exact.shape = forms(shape, relations);
    if (!shape.empty()) exact.scaled_shape = forms(scaled(shape, relations), relations);
    result.form = std::move(exact);
    return result;
  }

  [[nodiscard]] std::optional<ClosedForm> period(const Surd& square, const Relations& relations) const {
    const Surd inverse = Surd(rational_function(graph_.number(1))) / square;
    const Expression root = positive_root(graph_, inverse, values_.sign_of());
    return closed_form(values_, Number(2) * graph_.symbol("pi") * root, relations);
  }

  [[nodiscard]] std::optional<ClosedForm> scaled_lambda(const Surd& lambda,
                                                        const Relations& relations) const {
    if (!values_.model().parsed.scales) return std::nullopt;
    const Expression time = graph_.adopt(values_.model().parsed.scales->time);
    const Expression square = substitute(pow(time, Number(2)), relations.replacements);
    const Expression value = written(lambda * Surd(rational_function(square)));
    return is_number(value) ? closed_form(values_, value, relations) : std::nullopt;
  }

  /// With the ignored coordinates, whose velocities follow those of the others where no momentum holds them.
  [[nodiscard]] std::vector<Surd> whole_shape(const LinearMode& mode, const Relations& relations) const {
    std::vector<Surd> shape(total());
    const auto entry = [&](const Expression& e) {
      return rational_function(substitute(place_.at(e), relations.replacements));
    };
    for (std::size_t k = 0; k < mode.shape.size(); ++k) shape[statics_.reduction.kept[k]] = mode.shape[k];
    for (std::size_t c = 0; c < motions_.ignored_rates.size(); ++c) {
      Surd sum;
      for (std::size_t j = 0; j < mode.shape.size(); ++j) {
        if (!entry(motions_.ignored_slopes[c][j]).is_zero()) return {};
        if (!mode.shape[j].is_zero()) sum = sum + Surd(entry(motions_.ignored_rates[c][j])) * mode.shape[j];
      }
      shape[statics_.reduction.ignored[c]] = sum;
    }
    return normalized(std::move(shape));
  }

  static std::vector<Surd> normalized(std::vector<Surd> shape) {
    const auto first = std::ranges::find_if_not(shape, [](const Surd& x) { return x.is_zero(); });
    if (first == shape.end()) return {};
    const Surd unit = *first;
    for (Surd& component : shape) {
      if (!component.is_zero()) component = component / unit;
    }
    return shape;
  }

  /// Angles as arcs; empty where coordinates have no common unit then.
  [[nodiscard]] std::vector<Surd> scaled(std::vector<Surd> shape, const Relations& relations) const {
    std::vector<std::string> names;
    for (const Parameter& p : values_.model().scene.parameters) names.push_back(p.name);
    const auto& coordinates = values_.model().scene.coordinates;
    const auto unit = [](const Coordinate& q) { return q.scale.empty() ? q.unit : "m"; };
    for (std::size_t i = 0; i < shape.size(); ++i) {
      if (unit(coordinates[i]) != unit(coordinates[0])) return {};
      if (coordinates[i].scale.empty() || shape[i].is_zero()) continue;
      const Expression scale = parse(coordinates[i].scale, graph_, names);
      shape[i] = shape[i] * Surd(rational_function(substitute(scale, relations.replacements)));
    }
    return normalized(std::move(shape));
  }

  /// All of them, or none.
  [[nodiscard]] std::vector<ClosedForm> forms(const std::vector<Surd>& shape,
                                              const Relations& relations) const {
    std::vector<ClosedForm> result;
    for (const Surd& component : shape) {
      auto form = closed_form(values_, written(component), relations);
      if (!form) return {};
      result.push_back(*std::move(form));
    }
    return result;
  }

  const Statics& statics_;
  const LinearMotions& motions_;
  const ExactPlace& place_;
  const ExactValues& values_;
  Graph& graph_;
};

/// The one candidate with the mode's eigenvalue; null where there is none, or more.
const Candidate* of_mode(const std::vector<Candidate>& candidates, const Mode& mode,
                         const ExactValues& values) {
  const bool oscillates = mode.kind == ModeKind::oscillation;
  const bool grows = mode.kind == ModeKind::growth || mode.kind == ModeKind::decay;
  if (!mode.lambda || (!oscillates && !grows)) return nullptr;
  const std::optional<double>& error = oscillates ? mode.omega_error : mode.rate_error;
  if (!error) return nullptr;
  const double number = oscillates ? mode.omega : mode.rate;
  const Candidate* only = nullptr;
  for (const Candidate& candidate : candidates) {
    if (candidate.oscillates != oscillates) continue;
    const Real value = values.value(sqrt(candidate.square));
    if (!agrees(value, number, *error)) continue;
    if (only != nullptr && only->square != candidate.square) return nullptr;
    only = &candidate;
  }
  return only;
}

/// Shapes have no stated error; theirs is far below this.
constexpr double shapes_agree = 1e-9;

bool has_shape(const Candidate& candidate, const Mode& mode, const ExactValues& values) {
  for (std::size_t i = 0; i < candidate.shape.size(); ++i) {
    const double formula = values.value(candidate.shape[i]).value;
    if (!(std::abs(mode.shape[i] - formula) <= shapes_agree * std::max(1.0, std::abs(formula)))) return false;
  }
  return mode.multiplicity == 1;
}

/// Relations for parameters that the equations speak of.
Relations relevant(const Relations& relations, const LinearMotions& motions) {
  std::vector<NodeId> roots;
  for (const Expression& e : motions.forces) roots.push_back(e.id());
  for (const Matrix* matrix : {&motions.mass, &motions.stiffness}) {
    for (const auto& row : *matrix) {
      for (const Expression& e : row) roots.push_back(e.id());
    }
  }
  const std::vector<NodeId> below = reachable(*motions.graph, roots);
  Relations result{{}, relations.are_defaults};
  for (const Replacement& relation : relations.replacements) {
    if (std::ranges::binary_search(below, relation.first.id())) result.replacements.push_back(relation);
  }
  return result;
}

std::vector<Interval> enclosed_state(const Modes& found) {
  std::vector<Interval> near;
  for (std::size_t i = 0; i < found.y.size() / 2; ++i) {
    const double error = found.y_error[i].value_or(0);
    near.emplace_back(found.y[i] - error, found.y[i] + error);
  }
  return near;
}

/// The shortest form of one mode: in all parameters, with the relations that are written, or with those that
/// the numbers satisfy, where these leave nothing but a number and the scene's units.
struct Choice {
  const Candidate* general{};
  const Candidate* chosen{};
};

Choice choice(const Mode& mode, const ExactValues& values, const std::vector<Candidate>& general,
              const std::vector<Candidate>& related, const std::vector<Candidate>& by_scale) {
  const auto with_form = [&](const std::vector<Candidate>& candidates) {
    const Candidate* found = of_mode(candidates, mode, values);
    return found != nullptr && found->form ? found : nullptr;
  };
  const auto is_shorter = [](const Candidate* a, const Candidate* b) {
    return a != nullptr && (b == nullptr || written_length(a->square) < written_length(b->square));
  };
  Choice result{with_form(general), nullptr};
  result.chosen = result.general;
  if (const Candidate* found = with_form(related); is_shorter(found, result.chosen)) result.chosen = found;
  const Candidate* scaled = with_form(by_scale);
  if (is_shorter(scaled, result.chosen) && values.speaks_of_scales(scaled->square)) result.chosen = scaled;
  return result;
}

ExactModes derived(const Dynamics& dynamics, const Statics& statics, const ExactValues& values,
                   const LinearMotions& motions, const Modes& found) {
  ExactModes result;
  result.modes.resize(found.modes.size());
  result.state.resize(dynamics.model().scene.coordinates.size());
  const PlaceProblem problem = place_problem(motions, statics, values, enclosed_state(found));
  const auto place = ExactPlace::of(problem);
  if (!place) return result;
  const Derivation derivation(statics, motions, *place, values);
  const Relations written = relevant(values.relations(), motions);
  const Relations scaled = relevant(values.relations_by_scale(), motions);
  std::vector<Candidate> related, by_scale;
  const std::vector<Candidate> general = derivation.candidates({});
  if (!written.replacements.empty()) related = derivation.candidates(written);
  if (scaled.replacements.size() > written.replacements.size()) by_scale = derivation.candidates(scaled);
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    const auto [plain, chosen] = choice(found.modes[i], values, general, related, by_scale);
    if (chosen == nullptr) continue;
    result.modes[i] = chosen->form;
    if (plain != nullptr && plain != chosen) result.modes[i]->general = plain->form->square;
    if (has_shape(*chosen, found.modes[i], values)) continue;
    result.modes[i]->shape.clear();
    result.modes[i]->scaled_shape.clear();
  }
  for (std::size_t k = 0; k < motions.x.size(); ++k)
    result.state[statics.reduction.kept[k]] = closed_form(values, place->x()[k], {});
  return result;
}

}  // namespace

ExactModes exact_modes(const Dynamics& dynamics, const Reals& parameters, const WrittenTexts& written,
                       const Modes& found) {
  ExactModes none;
  none.modes.resize(found.modes.size());
  none.state.resize(dynamics.model().scene.coordinates.size());
  const auto statics = dynamics.statics(parameters);
  if (statics->reduction.degrees_of_freedom() > most_coordinates || !found.damping.empty()) return none;
  try {
    const LinearMotions motions =
        linear_motions(*statics, momenta_vanish(dynamics, *statics, parameters, found.y));
    const ExactValues values(dynamics.model(), motions.graph, written, parameters);
    return derived(dynamics, *statics, values, motions, found);
  } catch (const Error&) {  // the algebra grows too large, or divides by what vanishes
    return none;
  }
}

}  // namespace qdot
