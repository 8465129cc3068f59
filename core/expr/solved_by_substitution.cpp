#include "core/expr/solved_by_substitution.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/expr/rational_function.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// Where an unknown stands alone, with nothing but numbers and symbols as its factor.
struct Pivot {
  std::size_t row{}, column{};
};

bool is_symbol_power(const Expression& e) {
  return std::holds_alternative<Symbol>(split_power(e).base.node());
}

/// 0 for a number, 1 for a product of symbols; no value for what may vanish.
std::optional<int> rank_of(const Expression& e) {
  if (e.is_zero()) return std::nullopt;
  if (std::holds_alternative<Literal>(e.node())) return 0;
  const auto* product = std::get_if<Product>(&e.node());
  if (product == nullptr) return is_symbol_power(e) ? std::optional(1) : std::nullopt;
  const bool is_plain = std::ranges::all_of(
      product->factors, [&](NodeId id) { return is_symbol_power(Expression(e.graph(), id)); });
  return is_plain ? std::optional(1) : std::nullopt;
}

/// Without the symbols that were divided by on the way.
Expression quotient(const Expression& a, const Expression& b) {
  const RationalFunction f = in_lowest_terms(multiplied_out(a), multiplied_out(b));
  return simplify_quotient(to_expression(a.graph(), f.above), to_expression(a.graph(), f.below));
}

class SubstitutionSolver {
 public:
  SubstitutionSolver(Matrix m, std::vector<Expression> b)
      : m_(std::move(m)), b_(std::move(b)), rows_(b_.size()), columns_(b_.size()) {
    std::iota(rows_.begin(), rows_.end(), 0);
    std::iota(columns_.begin(), columns_.end(), 0);
  }

  std::vector<Expression> run() {
    while (rows_.size() > largest_written_system) {
      const auto pivot = next();
      if (!pivot) return {};
      eliminate(*pivot);
    }
    solve_rest();
    while (!pivots_.empty()) {
      take_back(pivots_.back());
      pivots_.pop_back();
    }
    for (Expression& x : x_) x = quotient(x, denominator_);
    return std::move(x_);
  }

 private:
  /// The one that touches the fewest other entries (Markowitz), numbers first.
  [[nodiscard]] std::optional<Pivot> next() const {
    std::optional<Pivot> best;
    std::pair<int, std::size_t> cost;
    for (const std::size_t i : rows_) {
      for (const std::size_t j : columns_) {
        const auto rank = rank_of(m_[i][j]);
        if (!rank) continue;
        const auto in_row =
            std::ranges::count_if(columns_, [&](std::size_t k) { return !m_[i][k].is_zero(); });
        const auto in_column =
            std::ranges::count_if(rows_, [&](std::size_t k) { return !m_[k][j].is_zero(); });
        const std::pair here(*rank, static_cast<std::size_t>((in_row - 1) * (in_column - 1)));
        if (best && cost <= here) continue;
        best = Pivot{i, j};
        cost = here;
      }
    }
    return best;
  }

  void eliminate(const Pivot& pivot) {
    std::erase(rows_, pivot.row);
    std::erase(columns_, pivot.column);
    for (const std::size_t i : rows_) {
      if (m_[i][pivot.column].is_zero()) continue;
      const Expression factor = m_[i][pivot.column] / m_[pivot.row][pivot.column];
      for (const std::size_t j : columns_) {
        if (!m_[pivot.row][j].is_zero()) m_[i][j] = simplify(m_[i][j] - factor * m_[pivot.row][j]);
      }
      b_[i] = simplify(b_[i] - factor * b_[pivot.row]);
    }
    pivots_.push_back(pivot);
  }

  void solve_rest() {
    Matrix rest;
    for (const std::size_t i : rows_) {
      rest.emplace_back();
      for (const std::size_t j : columns_) rest.back().push_back(m_[i][j]);
    }
    denominator_ = determinant(rest);
    x_.assign(b_.size(), b_[0].graph().number(0));
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      Matrix replaced = rest;
      for (std::size_t i = 0; i < rows_.size(); ++i) replaced[i][j] = b_[rows_[i]];
      x_[columns_[j]] = determinant(replaced);
    }
  }

  /// From the equation in which it stood alone.
  void take_back(const Pivot& pivot) {
    Expression sum = b_[pivot.row] * denominator_;
    for (const std::size_t j : columns_) {
      if (!m_[pivot.row][j].is_zero()) sum = sum - m_[pivot.row][j] * x_[j];
    }
    x_[pivot.column] = simplify(sum / m_[pivot.row][pivot.column]);
    columns_.push_back(pivot.column);
  }

  Matrix m_;
  std::vector<Expression> b_;
  std::vector<std::size_t> rows_, columns_;  ///< that are left
  std::vector<Pivot> pivots_;
  std::vector<Expression> x_;  ///< times the denominator
  Expression denominator_;
};

}  // namespace

std::vector<Expression> solved_by_substitution(Matrix m, std::vector<Expression> b) {
  return SubstitutionSolver(std::move(m), std::move(b)).run();
}

}  // namespace qdot
