#include "core/symmetry/symmetry_shape.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace qdot {

Expression leading(const Symmetry& symmetry) {
  return *std::find_if(symmetry.coefficients.rbegin(), symmetry.coefficients.rend(),
                       [](const Expression& e) { return !e.is_zero(); });
}

std::optional<std::size_t> only_turn(const SymmetrySearch& search, const Symmetry& symmetry) {
  std::optional<std::size_t> turn;
  for (std::size_t k = 0; k < symmetry.coefficients.size(); ++k) {
    const ChangeKind here = search.changes[k].kind;
    if (symmetry.coefficients[k].is_zero() || here == ChangeKind::gauge || here == ChangeKind::shift)
      continue;
    if (turn || (here != ChangeKind::turn && here != ChangeKind::own_turn)) return std::nullopt;
    turn = k;
  }
  return turn;
}

bool is_only(const SymmetrySearch& search, const Symmetry& symmetry, ChangeKind kind) {
  for (std::size_t k = 0; k < symmetry.coefficients.size(); ++k) {
    const ChangeKind here = search.changes[k].kind;
    if (!symmetry.coefficients[k].is_zero() && here != ChangeKind::gauge && here != kind) return false;
  }
  return true;
}

bool moves_along(const SymmetrySearch& search, const Symmetry& symmetry) {
  std::vector<bool> turns(symmetry.change.shift.size());
  for (std::size_t k = 0; k < symmetry.coefficients.size(); ++k) {
    const ElementaryChange& change = search.changes[k];
    if (!symmetry.coefficients[k].is_zero() && change.kind == ChangeKind::linear) turns[change.i] = true;
  }
  for (std::size_t k = 0; k < symmetry.coefficients.size(); ++k) {
    const ElementaryChange& change = search.changes[k];
    if (!symmetry.coefficients[k].is_zero() && change.kind == ChangeKind::shift && !turns[change.i])
      return true;
  }
  return false;
}

bool is_turning(const SymmetrySearch& search, const Symmetry& symmetry) {
  std::map<std::pair<std::size_t, std::size_t>, Expression> linear;
  for (std::size_t k = 0; k < symmetry.coefficients.size(); ++k) {
    const ElementaryChange& change = search.changes[k];
    if (symmetry.coefficients[k].is_zero()) continue;
    if (change.kind == ChangeKind::boost) return false;
    if (change.kind == ChangeKind::linear) linear[{change.i, change.j}] = symmetry.coefficients[k];
  }
  return std::ranges::all_of(linear, [&](const auto& entry) {
    const auto other = linear.find({entry.first.second, entry.first.first});
    return other != linear.end() && (entry.second + other->second).is_zero();
  });
}

std::pair<KindOfChange, std::size_t> kind_of(const SymmetrySearch& search, const Symmetry& symmetry) {
  if (!symmetry.change.time.is_zero()) return {KindOfChange::in_time, 0};
  std::vector<std::size_t> partners(symmetry.change.shift.size());
  std::size_t spread = 0;
  for (std::size_t k = 0; k < symmetry.coefficients.size(); ++k) {
    const ElementaryChange& change = search.changes[k];
    if (change.kind != ChangeKind::linear || symmetry.coefficients[k].is_zero()) continue;
    ++partners[change.i];
    spread += change.i > change.j ? change.i - change.j : change.j - change.i;
  }
  if (only_turn(search, symmetry)) return {KindOfChange::in_space, 0};
  const auto is_constrained = [&](std::size_t k) {
    const ChangeKind kind = search.changes[k].kind;
    const bool is_affine = kind < ChangeKind::along || kind > ChangeKind::own_turn;
    return !is_affine && !symmetry.coefficients[k].is_zero();
  };
  for (std::size_t k = 0; k < symmetry.coefficients.size(); ++k) {
    if (is_constrained(k)) return {KindOfChange::mixed, 0};
  }
  const auto most = std::ranges::max(partners);
  return {most == 0   ? KindOfChange::linear
          : most == 1 ? KindOfChange::rotation
                      : KindOfChange::mixed,
          spread};
}

}  // namespace qdot
