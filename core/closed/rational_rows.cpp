#include "core/closed/rational_rows.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"

namespace qdot {
namespace {

RationalFunction rational_number(const Number& value) {
  return value.is_zero() ? RationalFunction{}
                         : in_lowest_terms({{Monomial{}, value}}, {{Monomial{}, Number(1)}});
}

RationalRows unit_rows(std::size_t n) {
  RationalRows rows(n, std::vector<RationalFunction>(n));
  for (std::size_t i = 0; i < n; ++i) rows[i][i] = rational_number(Number(1));
  return rows;
}

/// The place of the shortest entry that is not 0; the row's length where there is none.
std::size_t shortest_entry(const std::vector<RationalFunction>& row, std::size_t n) {
  std::size_t best = n, least = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t length = row[i].above.size() + row[i].below.size();
    const bool is_number = length == 2 && row[i].above.begin()->first.empty();
    if (row[i].is_zero() || (best != n && length + (is_number ? 0 : 1) >= least)) continue;
    best = i;
    least = length + (is_number ? 0 : 1);
  }
  return best;
}

void subtract(std::vector<RationalFunction>& row, const RationalFunction& factor,
              const std::vector<RationalFunction>& other) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (!other[i].is_zero()) row[i] = row[i] - factor * other[i];
  }
}

bool feeds(const std::vector<std::vector<bool>>& reach, std::size_t i, std::size_t j) {
  return i == j || (reach[i][j] && reach[j][i]);
}

}  // namespace

SolvedRows solved_rows(RationalRows a, std::size_t n) {
  const std::size_t m = a.size();
  SolvedRows result;
  const RationalRows unit = unit_rows(m);
  for (std::size_t j = 0; j < m; ++j) a[j].insert(a[j].end(), unit[j].begin(), unit[j].end());
  for (std::size_t j = 0; j < m; ++j) {
    const std::size_t pivot = shortest_entry(a[j], n);
    if (pivot == n) throw Error(ErrorCode::not_applicable, "Constraints depend on each other.");
    result.dependent.push_back(pivot);
    const RationalFunction by = a[j][pivot];
    for (RationalFunction& entry : a[j]) {
      if (!entry.is_zero()) entry = entry / by;
    }
    for (std::size_t k = 0; k < m; ++k) {
      if (k != j && !a[k][pivot].is_zero()) subtract(a[k], RationalFunction(a[k][pivot]), a[j]);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (std::ranges::find(result.dependent, i) == result.dependent.end()) result.free.push_back(i);
  }
  result.allowed.assign(n, std::vector<RationalFunction>(result.free.size()));
  for (std::size_t f = 0; f < result.free.size(); ++f) {
    result.allowed[result.free[f]][f] = rational_number(Number(1));
    for (std::size_t j = 0; j < m; ++j) result.allowed[result.dependent[j]][f] = -a[j][result.free[f]];
  }
  for (const auto& row : a)
    result.inverse.emplace_back(row.begin() + static_cast<std::ptrdiff_t>(n), row.end());
  return result;
}

RationalRows multiplied(const RationalRows& a, const RationalRows& b) {
  RationalRows result(a.size(), std::vector<RationalFunction>(b.empty() ? 0 : b[0].size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (a[i][k].is_zero()) continue;
      for (std::size_t j = 0; j < b[k].size(); ++j) {
        if (!b[k][j].is_zero()) result[i][j] = result[i][j] + a[i][k] * b[k][j];
      }
    }
  }
  return result;
}

RationalRows transposed(const RationalRows& a) {
  RationalRows result(a.empty() ? 0 : a[0].size());
  for (const auto& row : a) {
    for (std::size_t j = 0; j < row.size(); ++j) result[j].push_back(row[j]);
  }
  return result;
}

RationalRows added(const RationalRows& a, const RationalFunction& factor, const RationalRows& b) {
  RationalRows result = a;
  for (std::size_t i = 0; i < a.size(); ++i) subtract(result[i], -factor, b[i]);
  return result;
}

std::vector<RationalFunction> characteristic_polynomial(const RationalRows& a) {
  const std::size_t n = a.size();
  std::vector<RationalFunction> c(n + 1);
  c[n] = rational_number(Number(1));
  RationalRows m = unit_rows(n);
  for (std::size_t k = 1; k <= n; ++k) {
    const RationalRows am = multiplied(a, m);
    RationalFunction trace;
    for (std::size_t i = 0; i < n; ++i) trace = trace + am[i][i];
    c[n - k] = rational_number(Number::ratio(-1, static_cast<std::int64_t>(k))) * trace;
    m = added(am, c[n - k], unit_rows(n));
  }
  return c;
}

std::vector<std::vector<std::size_t>> blocks_of(const RationalRows& a) {
  const std::size_t n = a.size();
  std::vector<std::vector<bool>> reach(n, std::vector<bool>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) reach[i][j] = !a[i][j].is_zero();
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) reach[i][j] = reach[i][j] || (reach[i][k] && reach[k][j]);
    }
  }
  std::vector<std::vector<std::size_t>> blocks;
  std::vector<bool> used(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (used[i]) continue;
    blocks.emplace_back();
    for (std::size_t j = i; j < n; ++j) {
      if (used[j] || !feeds(reach, i, j)) continue;
      used[j] = true;
      blocks.back().push_back(j);
    }
  }
  return blocks;
}

}  // namespace qdot
