#include "core/closed/exact_place.hpp"

#include <algorithm>

#include "core/closed/place_algebra.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/special_angles.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {

std::vector<Expression> ExactPlace::undecided() const {
  std::vector<Expression> found;
  for (std::size_t k = 0; k < x_.size(); ++k) {
    if (!is_known(k)) found.push_back(x_[k]);
  }
  return found;
}

void ExactPlace::settle(std::size_t k, const Expression& value) {
  const Replacement now{problem_->x[k], value};
  const auto renew = [&](Expression& e) {
    if (depends_on(e, now.first)) e = to_expression(e.graph(), rational_function(substitute(e, {&now, 1})));
  };
  x_[k] = value;
  for (Expression& e : x_) renew(e);
  for (Replacement& known : replacements_) renew(known.second);
  for (Solved& angle : solved_) {
    renew(angle.value);
    if (angle.other_value) renew(*angle.other_value);
  }
  replacements_.push_back(now);
}

void ExactPlace::settle(std::size_t k, const Expression& value, Powered power) {
  powers_.push_back(std::move(power));
  settle_root(k, value);
}

void ExactPlace::settle(std::size_t k, const Expression& value, Solved angle) {
  solved_.push_back(std::move(angle));
  settle_root(k, value);
}

/// Others that are known by it are written with it; expressions are not.
void ExactPlace::settle_root(std::size_t k, const Expression& value) {
  const Replacement now{problem_->x[k], value};
  for (Expression& e : x_) e = substitute(e, {&now, 1});
}

namespace {

/// The next integer that is not above it.
std::optional<Number> whole_part(const Number& x) {
  const auto small = x.small();
  if (!small) return std::nullopt;
  const std::int64_t p = small->numerator, q = small->denominator;
  return Number(p / q - (p % q < 0 ? 1 : 0));
}

}  // namespace

/// x^(n k + r) = value^k x^r, and then x itself.
Expression ExactPlace::with_powers_taken(const Expression& e) const {
  if (powers_.empty()) return e;
  Graph& graph = e.graph();
  const auto multiplied = [&](const Expression& x) {
    const RationalFunction f = rational_function(x);
    return to_expression(graph, f.above) / to_expression(graph, f.below);
  };
  Expression result = multiplied(e);
  std::vector<Replacement> taken, roots;
  const NodeId root[]{result.id()};
  for (const NodeId id : reachable(graph, root)) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr) continue;
    const auto known = std::ranges::find(powers_, power->base, [](const Powered& p) { return p.x.id(); });
    if (known == powers_.end()) continue;
    const auto times = whole_part(power->exponent / known->n);
    if (!times || (known->n.is_integer() && !power->exponent.is_integer())) continue;
    taken.emplace_back(Expression(graph, id),
                       pow(known->value, *times) * pow(known->x, power->exponent - *times * known->n));
  }
  result = multiplied(substitute(result, taken));
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const auto is_k = [&](const Powered& p) { return p.x == problem_->x[k]; };
    if (std::ranges::any_of(powers_, is_k)) roots.emplace_back(problem_->x[k], x_[k]);
  }
  return substitute(result, roots);
}

/// cos(x)^n by what is known, and the other one's even powers by 1 - value^2 where it is not.
Polynomial ExactPlace::with_angles_taken(const Polynomial& e, const Solved& angle) const {
  Graph& graph = angle.value.graph();
  Polynomial next;
  for (const auto& [monomial, coefficient] : e) {
    const int known = exponent_of(monomial, angle.known.id()),
              other = exponent_of(monomial, angle.other.id());
    const int replaced = angle.other_value ? other : other - other % 2;
    const Monomial rest = times(times(monomial, angle.known.id(), -known), angle.other.id(), -replaced);
    const Expression square = graph.number(1) - angle.value * angle.value;
    const Expression factor =
        pow(angle.value, Number(known)) *
        (angle.other_value ? pow(*angle.other_value, Number(other)) : pow(square, Number(other / 2)));
    add(next, scaled(multiplied_out(factor), rest, coefficient));
  }
  return next;
}

Expression ExactPlace::at(const Expression& e) const {
  Expression known = e;
  for (const KnownBracket& bracket : brackets_) {
    const std::span before(replacements_.data(), bracket.settled);
    known = with_bracket_taken(substitute(known, before), bracket.power, problem_->sign);
  }
  const Expression there = with_logarithms_taken(with_special_angles(substitute(known, replacements_)));
  const Expression signed_there = with_roots_taken(with_sizes_taken(there, problem_->sign), problem_->sign);
  Expression result = with_roots_taken(with_powers_taken(signed_there), problem_->sign);
  if (solved_.empty()) return result;
  Graph& graph = e.graph();
  Polynomial opened = with_single_angles(graph, multiplied_out(with_tangents_written(result)));
  for (const Solved& angle : solved_) opened = with_angles_taken(opened, angle);
  return with_solved_angles(to_expression(graph, opened));
}

/// An angle that stands outside sines and cosines, as in exp(-b x).
Expression ExactPlace::with_solved_angles(const Expression& e) const {
  std::vector<Replacement> angles;
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const auto is_k = [&](const Solved& solved) { return depends_on(solved.known, problem_->x[k]); };
    if (std::ranges::any_of(solved_, is_k)) angles.emplace_back(problem_->x[k], x_[k]);
  }
  return substitute(e, angles);
}

}  // namespace qdot
