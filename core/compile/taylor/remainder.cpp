#include "core/compile/taylor/remainder.hpp"

#include <cstring>

namespace qdot::taylor {
namespace {

using Two [[gnu::vector_size(16)]] = double;

/// sum over i < count of a_i b_i; count is a multiple of four.
double dot(const double* a, const double* b, unsigned count) {
  const auto pair = [](const double* x) {
    Two v;
    std::memcpy(&v, x, sizeof v);
    return v;
  };
  Two first{}, second{};
  for (unsigned i = 0; i < count; i += 4) {
    first += pair(a + i) * pair(b + i);
    second += pair(a + i + 2) * pair(b + i + 2);
  }
  first += second;
  return first[0] + first[1];
}

/// a u + b u^2 for 0 <= u <= 1, and by so much more or less.
Range parabola(double a, double b, double rest) {
  double least = std::min(0.0, a + b), most = std::max(0.0, a + b);
  const double u = -a / (2 * b);
  if (u > 0 && u < 1) {
    least = std::min(least, 0.5 * a * u);
    most = std::max(most, 0.5 * a * u);
  }
  return range(least - rest, most + rest);
}

unsigned padded(unsigned count) { return (count + 3) / 4 * 4; }

}  // namespace

Remainder::Remainder(const Program& program) : n_(program.state.n) {
  for (std::size_t i = 0; i < 2 * n_; ++i) state_.push_back(index_of(program.state.rows + i * stride));
  for (const Index i : state_) rows_[i].missing = 0;
  for (std::size_t i = 0; i < program.count; ++i) rules_.push_back(rule_for(program.steps[i]));
  if (program.state.accelerations == nullptr) return;
  for (std::size_t i = 0; i < n_; ++i) accelerations_.push_back(index_of(program.state.accelerations[i]));
}

Remainder::Index Remainder::index_of(const double* row) {
  const auto [place, is_new] = indices_.try_emplace(row, static_cast<Index>(rows_.size()));
  if (is_new) rows_.emplace_back().coefficients = row;
  return place->second;
}

Remainder::Rule Remainder::rule_for(const Step& step) {
  const auto index = [this](const double* row) { return row == nullptr ? Index{} : index_of(row); };
  Rule rule{.kind = step.kind,
            .constant = &step.constant,
            .x = index(step.x),
            .y = index(step.y),
            .out = index(step.out),
            .out2 = index(step.out2),
            .aux = step.kind == Kind::tangent ? index(step.aux) : Index{},
            .argument = step.argument,
            .solve = step.solve};
  for (unsigned i = 0; i < step.term_count; ++i) {
    rule.terms.push_back({step.terms[i].factor, index_of(step.terms[i].x), 0});
  }
  for (unsigned i = 0; i < step.product_count; ++i) {
    const Product& p = step.products[i];
    rule.products.push_back({p.factor, index_of(p.x), index_of(p.y)});
  }
  if (step.kind == Kind::rate || step.kind == Kind::rate_of_sum) rows_[rule.out].missing = 2;
  if (step.solve == nullptr) return rule;
  const std::size_t n = step.solve->n;
  for (std::size_t i = 0; i < n * n; ++i) rule.matrix.push_back(index(step.solve->matrix[i].m));
  for (std::size_t i = 0; i < n; ++i) {
    rule.right.push_back(index_of(step.solve->right[i]));
    rule.unknowns.push_back(index_of(step.solve->unknowns[i]));
  }
  return rule;
}

double Remainder::bound(double h, unsigned order, std::span<const double> allowed, std::span<double> defect) {
  prepare(h, order);
  look(Effort::quick);
  const double ratio = excess(allowed, defect);
  if (ratio <= 1) return ratio;
  look(Effort::careful);
  return excess(allowed, defect);
}

double Remainder::distance(const double* row, double h, unsigned order,
                           std::span<const double> missing_of_state) {
  prepare(h, order);
  for (std::size_t i = 0; i < 2 * n_; ++i) {
    conclude(rows_[state_[i]], missing_of_state[i]);
    if (i >= n_) rows_[state_[i]].argument_r = missing_of_state[i - n_];
  }
  const Row& result = rows_[index_of(row)];
  look(Effort::quick);
  if (!(result.r < infinity)) look(Effort::careful);
  return result.r;
}

void Remainder::prepare(double h, unsigned order) {
  h_ = h;
  order_ = order;
  powers_[0] = 1;
  for (unsigned k = 1; k <= order; ++k) powers_[k] = powers_[k - 1] * h;
  for (Row& row : rows_) take_sizes(row);
  std::size_t i = 0;
  for (; i + 4 <= rows_.size(); i += 4) sum_tails<4>(&rows_[i]);
  for (; i < rows_.size(); ++i) sum_tails<1>(&rows_[i]);
  for (Row& row : rows_) take_range(row);
}

void Remainder::take_sizes(Row& row) {
  const unsigned degree = order_ - row.missing;
  for (unsigned k = 0; k <= degree; ++k) row.a[k] = std::abs(row.coefficients[k]) * powers_[k];
  for (unsigned k = degree + 1; k < padded(order_ + 1); ++k) row.a[k] = 0;
}

/// Of several rows side by side, as each sum alone would wait for itself.
template <std::size_t count>
void Remainder::sum_tails(Row* rows) {
  std::array<double, count> sum{};
  for (unsigned k = 0; k <= order_; ++k) {
    for (std::size_t i = 0; i < count; ++i) rows[i].reversed_tails[k] = sum[i] += rows[i].a[order_ - k];
  }
  for (std::size_t i = 0; i < count; ++i) rows[i].reversed_tails[order_ + 1] = rows[i].t0 = sum[i];
}

void Remainder::take_range(Row& row) {
  const double* c = row.coefficients;
  row.of_row = parabola(c[1] * h_, c[2] * powers_[2], row.reversed_tails[order_ - 3]) + c[0];
  row.of_value = row.of_row;
  row.own_top = row.missing == 0 ? row.a[order_] : 0;
}

void Remainder::look(Effort effort) {
  effort_ = effort;
  for (const Rule& rule : rules_) apply(rule);
}

double Remainder::excess(std::span<const double> allowed, std::span<double> defect) const {
  double largest = 0;
  for (std::size_t i = 0; i < 2 * n_; ++i) {
    if (i < n_) {
      defect[i] = rows_[state_[n_ + i]].a[order_];
    } else {
      const Row& acceleration = rows_[accelerations_[i - n_]];
      defect[i] = acceleration.r + acceleration.own_top;
    }
    const double share = h_ * defect[i] / allowed[i];
    if (std::isnan(share)) return infinity;
    largest = std::max(largest, share);
  }
  return largest;
}

double Remainder::tail(const Row& a, const Row& b) const {
  return dot(a.a.data(), b.reversed_tails.data(), padded(order_ + 1));
}

double Remainder::tail_of_rate(const Row& rate, const Row& b) const {
  return dot(rate.a.data(), b.reversed_tails.data() + 1, padded(order_ + 1));
}

Range Remainder::variation(const Row& rate) const {
  const double* c = rate.coefficients;
  return parabola(c[0] * h_, 0.5 * c[1] * powers_[2], h_ / 3 * rate.reversed_tails[order_ - 2]);
}

}  // namespace qdot::taylor
