#include "core/grading/changed_terms.hpp"

#include <array>
#include <map>

#include "core/expr/calculus.hpp"

namespace qdot {
namespace {

bool is_wave(const Call& call) { return call.function == Function::sin || call.function == Function::cos; }

Function other(Function function) { return function == Function::sin ? Function::cos : Function::sin; }

/// The sines and cosines in e.
std::vector<Expression> waves_in(const Expression& e) {
  std::vector<Expression> waves;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(e.graph(), root)) {
    const auto* call = std::get_if<Call>(&e.graph().node(id));
    if (call != nullptr && is_wave(*call)) waves.emplace_back(e.graph(), id);
  }
  return waves;
}

Expression with(const Expression& e, const Expression& from, const Expression& to) {
  const std::array replacement{Replacement{from, to}};
  return substitute(e, replacement);
}

/// u with the sign of one of its terms turned, twice and half of it, and other symbols in its place.
std::vector<Expression> other_arguments(const Expression& u, std::span<const Expression> symbols) {
  std::vector<Expression> others{Number(2) * u, Number::ratio(1, 2) * u};
  if (const auto* sum = std::get_if<Sum>(&u.node())) {
    for (const NodeId id : std::vector(sum->terms)) {
      const Expression term(u.graph(), id);
      others.push_back(u - Number(2) * term);
      others.push_back(term);
    }
  }
  for (const Expression& symbol : symbols) {
    if (!(symbol == u)) others.push_back(symbol);
  }
  return others;
}

Expression waves_changed(const Expression& e, const std::vector<Expression>& to) {
  const std::vector<Expression> from = waves_in(e);
  std::vector<Replacement> replacements;
  for (std::size_t i = 0; i < from.size(); ++i) replacements.emplace_back(from[i], to[i]);
  return substitute(e, replacements);
}

}  // namespace

std::vector<ChangedTerm> changes_of_term(const Expression& term, std::span<const Expression> symbols) {
  std::vector<ChangedTerm> changes;
  const auto add = [&](Slip slip, const Expression& to) {
    if (!(to == term)) changes.push_back({slip, to - term, to});
  };
  const NodeId root[]{term.id()};
  for (const NodeId id : reachable(term.graph(), root)) {
    if (!std::holds_alternative<Symbol>(term.graph().node(id))) continue;
    const Expression symbol(term.graph(), id);
    for (const int step : {1, -1, 2, -2}) add(Slip::exponent, term * pow(symbol, Number(step)));
  }
  for (const Expression& wave : waves_in(term)) {
    const Call call = std::get<Call>(wave.node());
    const Expression argument(term.graph(), call.argument);
    const Expression swapped = with(term, wave, term.graph().call(other(call.function), argument));
    add(Slip::sine_and_cosine, swapped);
    // cos(a - b) is cos(b - a), whose sine is another.
    if (std::holds_alternative<Sum>(argument.node())) add(Slip::sine_and_cosine, -swapped);
    add(Slip::exponent, term * wave);
    add(Slip::exponent, term / wave);
    for (const Expression& u : other_arguments(argument, symbols))
      add(Slip::argument, with(term, wave, term.graph().call(call.function, u)));
  }
  return changes;
}

std::vector<ChangedTerm> changes_of_whole(const Expression& e, const std::optional<Expression>& gravity) {
  std::vector<ChangedTerm> changes;
  const auto add = [&](Slip slip, const Expression& to) {
    if (!(to == e)) changes.push_back({slip, to - e, std::nullopt});
  };
  Graph& graph = e.graph();
  std::vector<Expression> small, swapped;
  for (const Expression& wave : waves_in(e)) {
    const Call call = std::get<Call>(wave.node());
    const Expression argument(graph, call.argument);
    small.push_back(call.function == Function::sin ? argument : graph.number(1));
    swapped.push_back(graph.call(other(call.function), argument));
  }
  if (gravity && depends_on(e, *gravity)) add(Slip::gravity, with(e, *gravity, -*gravity));
  add(Slip::small_angles, waves_changed(e, small));
  add(Slip::sine_and_cosine, waves_changed(e, swapped));
  return changes;
}

std::vector<ChangedTerm> changes_by_cancelled(const Expression& term, std::span<const Expression> symbols) {
  std::vector<ChangedTerm> changes;
  for (const Expression& symbol : symbols) {
    if (depends_on(term, symbol)) continue;
    for (const int step : {1, -1}) {
      const Expression to = term * pow(symbol, Number(step));
      changes.push_back({Slip::exponent, to - term, to});
    }
  }
  return changes;
}

}  // namespace qdot
