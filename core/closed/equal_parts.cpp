#include "core/closed/equal_parts.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace qdot {
namespace {

using Group = std::vector<std::size_t>;

constexpr std::size_t most_exchanged = 12;

/// Where each coordinate of a group goes, by its place in the group, and with which sign.
struct Exchange {
  std::vector<std::size_t> to;
  std::vector<int> sign;
};

bool is_signed(const RationalFunction& a, const RationalFunction& b, int sign) {
  return a == (sign > 0 ? b : -b);
}

class ExchangeSearch {
 public:
  ExchangeSearch(const LinearMatrices& matrices, const Group& group)
      : matrices_(matrices),
        group_(group),
        found_{std::vector<std::size_t>(group.size(), group.size()), std::vector<int>(group.size(), 1)} {}

  /// The first in which some pair changes places.
  std::optional<Exchange> run() {
    if (!goes_on(false)) return std::nullopt;
    return found_;
  }

 private:
  [[nodiscard]] bool is_placed(std::size_t i) const { return found_.to[i] < group_.size(); }

  bool goes_on(bool has_pair) {
    const auto next = std::ranges::find(found_.to, group_.size());
    if (next == found_.to.end()) return has_pair;
    const auto i = static_cast<std::size_t>(next - found_.to.begin());
    for (std::size_t j = group_.size(); j-- > i;) {
      if (is_placed(j)) continue;
      for (const int sign : {1, -1}) {
        place(i, j, sign);
        if (holds(i) && holds(j) && goes_on(has_pair || i != j)) return true;
        found_.to[i] = found_.to[j] = group_.size();
      }
    }
    return false;
  }

  void place(std::size_t i, std::size_t j, int sign) {
    found_.to[i] = j;
    found_.to[j] = i;
    found_.sign[i] = found_.sign[j] = sign;
  }

  /// The entries of coordinate i and of those that have their places stay as they are.
  [[nodiscard]] bool holds(std::size_t i) const {
    for (const Entries* a : {&matrices_.mass, &matrices_.damping, &matrices_.stiffness}) {
      for (std::size_t j = 0; j < group_.size(); ++j) {
        if (!is_placed(j)) continue;
        const std::size_t to_i = group_[found_.to[i]], to_j = group_[found_.to[j]];
        const int sign = found_.sign[i] * found_.sign[j];
        if (!is_signed((*a)[group_[i]][group_[j]], (*a)[to_i][to_j], sign) ||
            !is_signed((*a)[group_[j]][group_[i]], (*a)[to_j][to_i], sign))
          return false;
      }
    }
    return true;
  }

  const LinearMatrices& matrices_;
  const Group& group_;
  Exchange found_;
};

/// u = B v: the sum of a pair in the first one's place, the difference in the other's.
std::vector<std::vector<int>> sums_and_differences(std::size_t n, const Group& group,
                                                   const Exchange& exchange) {
  std::vector<std::vector<int>> b(n, std::vector<int>(n));
  for (std::size_t i = 0; i < n; ++i) b[i][i] = 1;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::size_t first = group[i], second = group[exchange.to[i]];
    if (exchange.to[i] <= i) continue;
    b[second][first] = exchange.sign[i];
    b[second][second] = -exchange.sign[i];
    b[first][second] = 1;
  }
  return b;
}

/// B^T A B.
Entries changed(const Entries& a, const std::vector<std::vector<int>>& b) {
  const std::size_t n = a.size();
  const auto times = [](const RationalFunction& f, int factor) {
    return RationalFunction{scaled(f.above, {}, Number(factor)), f.below};
  };
  Entries half(n, std::vector<RationalFunction>(n)), result = half;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t j = 0; j < n; ++j) {
        if (b[j][k] != 0 && !a[i][j].is_zero()) half[i][k] = half[i][k] + times(a[i][j], b[j][k]);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t j = 0; j < n; ++j) {
        if (b[j][i] != 0 && !half[j][k].is_zero()) result[i][k] = result[i][k] + times(half[j][k], b[j][i]);
      }
    }
  }
  return result;
}

std::vector<std::vector<int>> product(const std::vector<std::vector<int>>& a,
                                      const std::vector<std::vector<int>>& b) {
  const std::size_t n = a.size();
  std::vector<std::vector<int>> result(n, std::vector<int>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) result[i][k] += a[i][j] * b[j][k];
    }
  }
  return result;
}

}  // namespace

std::vector<std::vector<std::size_t>> coupled_groups(const LinearMatrices& matrices) {
  const std::size_t n = matrices.mass.size();
  Group group(n);
  std::iota(group.begin(), group.end(), 0);
  const auto couples = [&](std::size_t i, std::size_t j) {
    return std::ranges::any_of(
        std::array{&matrices.mass, &matrices.damping, &matrices.stiffness},
        [&](const Entries* a) { return !(*a)[i][j].is_zero() || !(*a)[j][i].is_zero(); });
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (group[i] != group[j] && couples(i, j))
        std::ranges::replace(group, std::max(group[i], group[j]), std::min(group[i], group[j]));
    }
  }
  std::vector<Group> result(n);
  for (std::size_t i = 0; i < n; ++i) result[group[i]].push_back(i);
  std::erase_if(result, [](const Group& members) { return members.empty(); });
  return result;
}

bool is_damped(const LinearMatrices& matrices, const Group& group) {
  return std::ranges::any_of(group, [&](std::size_t i) {
    return std::ranges::any_of(matrices.damping[i], [](const auto& entry) { return !entry.is_zero(); });
  });
}

FallenApart fallen_apart(LinearMatrices matrices) {
  const std::size_t n = matrices.mass.size();
  FallenApart result{std::move(matrices), sums_and_differences(n, {}, {})};
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (const Group& group : coupled_groups(result.matrices)) {
      if (group.size() < 3 || group.size() > most_exchanged) continue;
      const auto exchange = ExchangeSearch(result.matrices, group).run();
      if (!exchange) continue;
      const auto b = sums_and_differences(n, group, *exchange);
      for (Entries* a : {&result.matrices.mass, &result.matrices.damping, &result.matrices.stiffness})
        *a = changed(*a, b);
      result.basis = product(result.basis, b);
      is_changed = true;
      break;
    }
  }
  return result;
}

}  // namespace qdot
