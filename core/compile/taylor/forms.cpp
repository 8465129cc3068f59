// Which sums a series needs, and which of them become part of others.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compile/taylor/translation.hpp"

namespace qdot {
namespace {

/// How many slots an instruction writes.
std::size_t results(const Instruction& instruction) {
  if (instruction.operation == Operation::solve) return instruction.linear;
  return instruction.operation == Operation::sine_cosine ? 2 : 1;
}

/// Or zero: products with it are not rounded away.
bool is_in_range(double factor) {
  constexpr double least = 1e-280, most = 1e280;
  return factor == 0 || (std::abs(factor) > least && std::abs(factor) < most);
}

}  // namespace

double TaylorTranslation::Form::product(double a, double b) {
  const double both = a * b;
  if (!is_in_range(both) || (both == 0 && a != 0 && b != 0)) factors = Factors::out_of_range;
  if (std::fma(a, b, -both) != 0) factors = std::max(factors, Factors::rounded);
  return both;
}

double TaylorTranslation::Form::reciprocal(double a) {
  const double one_over = 1 / a;
  if (!is_in_range(one_over)) factors = Factors::out_of_range;
  if (std::fma(a, one_over, -1) != 0) factors = std::max(factors, Factors::rounded);
  return one_over;
}

void TaylorTranslation::find_forms() {
  for (std::size_t i = 0; i <= tape_.variables_; ++i) varies_[tape_.parameters_ + i] = true;
  for (const Instruction& instruction : tape_.body_) {
    for (std::size_t i = 0; i < results(instruction); ++i) varies_[instruction.out + i] = true;
    is_sum_[instruction.out] = is_sum(instruction);
    if (is_sum_[instruction.out]) forms_[instruction.out] = form_of(instruction);
  }
}

/// Something divided by a constant, such as f by a mass that does not change, is a sum too.
bool TaylorTranslation::is_sum(const Instruction& instruction) const {
  const Slot* operand = tape_.operands_.data() + instruction.first;
  switch (instruction.operation) {
    case Operation::sum_of_products:
      return true;
    case Operation::quotient:
      return !varies_[operand[1]];
    case Operation::solve:
      return instruction.linear == 1 && !varies_[operand[0]];
    default:
      return false;
  }
}

TaylorTranslation::Form TaylorTranslation::form_of(const Instruction& instruction) const {
  const Slot* operand = tape_.operands_.data() + instruction.first;
  Form form;
  const auto add_term = [&](double factor, Slot x) {
    if (varies_[x]) {
      form.terms.push_back({factor, x});
    } else {
      form.constant += factor * constants_[x];
    }
  };
  if (instruction.operation != Operation::sum_of_products) {
    const bool is_solve = instruction.operation == Operation::solve;
    add_term(form.reciprocal(constants_[operand[is_solve ? 0 : 1]]), operand[is_solve ? 1 : 0]);
    return form;
  }
  for (unsigned i = 0; i < instruction.linear; ++i, operand += 2)
    add_term(constants_[operand[0]], operand[1]);
  for (unsigned i = 0; i < instruction.products; ++i, operand += 3) {
    const double factor = constants_[operand[0]];
    const Slot x = operand[1], y = operand[2];
    if (varies_[x] && varies_[y]) {
      form.products.push_back({factor, x, y});
    } else if (varies_[x]) {
      add_term(form.product(factor, constants_[y]), x);
    } else {
      add_term(form.product(factor, constants_[x]), y);
    }
  }
  return form;
}

/// Backwards, so that what nothing needs does not need anything; then those that are needed once are put in.
void TaylorTranslation::count_uses() {
  for (const Slot slot : tape_.outputs_) ++uses_[slot].otherwise;
  for (auto instruction = tape_.body_.rbegin(); instruction != tape_.body_.rend(); ++instruction) {
    count_uses_of(*instruction);
  }
  for (const Instruction& instruction : tape_.body_) {
    if (!is_sum_[instruction.out]) continue;
    const Form& form = forms_[instruction.out];
    Form whole;
    whole.constant = form.constant;
    whole.factors = form.factors;
    for (const auto& [factor, x] : form.terms) inline_into(whole, factor, x);
    for (const auto& [factor, x, y] : form.products) multiply_into(whole, factor, x, y);
    forms_[instruction.out] = std::move(whole);
  }
}

void TaylorTranslation::count_uses_of(const Instruction& instruction) {
  const Slot* operand = tape_.operands_.data() + instruction.first;
  const auto is_used = [&](Slot slot) { return uses_[slot].all() > 0; };
  bool needed = false;
  for (std::size_t i = 0; i < results(instruction); ++i) {
    needed = needed || is_used(static_cast<Slot>(instruction.out + i));
  }
  if (!needed) return;
  if (is_sum_[instruction.out]) {
    for (const auto& [factor, x] : forms_[instruction.out].terms) ++uses_[x].as_term;
    for (const auto& [factor, x, y] : forms_[instruction.out].products) {
      ++(x == y ? uses_[x].otherwise : uses_[x].as_factor);
      ++(x == y ? uses_[y].otherwise : uses_[y].as_factor);
    }
    return;
  }
  switch (instruction.operation) {
    case Operation::sine_cosine:
      if (!has_rate_of_its_own(operand[0])) ++uses_[operand[0]].otherwise;
      break;
    case Operation::solve: {
      const std::size_t n = instruction.linear;
      if (instruction.has_determinant) ++operand;  // needed at order 0 only
      for (std::size_t i = 0; i < n * n; ++i) ++uses_[n > 1 ? entry(operand[i]).x : operand[i]].otherwise;
      for (std::size_t i = n * n; i < n * n + n; ++i) ++uses_[operand[i]].otherwise;
      break;
    }
    case Operation::quotient:
      ++uses_[operand[1]].otherwise;
      [[fallthrough]];
    default:
      ++uses_[operand[0]].otherwise;
  }
}

bool TaylorTranslation::is_needed(const Instruction& instruction) const {
  if (is_inlined(instruction.out)) return false;
  for (std::size_t i = 0; i < results(instruction); ++i) {
    if (uses_[instruction.out + i].all() > 0) return true;
  }
  return false;
}

/// Of a mass matrix, without a constant in it: a slot, or what it is a multiple of.
TaylorTranslation::Form::Term TaylorTranslation::entry(Slot slot) const {
  const Form& form = forms_[slot];
  const bool is_multiple = is_sum_[slot] && form.products.empty() && form.terms.size() == 1;
  return is_multiple ? form.terms[0] : Form::Term{1, slot};
}

bool TaylorTranslation::is_inlined(Slot slot) const {
  if (!is_sum_[slot] || uses_[slot].all() != 1) return false;
  const bool is_short = forms_[slot].products.empty() && forms_[slot].terms.size() == 1;
  return uses_[slot].as_term == 1 || (uses_[slot].as_factor == 1 && is_short);
}

/// The forms of sums that come earlier in the tape are whole.
void TaylorTranslation::inline_into(Form& form, double factor, Slot slot) const {
  if (!is_inlined(slot)) {
    form.terms.push_back({factor, slot});
    return;
  }
  const Form& part = forms_[slot];
  form.constant += factor * part.constant;
  form.factors = std::max(form.factors, part.factors);
  for (const auto& [inner, x] : part.terms) form.terms.push_back({form.product(factor, inner), x});
  for (const auto& [inner, x, y] : part.products)
    form.products.push_back({form.product(factor, inner), x, y});
}

/// (a + b x) y = a y + b x y
void TaylorTranslation::multiply_into(Form& form, double factor, Slot x, Slot y) const {
  if (!is_inlined(x)) std::swap(x, y);
  if (!is_inlined(x)) {
    form.products.push_back({factor, x, y});
    return;
  }
  const Form& part = forms_[x];
  form.factors = std::max(form.factors, part.factors);
  if (part.constant != 0) inline_into(form, form.product(factor, part.constant), y);
  multiply_into(form, form.product(factor, part.terms[0].factor), y, part.terms[0].x);
}

/// Or the time.
bool TaylorTranslation::is_coordinate(Slot slot) const {
  return slot >= tape_.parameters_ && slot <= tape_.parameters_ + coordinates_;
}

bool TaylorTranslation::has_rate_of_its_own(Slot slot) const {
  if (is_coordinate(slot)) return true;
  if (!is_sum_[slot] || !forms_[slot].products.empty()) return false;
  for (const auto& [factor, x] : forms_[slot].terms) {
    if (!is_coordinate(x)) return false;
  }
  return true;
}

}  // namespace qdot
