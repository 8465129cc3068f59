#include "core/compile/taylor/pair_translation.hpp"

#include <algorithm>

namespace qdot {
namespace {

template <class T, class Same>
bool are_same(const T* a, const T* b, std::size_t count, Same is_same) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_same(a[i], b[i])) return false;
  }
  return true;
}

}  // namespace

PairTranslation::PairTranslation(const TaylorTranslation& first, const TaylorTranslation& second,
                                 std::span<const PairOfDoubles> slots)
    : a_(first), b_(second), slots_(slots), is_possible_(takes_same_steps()) {
  if (!is_possible_) return;
  take_rows();
  take_systems();
  take_steps();
  take_start();
}

bool PairTranslation::takes_same_steps() const {
  return a_.steps_.size() == b_.steps_.size() &&
         are_same(a_.steps_.data(), b_.steps_.data(), a_.steps_.size(),
                  [this](const auto& a, const auto& b) { return is_same(a, b); });
}

/// The same place in the rows of each.
bool PairTranslation::is_same(const double* a, const double* b) const {
  if (a == nullptr || b == nullptr) return a == b;
  return a - a_.row_of(0) == b - b_.row_of(0);
}

bool PairTranslation::is_same(const taylor::Step& a, const taylor::Step& b) const {
  const auto is_same_term = [this](const auto& x, const auto& y) { return is_same(x.x, y.x); };
  const auto is_same_product = [this](const auto& x, const auto& y) {
    return is_same(x.x, y.x) && is_same(x.y, y.y);
  };
  if (a.kind != b.kind || a.term_count != b.term_count || a.product_count != b.product_count) return false;
  if (!is_same(a.x, b.x) || !is_same(a.y, b.y) || !is_same(a.aux, b.aux)) return false;
  if (!is_same(a.out, b.out) || !is_same(a.out2, b.out2)) return false;
  return are_same(a.terms, b.terms, a.term_count, is_same_term) &&
         are_same(a.products, b.products, a.product_count, is_same_product) &&
         (a.solve == nullptr || is_same(*a.solve, *b.solve));
}

bool PairTranslation::is_same(const taylor::Solve& a, const taylor::Solve& b) const {
  const auto is_same_row = [this](const double* x, const double* y) { return is_same(x, y); };
  return a.n == b.n && are_same(a.right, b.right, a.n, is_same_row) &&
         are_same(a.unknowns, b.unknowns, a.n, is_same_row) &&
         are_same(a.matrix, b.matrix, std::size_t{a.n} * a.n,
                  [this](const auto& x, const auto& y) { return is_same(x.m, y.m); });
}

/// Coefficient 1 of a row begins as much memory as two registers hold.
void PairTranslation::take_rows() {
  constexpr std::size_t registers = 4;
  rows_.assign(a_.rows_.size() + registers, PairOfDoubles{});
  const auto place = reinterpret_cast<std::uintptr_t>(rows_.data()) / sizeof(PairOfDoubles);
  first_ = rows_.data() + taylor::before_row + (registers - 1 - place % registers) % registers;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) first_[slot * taylor::stride] = slots_[slot];
  *at(a_.one_) = PairOfDoubles{1, 1};
}

void PairTranslation::take_systems() {
  for (const TaylorStart<double>::System& system : a_.start_.systems) {
    const std::vector<PairOfDoubles> entries(system.n * system.n);
    start_.systems.push_back({.n = system.n,
                              .matrix_slots = system.matrix_slots,
                              .determinant_slot = system.determinant_slot,
                              .has_determinant = system.has_determinant,
                              .matrix = entries,
                              .inverse = entries});
  }
}

void PairTranslation::take_steps() {
  steps_.reserve(a_.steps_.size());
  for (std::size_t i = 0; i < a_.steps_.size(); ++i) steps_.push_back(step(a_.steps_[i], b_.steps_[i]));
  const auto& state = a_.program_.state;
  const PairOfDoubles** accelerations = places<const PairOfDoubles*>(state.n);
  for (std::size_t i = 0; i < state.n; ++i) accelerations[i] = at(state.accelerations[i]);
  program_ = {steps_.data(), steps_.size(), {state.n, at(state.rows), accelerations, state.count}};
}

void PairTranslation::take_start() {
  for (const auto& [slot, row] : a_.start_.rows) start_.rows.emplace_back(slot, at(row));
  start_.time = at(a_.start_.time);
  start_.put_together = a_.start_.put_together;
  for (const auto& [step, is_row_of_slot, partner, argument_slot] : a_.start_.own)
    start_.own.push_back({step, is_row_of_slot, partner, argument_slot});
}

PairTranslation::Step PairTranslation::step(const taylor::Step& a, const taylor::Step& b) {
  taylor::BasicTerm<PairOfDoubles>* terms = places<taylor::BasicTerm<PairOfDoubles>>(a.term_count);
  for (std::size_t i = 0; i < a.term_count; ++i)
    terms[i] = {PairOfDoubles{a.terms[i].factor, b.terms[i].factor}, at(a.terms[i].x)};
  taylor::BasicProduct<PairOfDoubles>* products =
      places<taylor::BasicProduct<PairOfDoubles>>(a.product_count);
  for (std::size_t i = 0; i < a.product_count; ++i) {
    const taylor::Product& product = a.products[i];
    products[i] = {.factor = PairOfDoubles{product.factor, b.products[i].factor},
                   .x = at(product.x),
                   .y = at(product.y)};
    start_.products.push_back(&products[i]);
  }
  return {.kind = a.kind,
          .usual = a.usual,
          .term_count = a.term_count,
          .product_count = a.product_count,
          .constant = PairOfDoubles{a.constant, b.constant},
          .terms = terms,
          .products = products,
          .x = at(a.x),
          .y = at(a.y),
          .out = at(a.out),
          .out2 = at(a.out2),
          .aux = at(a.aux),
          .solve = a.solve == nullptr ? nullptr : solve(*a.solve, *b.solve),
          .argument = a.argument == nullptr ? nullptr : &slots_[a_.slot_of(a.argument)]};
}

const PairTranslation::Solve* PairTranslation::solve(const taylor::Solve& a, const taylor::Solve& b) {
  const std::size_t n = a.n;
  const std::span entries(places<taylor::BasicEntry<PairOfDoubles>>(n * n), n * n);
  for (std::size_t i = 0; i < n * n; ++i)
    entries[i] = {.factor = PairOfDoubles{a.matrix[i].factor, b.matrix[i].factor}, .m = at(a.matrix[i].m)};
  const PairOfDoubles** right = places<const PairOfDoubles*>(n);
  PairOfDoubles** unknowns = places<PairOfDoubles*>(n);
  for (std::size_t i = 0; i < n; ++i) {
    right[i] = at(a.right[i]);
    unknowns[i] = at(a.unknowns[i]);
  }
  const PairOfDoubles* inverse = start_.systems[start_.entries.size()].inverse.data();
  Solve* const solve = places<Solve>(1);
  *solve = {a.n, entries.data(), right, unknowns, inverse, nullptr};
  start_.entries.push_back({entries, solve});
  return solve;
}

PairOfDoubles* PairTranslation::at(const double* of_first) {
  return of_first == nullptr ? nullptr : first_ + (of_first - a_.row_of(0));
}

}  // namespace qdot
