#include "core/closed/mode_derivation.hpp"

#include <algorithm>
#include <cmath>

#include "core/closed/exact_roots.hpp"
#include "core/closed/taken_squares.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/notation.hpp"

namespace qdot {
namespace {

bool is_number(const Expression& e) {
  const NodeId root = e.id();
  return std::ranges::none_of(reachable(e.graph(), {&root, 1}),
                              [&](NodeId id) { return std::holds_alternative<Symbol>(e.graph().node(id)); });
}

bool has_calls(const Expression& e) {
  const NodeId root = e.id();
  return std::ranges::any_of(reachable(e.graph(), {&root, 1}),
                             [&](NodeId id) { return std::holds_alternative<Call>(e.graph().node(id)); });
}

/// The shape with 1 as its first component that is not 0.
std::vector<Surd> normalized(std::vector<Surd> shape) {
  const auto first = std::ranges::find_if_not(shape, [](const Surd& x) { return x.is_zero(); });
  if (first == shape.end()) return {};
  const Surd unit = *first;
  for (Surd& component : shape) {
    if (!component.is_zero()) component = component / unit;
  }
  return shape;
}

void add(const std::vector<std::string>& conditions, ClosedForm& form) {
  form.assumes.insert(form.assumes.end(), conditions.begin(), conditions.end());
}

/// Symbols that may have any value.
std::vector<Expression> given_at(const LinearMotions& motions, const ExactPlace& place) {
  std::vector<Expression> given = place.undecided();
  given.insert(given.end(), motions.momenta.begin(), motions.momenta.end());
  return given;
}

}  // namespace

ModeDerivation::ModeDerivation(const LinearMotions& motions, const ExactPlace& place,
                               const ExactValues& values, const Relations& relations)
    : motions_(motions),
      place_(place),
      values_(values),
      relations_(relations),
      graph_(*motions.graph),
      given_(given_at(motions, place)),
      signs_(values, relations_, given_),
      modes_(modes_at(motions, place, relations.replacements)) {
  std::erase_if(modes_, [&](const LinearMode& mode) {
    return (mode.lambda.is_zero() && mode.decay.is_zero()) || !is_true(mode);
  });
  for (const Expression& x : place.x()) signs_.ask_for_value_of(x);
}

double ModeDerivation::value(const LinearMode& mode) const {
  return values_.value(plain_expression(graph_, mode.lambda)).value;
}

std::optional<ClosedForm> ModeDerivation::formula(const Expression& e) const {
  auto form = closed_form(values_, e, relations_, given_);
  if (form) assume_signs(*form, values_, e, given_);
  return form;
}

bool ModeDerivation::oscillates(const LinearMode& mode) const {
  return values_.sign(plain_expression(graph_, mode.lambda)) > 0;
}

Expression ModeDerivation::square(const LinearMode& mode) {
  return written(oscillates(mode) ? mode.lambda : -mode.lambda);
}

std::optional<ClosedForm> ModeDerivation::form(const LinearMode& mode) { return formula(square(mode)); }

ModeForms ModeDerivation::forms(const LinearMode& mode) {
  const bool is_oscillation = oscillates(mode);
  const Surd square = is_oscillation ? mode.lambda : -mode.lambda;
  ModeForms result{sqrt(plain_expression(graph_, square)), is_oscillation, {.square = *form(mode)}, {}, {}};
  const Expression rate = root(square);
  result.form.rate = formula(rate);
  if (is_oscillation) result.form.period = period(square);
  take_root_as_written(square, result);
  result.form.lambda = scaled_lambda(mode.lambda);
  add_shape(mode, result);
  add_signs_of_place(result.form);
  const std::vector<std::string> conditions = needed(mode, {rate});
  if (!conditions.empty()) {
    ClosedForm of_lambda = result.form.square;
    add(needed(mode, {}), of_lambda);
    result.form.lambda_assumes = of_lambda.assumes;
  }
  add_conditions(conditions, result.form);
  return result;
}

ClosedForm ModeDerivation::with_signs(const LinearMode& mode, ClosedForm form) {
  add_signs_of_place(form);
  add(needed(mode, {sqrt(square(mode))}), form);
  return form;
}

/// What has to be assumed for the mode's equations to hold and for these to be positive.
std::vector<std::string> ModeDerivation::needed(const LinearMode& mode,
                                                const std::vector<Expression>& positive) {
  if (!signs_.are_there()) return {};
  Trial trial = claims(mode);
  for (const Expression& e : positive) trial.is_positive(e);
  return signs_.needed_for(trial);
}

/// Of parameters that a form does not speak of; nothing where the place is the same whatever their signs.
void ModeDerivation::add_signs_of_place(ClosedForm& form) {
  if (!signs_of_place_) signs_of_place_ = signs_.signs_needed_for(claims_of_place());
  for (const std::string& sign : *signs_of_place_) {
    if (std::ranges::find(form.assumes, sign) == form.assumes.end()) form.assumes.push_back(sign);
  }
}

void ModeDerivation::add_signs_of_place(ExactMode& form) {
  for_each_form(form, [&](ClosedForm& f) { add_signs_of_place(f); });
}

/// Where the square has roots, they are joined in it already.
void ModeDerivation::take_root_as_written(const Surd& square, ModeForms& result) {
  if (!square.is_rational()) return;
  const Expression short_square = short_form(values_, written(square));
  if (!has_roots(short_square) && result.form.rate) return;
  const auto take = [](std::optional<ClosedForm>& form, std::optional<ClosedForm> other) {
    if (other && (!form || other->text.size() < form->text.size())) form = std::move(other);
  };
  take(result.form.rate, formula(sqrt(short_square)));
  if (result.oscillates)
    take(result.form.period, formula(Number(2) * graph_.symbol("pi") / sqrt(short_square)));
}

void ModeDerivation::add_shape(const LinearMode& mode, ModeForms& result) {
  const std::vector<Surd> shape = whole_shape(mode);
  for (const Surd& component : shape) result.shape.push_back(plain_expression(graph_, component));
  result.form.shape = closed_forms(shape);
  if (!shape.empty()) result.form.scaled_shape = closed_forms(scaled(shape));
}

std::vector<ModeForms> ModeDerivation::damped_forms(const LinearMode& mode) {
  const Number half = Number::ratio(1, 2);
  const Expression rate = simplify(half * written(mode.decay)), stiffness = written(mode.lambda);
  const Expression square = stiffness - pow(rate, Number(2));
  std::vector<std::optional<ModeForms>> found;
  if (mode.lambda.is_zero()) {
    found.push_back(creeping(written(mode.decay)));
  } else if (const int sign = values_.sign(square); sign > 0) {
    found.push_back(swinging(square, rate));
  } else if (sign < 0) {
    for (const int side : {1, -1}) found.push_back(creeping(rate + Number(side) * sqrt(-square)));
  } else if (vanishes(square, stiffness)) {
    found.push_back(critically_damped(stiffness, rate));
  }
  std::vector<ModeForms> result;
  for (auto& forms : found) {
    if (!forms) continue;
    add_shape(mode, *forms);
    add_signs_of_place(forms->form);
    const Expression damping = values_.sign(*forms->decay) < 0 ? -*forms->decay : *forms->decay;
    add_conditions(needed(mode, {forms->root, damping}), forms->form);
    result.push_back(*std::move(forms));
  }
  return result;
}

/// -decay +- i omega.
std::optional<ModeForms> ModeDerivation::swinging(const Expression& square, const Expression& decay) {
  const int sign = values_.sign(decay);
  const Expression omega = sqrt(square);
  const auto of_square = formula(square), of_omega = formula(omega),
             of_rate = formula(sign < 0 ? -decay : decay);
  if (sign == 0 || !of_square || !of_omega || !of_rate) return std::nullopt;
  return ModeForms{omega, true, {.square = *of_square, .rate = of_omega, .damping = of_rate}, {}, decay};
}

/// Of what is 0 to twice the digits of a double, beside the size of something.
bool ModeDerivation::vanishes(const Expression& e, const Expression& size) const {
  constexpr double sharp = 1e-24;
  const Real value = values_.value(e);
  return value.is_finite() &&
         std::abs(value.value) + value.error <= sharp * std::abs(values_.value(size).value);
}

/// Both rates are one. Where only the numbers say so, that is assumed.
std::optional<ModeForms> ModeDerivation::critically_damped(const Expression& stiffness,
                                                           const Expression& rate) {
  auto forms = creeping(rate);
  const Expression square = pow(rate, Number(2));
  if (forms && !rational_function(stiffness - square).is_zero()) {
    const Notation notation = notation_of(values_.model().scene);
    forms->form.square.assumes.push_back(print(stiffness, Form::text, notation) + " = " +
                                         print(square, Form::text, notation));
  }
  return forms;
}

std::optional<ModeForms> ModeDerivation::creeping(const Expression& decay) {
  const int sign = values_.sign(decay);
  const Expression size = sign < 0 ? -decay : decay;
  const auto form = formula(size);
  if (sign == 0 || !form) return std::nullopt;
  return ModeForms{size, false, {.square = *form, .creeps = true}, {}, decay};
}

Expression ModeDerivation::root_of(const Polynomial& n) {
  const auto found = std::ranges::find(roots_, n, &std::pair<Polynomial, Expression>::first);
  if (found != roots_.end()) return found->second;
  roots_.emplace_back(n, shortest_root(graph_, modes_, n));
  return roots_.back().second;
}

Expression ModeDerivation::written(const Surd& x) {
  if (!x.is_rational()) return to_expression(graph_, x, root_of(x.n));
  const Expression plain = to_expression(graph_, x.p), joined = simplify(plain);
  const Expression& best = written_length(joined) < written_length(plain) ? joined : plain;
  if (!has_calls(best)) return best;
  const Expression by_angles = shortest_quotient(to_expression(graph_, x.p.above),
                                                 to_expression(graph_, x.p.below), values_.sign_of());
  return written_length(by_angles) < written_length(best) ? by_angles : best;
}

Expression ModeDerivation::root(const Surd& x) {
  if (x.is_rational()) {
    const Expression plain = positive_root(graph_, x.p, values_.sign_of());
    if (!has_calls(plain)) return plain;
    const Expression by_angles = sqrt(written(x));
    return written_length(by_angles) < written_length(plain) ? by_angles : plain;
  }
  const Expression nested = positive_root(graph_, x, root_of(x.n), values_.sign_of());
  const auto sum = sum_of_roots(x);
  return sum && written_length(*sum) < written_length(nested) ? *sum : nested;
}

/// sqrt(p + q sqrt(n)) = sqrt(a) +- sqrt(b) with a, b = (p +- s)/2, where p^2 - q^2 n = s^2: the slow and the
/// fast precession of a sleeping top.
std::optional<Expression> ModeDerivation::sum_of_roots(const Surd& x) {
  const RationalFunction n{x.n};
  const Surd s = square_root(x.p * x.p - x.q * x.q * n);
  if (!s.is_rational()) return std::nullopt;
  const RationalFunction half{{{Monomial{}, Number::ratio(1, 2)}}};
  const auto sign = [&](const RationalFunction& f) { return values_.sign(f.above) * values_.sign(f.below); };
  const int larger = sign(s.p);
  if (larger == 0) return std::nullopt;
  const RationalFunction a = half * (larger < 0 ? x.p - s.p : x.p + s.p), b = x.p - a;
  if (sign(b) <= 0) return std::nullopt;
  const Surd first = square_root(a), second = square_root(b);
  if (first.is_rational() == second.is_rational()) return std::nullopt;
  const auto front = [&](const Surd& root) { return sign(root.is_rational() ? root.p : root.q); };
  const int of_first = front(first), of_second = front(second) * sign(x.q);
  if (of_first == 0 || of_second == 0) return std::nullopt;
  const Surd sum = (of_first < 0 ? -first : first) + (of_second < 0 ? -second : second);
  return to_expression(graph_, sum, root_of(sum.n));
}

/// The equations hold at other values of the parameters, too.
bool ModeDerivation::is_true(const LinearMode& mode) const { return claims(mode).passes(); }

Trial ModeDerivation::claims_of_place() const {
  Trial trial(values_, relations_);
  trial.set_given(given_);
  trial.set(motions_.x, place_.x());
  for (const auto* vanishing : {&motions_.forces, &motions_.surface}) {
    for (const Expression& e : *vanishing) trial.vanishes({e});
  }
  for (const auto& [e, there] : motions_.taken) trial.vanishes({e, -there});
  return trial;
}

Trial ModeDerivation::claims(const LinearMode& mode) const {
  Trial trial = claims_of_place();
  const Expression lambda = plain_expression(graph_, mode.lambda);
  const std::size_t size = motions_.mass.size();
  if (mode.shape.empty() && mode.group.size() == 2) {
    trial.vanishes(characteristic_terms(mode.group[0], mode.group[1], lambda));
    return trial;
  }
  if (mode.shape.empty()) {
    Matrix characteristic = motions_.stiffness;
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j)
        characteristic[i][j] = characteristic[i][j] - lambda * motions_.mass[i][j];
    }
    trial.is_singular(std::move(characteristic));
    return trial;
  }
  const Expression decay = plain_expression(graph_, mode.decay);
  for (std::size_t i = 0; i < size; ++i) {
    std::vector<Expression> terms, friction;
    for (std::size_t j = 0; j < size; ++j) {
      if (mode.shape[j].is_zero()) continue;
      const Expression v = plain_expression(graph_, mode.shape[j]);
      terms.push_back(motions_.stiffness[i][j] * v);
      terms.push_back(-(motions_.mass[i][j] * lambda * v));
      friction.push_back(motions_.damping[i][j] * v);
      friction.push_back(-(motions_.mass[i][j] * decay * v));
    }
    trial.vanishes(std::move(terms));
    trial.vanishes(std::move(friction));
  }
  return trial;
}

/// The terms of det(K - lambda M), and those that gyroscopic forces add to it.
std::vector<Expression> ModeDerivation::characteristic_terms(std::size_t i, std::size_t j,
                                                             const Expression& lambda) const {
  const Matrix &m = motions_.mass, &d = motions_.damping, &k = motions_.stiffness;
  return {k[i][i] * k[j][j], -(k[i][j] * k[j][i]),
          lambda * (m[i][j] * k[j][i] + m[j][i] * k[i][j] - m[i][i] * k[j][j] - m[j][j] * k[i][i]),
          lambda * d[i][j] * d[j][i], lambda * lambda * (m[i][i] * m[j][j] - m[i][j] * m[j][i])};
}

std::optional<ClosedForm> ModeDerivation::period(const Surd& square) {
  const Surd inverse = Surd(rational_function(graph_.number(1))) / square;
  return formula(Number(2) * graph_.symbol("pi") * root(inverse));
}

std::optional<ClosedForm> ModeDerivation::scaled_lambda(const Surd& lambda) {
  if (!values_.model().parsed.scales) return std::nullopt;
  const Expression time = graph_.adopt(values_.model().parsed.scales->time);
  const Expression square = substitute(pow(time, Number(2)), relations_.replacements);
  const Expression value = written(lambda * Surd(rational_function(square)));
  return is_number(value) ? formula(value) : std::nullopt;
}

/// The shape in all coordinates: those that are ignored follow by their velocities, where no momentum holds
/// them.
std::vector<Surd> ModeDerivation::whole_shape(const LinearMode& mode) const {
  if (mode.shape.empty()) return {};
  std::vector<Surd> shape(values_.model().scene.coordinates.size());
  const auto entry = [&](const Expression& e) {
    return rational_function(substitute(place_.at(e), relations_.replacements));
  };
  for (std::size_t k = 0; k < mode.shape.size(); ++k) shape[motions_.moving[k]] = mode.shape[k];
  for (std::size_t c = 0; c < motions_.following_rates.size(); ++c) {
    Surd sum;
    for (std::size_t j = 0; j < mode.shape.size(); ++j) {
      if (!entry(motions_.following_slopes[c][j]).is_zero()) return {};
      if (!mode.shape[j].is_zero()) sum = sum + Surd(entry(motions_.following_rates[c][j])) * mode.shape[j];
    }
    shape[motions_.following[c]] = sum;
  }
  return normalized(std::move(shape));
}

/// The shape with angles as arcs; empty where coordinates have no common unit even then.
std::vector<Surd> ModeDerivation::scaled(std::vector<Surd> shape) const {
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

/// The closed forms of all components; none at all where one has none.
std::vector<ClosedForm> ModeDerivation::closed_forms(const std::vector<Surd>& shape) {
  std::vector<ClosedForm> result;
  for (const Surd& component : shape) {
    auto form = formula(written(component));
    if (!form) return {};
    result.push_back(*std::move(form));
  }
  return result;
}

}  // namespace qdot
