#include "core/compile/taylor/remainder.hpp"

#include <algorithm>

namespace qdot::taylor {
namespace {

// A step that is a little too long had better be shorter than looked at more closely.
constexpr double nearly = 3;
constexpr double by_far = 100;

}  // namespace

Remainder::Remainder(const Program& program, const Kernels& kernels)
    : n_(program.state.n), measure_(kernels.measure) {
  for (std::size_t i = 0; i < program.state.count; ++i)
    state_.push_back(index_of(program.state.rows + i * stride));
  for (const Index i : state_) rows_[i].missing = 0;
  for (std::size_t i = 0; i < program.count; ++i) rules_.push_back(rule_for(program.steps[i]));
  if (program.state.accelerations != nullptr) {
    for (std::size_t i = 0; i < n_; ++i) accelerations_.push_back(index_of(program.state.accelerations[i]));
  }
  collect_factors();
}

void Remainder::collect_factors() {
  factors_.clear();
  others_.clear();
  order_of_degrees_ = 0;
  for (Row& row : rows_) (row.is_factor ? factors_ : others_).push_back(&row);
  for (std::vector<RowSizes*>* const rows : {&factors_, &others_}) {
    while (rows->size() % 4 != 0) rows->push_back(rows->back());
  }
}

Remainder::Index Remainder::index_of(const double* row) {
  const auto [place, is_new] = indices_.try_emplace(row, static_cast<Index>(rows_.size()));
  if (is_new) rows_.emplace_back().coefficients = row;
  return place->second;
}

Remainder::Rule Remainder::rule_for(const Step& step) {
  const auto index = [this](const double* row) { return row == nullptr ? Index{} : index_of(row); };
  Rule rule{.kind = step.kind == Kind::still ? step.usual : step.kind,
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
  mark_factors(rule);
  if (step.kind == Kind::rate || step.kind == Kind::rate_of_sum) rows_[rule.out].missing = 2;
  if (step.solve == nullptr) return rule;
  const std::size_t n = step.solve->n;
  for (std::size_t i = 0; i < n * n; ++i) rule.matrix.push_back(index(step.solve->matrix[i].m));
  for (std::size_t i = 0; i < n; ++i) {
    rule.right.push_back(index_of(step.solve->right[i]));
    rule.unknowns.push_back(index_of(step.solve->unknowns[i]));
  }
  for (const Index i : rule.matrix) rows_[i].is_factor = true;
  for (const Index i : rule.unknowns) rows_[i].is_factor = true;
  return rule;
}

/// Terms of a sum are only added up.
void Remainder::mark_factors(const Rule& rule) {
  const auto mark = [this](Index i) { rows_[i].is_factor = true; };
  for (const Factor& product : rule.products) {
    mark(product.x);
    mark(product.y);
  }
  if (rule.kind <= Kind::sum_2_2) return;
  for (const Index i : {rule.x, rule.y, rule.out, rule.out2, rule.aux}) mark(i);
}

double Remainder::bound(double h, unsigned order, std::span<const double> allowed, std::span<double> defect) {
  begin(h, order);
  take_norms();
  look(Effort::rough);
  const double ratio = excess(allowed, defect);
  if (ratio <= 1 || (ratio > nearly && ratio < by_far)) return ratio;
  take_tails(factors_);
  look(Effort::quick);
  const double closer = excess(allowed, defect);
  if (closer < by_far) return closer;
  look_carefully();
  return excess(allowed, defect);
}

void Remainder::closest(double h, unsigned order, std::span<double> defect) {
  begin(h, order);
  take_tails(factors_);
  look(Effort::quick);
  if (operations_may_tell_more()) look_carefully();
  put_defect(defect);
}

void Remainder::find_ranges(double h, unsigned order) {
  begin(h, order);
  take_tails(factors_);
  look_carefully();
}

/// What lies in a range, and all of another, is half as far from its end as that is wide, at least.
bool Remainder::operations_may_tell_more() const {
  return std::ranges::any_of(factors_, [](const RowSizes* sizes) {
    const Row& row = static_cast<const Row&>(*sizes);
    return !(2 * row.r <= row.of_row.upper - row.of_row.lower);
  });
}

void Remainder::look_carefully() {
  take_tails(others_);
  look(Effort::careful);
}

double Remainder::distance(const double* row, double h, unsigned order,
                           std::span<const double> missing_of_state) {
  begin(h, order);
  Row& result = rows_[index_of(row)];
  if (!result.is_factor) {
    result.is_factor = true;
    collect_factors();
  }
  take_norms();
  put_missing(missing_of_state);
  look(Effort::rough);
  if (result.r < result.of_row.least_magnitude()) return result.r;  // the sign is plain
  take_tails(factors_);
  put_missing(missing_of_state);
  look(Effort::quick);
  if (result.r < infinity) return result.r;
  take_tails(others_);
  put_missing(missing_of_state);
  look(Effort::careful);
  return result.r;
}

void Remainder::put_missing(std::span<const double> missing_of_state) {
  for (std::size_t i = 0; i < state_.size(); ++i) {
    conclude(rows_[state_[i]], missing_of_state[i]);
    if (i >= n_) rows_[state_[i]].argument_r = missing_of_state[i - n_];
  }
}

void Remainder::look(Effort effort) {
  effort_ = effort;
  for (const Rule& rule : rules_) apply(rule);
}

void Remainder::put_defect(std::span<double> defect) const {
  for (std::size_t i = 0; i < n_; ++i) {
    const Row& acceleration = rows_[accelerations_[i]];
    defect[i] = rows_[state_[n_ + i]].own_top;
    defect[n_ + i] = acceleration.r + acceleration.own_top;
  }
}

double Remainder::excess(std::span<const double> allowed, std::span<double> defect) const {
  put_defect(defect);
  double largest = 0;
  for (std::size_t i = 0; i < 2 * n_; ++i) {
    const double share = h_ * defect[i] / allowed[i];
    if (std::isnan(share)) return infinity;
    largest = std::max(largest, share);
  }
  return largest;
}

}  // namespace qdot::taylor
