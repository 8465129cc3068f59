#include "core/closed/exact_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/linear_motions.hpp"
#include "core/closed/trial.hpp"
#include "core/expr/parse.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_coordinates = 6;

/// One eigenvalue with its forms.
struct Option {
  Expression root;  ///< sqrt(|lambda|)
  bool oscillates{};
  ExactMode form;
  std::vector<Expression> shape;  ///< of all coordinates, or empty
};

bool is_number(const Expression& e) {
  const NodeId root = e.id();
  return std::ranges::none_of(reachable(e.graph(), {&root, 1}),
                              [&](NodeId id) { return std::holds_alternative<Symbol>(e.graph().node(id)); });
}

/// The modes at a place with some relations put in, and their forms.
class Derivation {
 public:
  Derivation(const Statics& statics, const LinearMotions& motions, const ExactPlace& place,
             const ExactValues& values, const Relations& relations)
      : statics_(statics),
        motions_(motions),
        place_(place),
        values_(values),
        relations_(relations),
        graph_(*motions.graph),
        modes_(modes_at(motions, place, relations.replacements)) {
    std::erase_if(modes_, [&](const LinearMode& mode) { return mode.lambda.is_zero() || !is_true(mode); });
  }

  [[nodiscard]] const std::vector<LinearMode>& modes() const { return modes_; }
  [[nodiscard]] const Relations& relations() const { return relations_; }
  [[nodiscard]] double value(const LinearMode& mode) const {
    return values_.value(plain_expression(graph_, mode.lambda)).value;
  }
  [[nodiscard]] bool oscillates(const LinearMode& mode) const {
    return values_.sign(plain_expression(graph_, mode.lambda)) > 0;
  }
  /// |lambda|
  [[nodiscard]] Expression square(const LinearMode& mode) {
    return written(oscillates(mode) ? mode.lambda : -mode.lambda);
  }
  [[nodiscard]] std::optional<ClosedForm> form(const LinearMode& mode) {
    return closed_form(values_, square(mode), relations_);
  }
  /// All forms of a mode whose square has one.
  [[nodiscard]] Option option(const LinearMode& mode) {
    const bool oscillates = this->oscillates(mode);
    const Surd square = oscillates ? mode.lambda : -mode.lambda;
    Option result{
        sqrt(plain_expression(graph_, square)), oscillates, {*form(mode), {}, {}, {}, {}, {}, {}}, {}};
    result.form.rate = closed_form(values_, root(square), relations_);
    if (oscillates) result.form.period = period(square);
    result.form.lambda = scaled_lambda(mode.lambda);
    const std::vector<Surd> shape = whole_shape(mode);
    for (const Surd& component : shape) result.shape.push_back(plain_expression(graph_, component));
    result.form.shape = forms(shape);
    if (!shape.empty()) result.form.scaled_shape = forms(scaled(shape));
    return result;
  }

 private:
  [[nodiscard]] std::size_t total() const { return values_.model().scene.coordinates.size(); }
  [[nodiscard]] Expression root_of(const Polynomial& n) {
    const auto found = std::ranges::find(roots_, n, &std::pair<Polynomial, Expression>::first);
    if (found != roots_.end()) return found->second;
    roots_.emplace_back(n, root_form(graph_, n));
    return roots_.back().second;
  }
  [[nodiscard]] Expression written(const Surd& x) {
    return x.is_rational() ? to_expression(graph_, x.p) : to_expression(graph_, x, root_of(x.n));
  }
  [[nodiscard]] Expression root(const Surd& x) {
    if (x.is_rational()) return positive_root(graph_, x.p, values_.sign_of());
    return positive_root(graph_, x, root_of(x.n), values_.sign_of());
  }

  /// The equations hold at other values of the parameters, too.
  [[nodiscard]] bool is_true(const LinearMode& mode) const {
    Trial trial(values_, relations_);
    trial.set(motions_.x, place_.x());
    for (const Expression& force : motions_.forces) trial.vanishes({force});
    const Expression lambda = plain_expression(graph_, mode.lambda);
    for (std::size_t i = 0; i < motions_.x.size(); ++i) {
      std::vector<Expression> terms;
      for (std::size_t j = 0; j < motions_.x.size(); ++j) {
        if (mode.shape[j].is_zero()) continue;
        const Expression v = plain_expression(graph_, mode.shape[j]);
        terms.push_back(motions_.stiffness[i][j] * v);
        terms.push_back(-(motions_.mass[i][j] * lambda * v));
      }
      trial.vanishes(std::move(terms));
    }
    return trial.passes();
  }

  [[nodiscard]] std::optional<ClosedForm> period(const Surd& square) {
    const Surd inverse = Surd(rational_function(graph_.number(1))) / square;
    return closed_form(values_, Number(2) * graph_.symbol("pi") * root(inverse), relations_);
  }

  [[nodiscard]] std::optional<ClosedForm> scaled_lambda(const Surd& lambda) {
    if (!values_.model().parsed.scales) return std::nullopt;
    const Expression time = graph_.adopt(values_.model().parsed.scales->time);
    const Expression square = substitute(pow(time, Number(2)), relations_.replacements);
    const Expression value = written(lambda * Surd(rational_function(square)));
    return is_number(value) ? closed_form(values_, value, relations_) : std::nullopt;
  }

  /// With the ignored coordinates, whose velocities follow those of the others where no momentum holds them.
  [[nodiscard]] std::vector<Surd> whole_shape(const LinearMode& mode) const {
    std::vector<Surd> shape(total());
    const auto entry = [&](const Expression& e) {
      return rational_function(substitute(place_.at(e), relations_.replacements));
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
  [[nodiscard]] std::vector<Surd> scaled(std::vector<Surd> shape) const {
    std::vector<std::string> names;
    for (const Parameter& p : values_.model().scene.parameters) names.push_back(p.name);
    const auto& coordinates = values_.model().scene.coordinates;
    const auto unit = [](const Coordinate& q) { return q.scale.empty() ? q.unit : "m"; };
    for (std::size_t i = 0; i < shape.size(); ++i) {
      if (unit(coordinates[i]) != unit(coordinates[0])) return {};
      if (coordinates[i].scale.empty() || shape[i].is_zero()) continue;
      const Expression scale = parse(coordinates[i].scale, graph_, names);
      shape[i] = shape[i] * Surd(rational_function(substitute(scale, relations_.replacements)));
    }
    return normalized(std::move(shape));
  }

  /// All of them, or none.
  [[nodiscard]] std::vector<ClosedForm> forms(const std::vector<Surd>& shape) {
    std::vector<ClosedForm> result;
    for (const Surd& component : shape) {
      auto form = closed_form(values_, written(component), relations_);
      if (!form) return {};
      result.push_back(*std::move(form));
    }
    return result;
  }

  const Statics& statics_;
  const LinearMotions& motions_;
  const ExactPlace& place_;
  const ExactValues& values_;
  Relations relations_;
  Graph& graph_;
  std::vector<LinearMode> modes_;
  std::vector<std::pair<Polynomial, Expression>> roots_;  ///< n and forms of sqrt(n)
};

/// The option with the mode's eigenvalue; null where there is none, or more.
const Option* of_mode(const std::vector<Option>& options, const Mode& mode, const ExactValues& values) {
  const bool oscillates = mode.kind == ModeKind::oscillation;
  const bool grows = mode.kind == ModeKind::growth || mode.kind == ModeKind::decay;
  if (!mode.lambda || (!oscillates && !grows)) return nullptr;
  const std::optional<double>& error = oscillates ? mode.omega_error : mode.rate_error;
  if (!error) return nullptr;
  const double number = oscillates ? mode.omega : mode.rate;
  const Option* only = nullptr;
  for (const Option& option : options) {
    if (option.oscillates != oscillates || !agrees(values.value(option.root), number, *error)) continue;
    if (only != nullptr && only->root != option.root) return nullptr;
    only = &option;
  }
  return only;
}

/// Shapes have no stated error; theirs is far below this.
constexpr double shapes_agree = 1e-9;

bool has_shape(const Option& option, const Mode& mode, const ExactValues& values) {
  for (std::size_t i = 0; i < option.shape.size(); ++i) {
    const double formula = values.value(option.shape[i]).value;
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

/// The same mode with other relations put in; null where that has no form.
const LinearMode* same_mode(Derivation& derivation, double value) {
  for (const LinearMode& mode : derivation.modes()) {
    if (std::abs(derivation.value(mode) - value) > shapes_agree * std::abs(value)) continue;
    return derivation.form(mode) ? &mode : nullptr;
  }
  return nullptr;
}

/// Each mode in its shortest form: in all parameters, with the relations that are written, or with those that
/// the numbers satisfy, where these leave nothing but a number and the scene's units, and less than half.
std::vector<Option> options_of(Derivation& general, Derivation* related, Derivation* by_scale,
                               const ExactValues& values) {
  std::vector<Option> options;
  for (const LinearMode& mode : general.modes()) {
    const double value = general.value(mode);
    const std::optional<ClosedForm> plain = general.form(mode);
    std::size_t length = plain ? written_length(general.square(mode)) : longest_closed_form + 1;
    Derivation* chosen = plain ? &general : nullptr;
    const LinearMode* best = &mode;
    for (Derivation* other : {related, by_scale}) {
      const LinearMode* same = other == nullptr ? nullptr : same_mode(*other, value);
      if (same == nullptr) continue;
      const Expression square = other->square(*same);
      const std::size_t cost = written_length(square);
      const bool is_scaled = other == by_scale;
      if (is_scaled ? 2 * cost > length || !values.speaks_of_scales(square) : cost >= length) continue;
      length = cost;
      chosen = other;
      best = same;
    }
    if (chosen == nullptr) continue;
    options.push_back(chosen->option(*best));
    if (chosen != &general) options.back().form.general = plain;
  }
  return options;
}

/// What does not depend on the numbers, as far as signs and relations go.
struct Prepared {
  std::shared_ptr<Graph> graph;
  std::vector<Expression> x, place;
  std::vector<Option> options;
  std::vector<std::optional<ClosedForm>> state;
  ExactValues::Signs signs;  ///< of what the forms assume
};

Prepared prepared(const Dynamics& dynamics, const Statics& statics, const Reals& parameters,
                  const WrittenTexts& written, const Modes& found) {
  const LinearMotions motions =
      linear_motions(statics, momenta_vanish(dynamics, statics, parameters, found.y));
  Prepared result{motions.graph, motions.x, {}, {}, {}, {}};
  const ExactValues values(dynamics.model(), motions.graph, written, parameters);
  const PlaceProblem problem = place_problem(motions, statics, values, enclosed_state(found));
  const auto place = ExactPlace::of(problem);
  if (!place) return result;
  result.place = place->x();
  const Relations written_ones = relevant(values.relations(), motions);
  const Relations scaled = relevant(values.relations_by_scale(), motions);
  Derivation general(statics, motions, *place, values, {});
  std::optional<Derivation> related, by_scale;
  if (!written_ones.replacements.empty()) related.emplace(statics, motions, *place, values, written_ones);
  if (scaled.replacements.size() > written_ones.replacements.size())
    by_scale.emplace(statics, motions, *place, values, scaled);
  result.options =
      options_of(general, related ? &*related : nullptr, by_scale ? &*by_scale : nullptr, values);
  result.state.resize(dynamics.model().scene.coordinates.size());
  for (std::size_t k = 0; k < motions.x.size(); ++k)
    result.state[statics.reduction.kept[k]] = closed_form(values, place->x()[k], {});
  result.signs = values.asked();
  return result;
}

/// Nothing where the algebra grows too large, or divides by what vanishes.
Prepared prepared_or_nothing(const Dynamics& dynamics, const Statics& statics, const Reals& parameters,
                             const WrittenTexts& written, const Modes& found) {
  try {
    const WorkScope budget(most_algebra);
    return prepared(dynamics, statics, parameters, written, found);
  } catch (const Error&) {
    return {};
  }
}

/// What formulas depend on: signs of the parameters, which are given, and in which eighth of a turn the place
/// is.
std::string key_of(const Reals& parameters, const WrittenTexts& written, const Modes& found) {
  std::string key = "modes";
  for (const double p : parameters) key += p > 0 ? '+' : p < 0 ? '-' : '0';
  for (const auto& [name, text] : written) key += " " + name;
  for (std::size_t i = 0; i < found.y.size() / 2; ++i) {
    const double eighths = std::clamp(found.y[i] / (std::numbers::pi / 4), -5.0, 5.0);
    key += (std::abs(found.y[i]) <= found.y_error[i].value_or(0) ? " zero" : " ") +
           std::to_string(static_cast<int>(std::lround(2 * eighths)));
  }
  return key;
}

/// The forms are those of these numbers.
bool fits(const Prepared& forms, const std::vector<std::size_t>& kept, const ExactValues& values,
          const Modes& found) {
  if (!values.gives(forms.signs)) return false;
  for (std::size_t k = 0; k < forms.place.size(); ++k) {
    const double number = found.y[kept[k]];
    if (!(std::abs(values.value(forms.place[k]).value - number) <= 1e-9 * std::max(1.0, std::abs(number))))
      return false;
  }
  return true;
}

ExactModes chosen(const Prepared& forms, const std::vector<std::size_t>& kept, const ExactValues& values,
                  const Modes& found) {
  ExactModes result;
  result.modes.resize(found.modes.size());
  result.state.resize(found.y.size() / 2);
  if (forms.place.empty() || !fits(forms, kept, values, found)) return result;
  result.state = forms.state;
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    const Option* option = of_mode(forms.options, found.modes[i], values);
    if (option == nullptr) continue;
    result.modes[i] = option->form;
    if (has_shape(*option, found.modes[i], values)) continue;
    result.modes[i]->shape.clear();
    result.modes[i]->scaled_shape.clear();
  }
  return result;
}

}  // namespace

ExactModes exact_modes(const Dynamics& dynamics, const Reals& parameters, const WrittenTexts& all_written,
                       const Modes& found) {
  WrittenTexts written;  // where the search for a place began does not matter
  for (const Parameter& p : dynamics.model().scene.parameters) {
    if (const auto text = all_written.find(p.name); text != all_written.end()) written.insert(*text);
  }
  const auto statics = dynamics.statics(parameters);
  const std::vector<std::size_t>& kept = statics->reduction.kept;
  if (kept.size() > most_coordinates || !found.damping.empty()) {
    ExactModes none;
    none.modes.resize(found.modes.size());
    none.state.resize(found.y.size() / 2);
    return none;
  }
  const ExactValues values(dynamics.model(), parameters);
  const auto make = [&](const Statics& from) {
    return prepared_or_nothing(dynamics, from, parameters, written, found);
  };
  if (!values.may_have_relations(written)) {
    const auto forms = dynamics.derived<Prepared>(key_of(parameters, written, found), parameters, make);
    if (forms->place.empty() || fits(*forms, kept, values, found)) return chosen(*forms, kept, values, found);
  }
  return chosen(make(*statics), kept, values, found);
}

}  // namespace qdot
