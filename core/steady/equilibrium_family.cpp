#include "core/steady/equilibrium_family.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/dense_matrix.hpp"
#include "core/steady/solved_slopes.hpp"
#include "core/steady/symmetric_changes.hpp"

namespace qdot {
namespace {

using Balls = std::vector<Ball>;

/// Of a coordinate's size.
constexpr double settled_within = 1e-9;

BallMatrix changes_at(const CompiledFunction& changes, std::span<const Ball> constants, const Balls& x) {
  Balls all(changes.outputs());
  TapeEvaluator<Ball>(changes, constants)(x, all);
  BallMatrix rows;
  for (auto row = all.begin(); row != all.end(); row += static_cast<std::ptrdiff_t>(x.size()))
    rows.emplace_back(row, row + static_cast<std::ptrdiff_t>(x.size()));
  return rows;
}

/// Entries in the coordinates' sizes, the largest of each row 1. Of a change that stops at this place, as a
/// turn about it, rounding leaves something, which is 0 here.
std::vector<std::vector<double>> compared(const CompiledFunction& changes, std::span<const Ball> constants,
                                          const NearlyEquilibrium& near) {
  Balls x(near.x.begin(), near.x.end());
  const BallMatrix rows = changes_at(changes, constants, x);
  for (std::size_t i = 0; i < x.size(); ++i) x[i].radius = settled_within * near.sizes[i];
  const BallMatrix around = changes_at(changes, constants, x);
  std::vector<std::vector<double>> result;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool stops = std::ranges::all_of(around[k], &Ball::contains_zero);
    std::vector<double> entries;
    for (std::size_t i = 0; i < x.size(); ++i)
      entries.push_back(stops ? 0 : rows[k][i].value() / near.sizes[i]);
    double largest = 0;
    for (const double entry : entries) largest = std::max(largest, std::abs(entry));
    if (!std::isfinite(largest)) return {};
    for (double& entry : entries) entry = largest > 0 ? entry / largest : 0;
    result.push_back(std::move(entries));
  }
  return result;
}

/// BallMatrix of changes that are independent, and as many columns P that show it.
struct Independent {
  std::vector<std::size_t> rows, columns;
};

/// The place of the largest entry, or in a column before it, so that coordinates in front are kept, of one
/// that is nearly as large.
std::pair<std::size_t, std::size_t> pivot_of(const std::vector<std::vector<double>>& entries) {
  constexpr double nearly = 0.25;
  double largest = 0;
  for (const auto& row : entries) {
    for (const double entry : row) largest = std::max(largest, std::abs(entry));
  }
  const std::size_t columns = entries[0].size();
  for (std::size_t column = 0; column < columns && largest > settled_within; ++column) {
    for (std::size_t row = 0; row < entries.size(); ++row)
      if (std::abs(entries[row][column]) > nearly * largest) return {row, column};
  }
  return {0, columns};
}

/// By elimination.
Independent independent(std::vector<std::vector<double>> entries) {
  Independent result;
  while (result.rows.size() < entries.size()) {
    const auto [k, i] = pivot_of(entries);
    const std::vector<double> pivot = entries[k];
    if (i == pivot.size()) break;
    result.rows.push_back(k);
    result.columns.push_back(i);
    for (std::vector<double>& row : entries) {
      const double factor = row[i] / pivot[i];
      for (std::size_t column = 0; column < row.size(); ++column) row[column] -= factor * pivot[column];
      row[i] = 0;
    }
  }
  return result;
}

/// Whether what `columns` have of the rows has an inverse, all over the enclosures.
bool are_independent(BallMatrix rows, const std::vector<std::size_t>& columns) {
  for (std::size_t done = 0; done < columns.size(); ++done) {
    const std::size_t i = columns[done];
    if (!rows[done][i].is_finite() || rows[done][i].contains_zero()) return false;
    for (std::size_t other = done + 1; other < rows.size(); ++other) {
      const Ball factor = rows[other][i] / rows[done][i];
      for (std::size_t j = 0; j < rows[other].size(); ++j)
        rows[other][j] = rows[other][j] - factor * rows[done][j];
    }
  }
  return true;
}

/// The inverse of K without the rows and columns of what is held, 0 in those; none where it has none.
std::optional<Eigen::MatrixXd> inverse_beside(const Statics& statics, std::span<const Ball> constants,
                                              const Balls& x, const std::vector<bool>& held) {
  const std::size_t n = x.size();
  Balls k(n * n);
  TapeEvaluator<Ball>(statics.stiffness, constants)(x, k);
  std::vector<Eigen::Index> open;
  for (std::size_t i = 0; i < n; ++i) {
    if (!held[i]) open.push_back(static_cast<Eigen::Index>(i));
  }
  Eigen::MatrixXd whole(n, n);
  for (std::size_t i = 0; i < n * n; ++i)
    whole(static_cast<Eigen::Index>(i / n), static_cast<Eigen::Index>(i % n)) = k[i].value();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(whole.rows(), whole.cols());
  if (open.empty()) return result;
  const Eigen::MatrixXd part = whole(open, open);
  const Eigen::MatrixXd inverted = inverse(part);
  if (!inverted.allFinite()) return std::nullopt;
  result(open, open) = inverted;
  return result;
}

/// What the other coordinates move where those held are what their doubles stand for, up to half a unit in
/// the last place from these: by the family's directions, solved for the held ones.
void add_rounding_of_held(const BallMatrix& family, const std::vector<std::size_t>& held, Balls& x) {
  constexpr double beyond_first_order = 1.001;
  BallMatrix rows = family;
  for (std::size_t done = 0; done < held.size(); ++done) {
    const Ball pivot = rows[done][held[done]];
    for (Ball& entry : rows[done]) entry = entry / pivot;
    for (std::size_t other = 0; other < rows.size(); ++other) {
      const Ball factor = rows[other][held[done]];
      for (std::size_t j = 0; other != done && j < x.size(); ++j)
        rows[other][j] = rows[other][j] - factor * rows[done][j];
    }
  }
  const Balls at = x;
  for (std::size_t k = 0; k < held.size(); ++k) {
    const double value = std::abs(at[held[k]].value()), moved = (std::nextafter(value, infinity) - value) / 2;
    for (std::size_t i = 0; value > 0 && i < x.size(); ++i) {
      if (i != held[k]) x[i].radius += beyond_first_order * moved * rows[k][i].magnitude();
    }
  }
}

/// Gives the place its directions, where those stay independent all over its enclosure.
bool put_family(const CompiledFunction& changes, std::span<const Ball> constants, const Independent& chosen,
                Equilibrium& place) {
  const BallMatrix all = changes_at(changes, constants, place.x);
  BallMatrix family;
  for (const std::size_t k : chosen.rows) family.push_back(all[k]);
  if (!are_independent(family, chosen.columns)) return false;
  place.family = std::move(family);
  return true;
}

/// The one that has the chosen coordinates as they are near it.
std::optional<Equilibrium> member_of_family(const Statics& statics, std::span<const Ball> constants,
                                            NearlyEquilibrium near, const Eigen::VectorXd& guess,
                                            const std::vector<std::size_t>& held) {
  for (const std::size_t i : held) {
    const auto k = static_cast<Eigen::Index>(i);
    near.free[i] = true;
    if (std::abs(near.x[k] - guess[k]) <= settled_within * near.sizes[i]) near.x[k] = guess[k];
  }
  const auto inverse = inverse_beside(statics, constants, {near.x.begin(), near.x.end()}, near.free);
  if (!inverse) return std::nullopt;
  near.inverse = *inverse;
  std::optional<Equilibrium> found = enclosed_equilibrium(statics, constants, near);
  if (!found || !found->isolated) return std::nullopt;
  found->held = held;
  return found;
}

}  // namespace

Equilibrium with_family(const Statics& statics, std::span<const Ball> constants,
                        const NearlyEquilibrium& near, const Eigen::VectorXd& guess, Equilibrium degenerate) {
  const std::optional<CompiledFunction> changes = symmetric_changes(statics);
  if (!changes) return degenerate;
  const Independent chosen = independent(compared(*changes, constants, near));
  if (chosen.rows.empty()) return degenerate;
  std::optional<Equilibrium> member = member_of_family(statics, constants, near, guess, chosen.columns);
  if (member && put_family(*changes, constants, chosen, *member)) {
    add_rounding_of_held(member->family, chosen.columns, member->x);
    return *std::move(member);
  }
  put_family(*changes, constants, chosen, degenerate);
  return degenerate;
}

}  // namespace qdot
