#include "core/expr/surd.hpp"

#include <algorithm>

#include "core/expr/factored_form.hpp"
#include "core/expr/polynomial_gcd.hpp"

namespace qdot {
namespace {

const Polynomial constant_one{{Monomial{}, Number(1)}};

RationalFunction whole(const Polynomial& a) { return in_lowest_terms(a, constant_one); }

const Polynomial& radicand_of(const Surd& a, const Surd& b) { return a.is_rational() ? b.n : a.n; }

/// x = front * (u + v sqrt(n)), u and v polynomials without a common factor; `front` has a minus only before
/// a sum without one.
struct Parts {
  RationalFunction front;
  Polynomial u, v;
};

Parts parts_of(const Surd& x) {
  const RationalFunction above = in_lowest_terms(x.p.above, x.q.above);
  const RationalFunction below = in_lowest_terms(x.p.below, x.q.below);
  Parts parts{{}, above.above * below.below, above.below * below.above};
  const Number common = gcd(content(parts.u), content(parts.v));
  const Number front = parts.u.begin()->second.is_negative() ? -common : common;
  parts.u = scaled(parts.u, {}, Number(1) / front);
  parts.v = scaled(parts.v, {}, Number(1) / front);
  parts.front = x.p / whole(parts.u);
  const auto positive = [](const auto& term) { return !term.second.is_negative(); };
  const bool is_sum = std::ranges::all_of(parts.u, positive) && std::ranges::all_of(parts.v, positive);
  if (parts.front.above.begin()->second.is_negative() && !is_sum) {
    for (Polynomial* part : {&parts.u, &parts.v, &parts.front.above}) *part = scaled(*part, {}, Number(-1));
  }
  return parts;
}

Expression bracket(Graph& graph, const Parts& parts, const Expression& root) {
  return factored_form(graph, parts.u) + factored_form(graph, parts.v) * root;
}

/// above/below with its numbers: what is left of f^(1/2) when outside is taken out.
struct Rooted {
  RationalFunction outside, inside;
};

Rooted squares_taken_out(const RationalFunction& f, const SignOf& sign) {
  const SquareFactors above = square_factors(f.above), below = square_factors(f.below);
  Polynomial outside = above.outside, outside_below = below.outside;
  RationalFunction inside = in_lowest_terms(above.inside, below.inside);
  const int signs = sign(outside) * sign(outside_below);
  if (signs == 0) return {whole(constant_one), f};
  if (signs < 0) outside = scaled(outside, {}, Number(-1));
  if (sign(inside.below) < 0)
    inside = {scaled(inside.above, {}, Number(-1)), scaled(inside.below, {}, Number(-1))};
  return {in_lowest_terms(outside, outside_below), std::move(inside)};
}

/// Those of which all powers are whole; none where n is long.
std::vector<NodeId> symbols_to_divide_by(const Polynomial& n) {
  constexpr std::size_t most_terms = 40;
  std::vector<NodeId> found;
  if (n.size() > most_terms) return found;
  for (const auto& [monomial, coefficient] : n) {
    for (const Atom& atom : monomial) {
      if (atom.p < 0 || atom.q != 1) return {};
      if (std::ranges::find(found, atom.base) == found.end()) found.push_back(atom.base);
    }
  }
  return found;
}

/// 1/sqrt(x) rather than sqrt(1/x).
Expression root_of_quotient(Graph& graph, const RationalFunction& f, const Expression& factor) {
  if (f.above == constant_one && factor.is_one())
    return pow(factored_form(graph, f.below), Number::ratio(-1, 2));
  return sqrt(to_expression(graph, f) * factor);
}

}  // namespace

Surd operator+(const Surd& a, const Surd& b) { return {a.p + b.p, a.q + b.q, radicand_of(a, b)}; }
Surd operator-(const Surd& a) { return {-a.p, -a.q, a.n}; }
Surd operator-(const Surd& a, const Surd& b) { return a + -b; }

Surd operator*(const Surd& a, const Surd& b) {
  const Polynomial& n = radicand_of(a, b);
  if (a.is_rational()) return {a.p * b.p, a.p * b.q, n};
  if (b.is_rational()) return {a.p * b.p, a.q * b.p, n};
  return {a.p * b.p + a.q * b.q * whole(n), a.p * b.q + a.q * b.p, n};
}

Surd operator/(const Surd& a, const Surd& b) {
  if (b.is_rational()) return {a.p / b.p, a.q / b.p, a.n};
  const RationalFunction norm = b.p * b.p - b.q * b.q * whole(b.n);
  const Surd above = a * Surd(b.p, -b.q, b.n);
  return {above.p / norm, above.q / norm, above.n};
}

namespace {

/// k^(2/3) is a square, k^(1/3) is none. A sum keeps such factors: it is shorter with them.
void take_out_broken_powers(SquareFactors& factors) {
  if (factors.inside.size() != 1) return;
  Monomial outside;
  for (const Atom& atom : factors.inside.begin()->first) {
    if (atom.q != 1 && atom.p % 2 == 0) outside.push_back({atom.base, atom.p / 2, atom.q});
  }
  factors.outside = scaled(factors.outside, outside, Number(1));
  factors.inside = scaled(factors.inside, inverse(outside * outside), Number(1));
}

}  // namespace

Surd square_root(const RationalFunction& f) {
  if (f.is_zero()) return {};
  SquareFactors factors = square_factors(f.above * f.below);
  take_out_broken_powers(factors);
  const RationalFunction front = in_lowest_terms(factors.outside, f.below);
  if (factors.inside == constant_one) return front;
  return {{}, front, factors.inside};
}

std::vector<Surd> quadratic_roots(const RationalFunction& a, const RationalFunction& b,
                                  const RationalFunction& c) {
  if (a.is_zero()) return b.is_zero() ? std::vector<Surd>{} : std::vector<Surd>{-c / b};
  const RationalFunction half = b / (whole(scaled(constant_one, {}, Number(-2))) * a);
  const Surd root = square_root(half * half - c / a);
  return {Surd(half) - root, Surd(half) + root};
}

Expression root_form(Graph& graph, const Polynomial& n) {
  Expression best = factored_form(graph, n);
  for (const NodeId x : symbols_to_divide_by(n)) {
    const Polynomial shared = content_in(n, x);
    const auto rest = shared.size() > 1 ? exact_quotient(n, shared) : std::nullopt;
    if (!rest) continue;
    const Expression product = factored_form(graph, shared) * factored_form(graph, *rest);
    if (written_length(product) < written_length(best)) best = product;
  }
  return sqrt(best);
}

Expression to_expression(Graph& graph, const Surd& x) {
  return to_expression(graph, x, x.is_rational() ? graph.number(0) : root_form(graph, x.n));
}

Expression to_expression(Graph& graph, const Surd& x, const Expression& root) {
  if (x.is_rational()) return to_expression(graph, x.p);
  if (x.p.is_zero()) return to_expression(graph, x.q) * root;
  const Parts parts = parts_of(x);
  const Expression product = to_expression(graph, parts.front) * bracket(graph, parts, root);
  const Expression sum = to_expression(graph, x.p) + to_expression(graph, x.q) * root;
  return written_length(sum) < written_length(product) ? sum : product;
}

Expression plain_expression(Graph& graph, const Surd& x) {
  const auto plain = [&](const RationalFunction& f) {
    return to_expression(graph, f.above) / to_expression(graph, f.below);
  };
  return x.is_rational() ? plain(x.p) : plain(x.p) + plain(x.q) * sqrt(to_expression(graph, x.n));
}

Expression positive_root(Graph& graph, const RationalFunction& x, const SignOf& sign) {
  if (x.is_zero()) return graph.number(0);
  const Rooted rooted = squares_taken_out(x, sign);
  return to_expression(graph, rooted.outside) * root_of_quotient(graph, rooted.inside, graph.number(1));
}

Expression positive_root(Graph& graph, const Surd& x, const Expression& root, const SignOf& sign) {
  if (x.is_rational()) return positive_root(graph, x.p, sign);
  if (x.p.is_zero()) return sqrt(to_expression(graph, x, root));
  const Parts parts = parts_of(x);
  const Rooted rooted = squares_taken_out(parts.front, sign);
  return to_expression(graph, rooted.outside) *
         root_of_quotient(graph, rooted.inside, bracket(graph, parts, root));
}

}  // namespace qdot
