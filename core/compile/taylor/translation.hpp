#pragma once
// From a tape to what the Taylor kernels work on.
//
// At orders above 0 constants vanish, so that a sum keeps only what varies, with numbers for factors. A sum
// that is needed only once, as a term of another, becomes part of that; so does a + b x that is needed only
// once, as a factor. Functions such as sin and cos need the rate of their argument u. Where u is a coordinate
// that is the row of its velocity, and where u is a sum of coordinates a sum of such rows, so that nothing
// waits for u itself.

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/compile/taylor/kernels.hpp"
#include "core/compile/taylor/start.hpp"

namespace qdot {

class TaylorTranslation {
 public:
  /// Keeps both references; the workspace also is where later evaluations are found. The tape's variables
  /// begin with so many coordinates and their velocities.
  TaylorTranslation(const CompiledFunction& tape, const Workspace& constants, std::size_t coordinates);

  /// Coefficients 0, from the slots of an evaluation. False where a mass matrix has no inverse.
  [[nodiscard]] bool start(const Workspace& slots) { return start_.begin(std::span(slots), steps_.data()); }
  [[nodiscard]] const taylor::Program& program() const { return program_; }
  /// The same for a function of the state, which has no accelerations.
  [[nodiscard]] taylor::Program composition() const;
  /// Where the first output stands.
  [[nodiscard]] const double* output() { return row(tape_.outputs_.front()); }
  [[nodiscard]] const double* row_of(Slot slot) const {
    return rows_.data() + first_ + slot * taylor::stride;
  }
  [[nodiscard]] bool is_of_state(const double* row) const;
  [[nodiscard]] std::size_t slot_of(const double* argument) const {
    return static_cast<std::size_t>(argument - constants_.data());
  }
  [[nodiscard]] double* variable(std::size_t i) { return row(tape_.parameters_ + 1 + i); }

 private:
  friend class PairTranslation;

  /// What constants make when they are put together.
  enum class Factors : std::uint8_t { exact, rounded, out_of_range };

  /// A sum of what varies.
  struct Form {
    struct Term {
      double factor;
      Slot x;
    };
    struct Product {
      double factor;
      Slot x, y;
    };
    double constant{};
    std::vector<Term> terms;
    std::vector<Product> products;
    Factors factors{};  ///< the worst of them

    [[nodiscard]] double product(double a, double b);
    [[nodiscard]] double reciprocal(double a);
  };

  struct Uses {
    unsigned as_term{};    ///< of a sum
    unsigned as_factor{};  ///< of a product in a sum, with another factor
    unsigned otherwise{};

    [[nodiscard]] unsigned all() const { return as_term + as_factor + otherwise; }
  };

  void find_forms();
  [[nodiscard]] Form form_of(const Instruction& instruction) const;
  void count_uses();
  void count_uses_of(const Instruction& instruction);
  [[nodiscard]] bool is_needed(const Instruction& instruction) const;
  [[nodiscard]] bool is_sum(const Instruction& instruction) const;
  [[nodiscard]] bool is_inlined(Slot slot) const;
  [[nodiscard]] bool is_coordinate(Slot slot) const;
  [[nodiscard]] bool has_rate_of_its_own(Slot slot) const;
  [[nodiscard]] Form::Term entry(Slot slot) const;
  void inline_into(Form& form, double factor, Slot slot) const;
  void multiply_into(Form& form, double factor, Slot x, Slot y) const;

  void translate(const Instruction& instruction);
  void translate_call(const Instruction& instruction, taylor::Step& step);
  void translate_arc(const Instruction& instruction, taylor::Step& step);
  void translate_solve(const Instruction& instruction);
  void add_sum(const Form& form, double* out);
  void begin_by_factors() { start_.put_together.push_back(steps_.size() - 1); }
  [[nodiscard]] const double* rate_row(Slot argument);
  [[nodiscard]] const double* rate_row_of(Slot coordinate_or_time);

  [[nodiscard]] double* row(std::size_t index) { return rows_.data() + first_ + index * taylor::stride; }
  void start_at(Slot slot) { start_.rows.emplace_back(slot, row(slot)); }
  [[nodiscard]] double* new_row() { return row(rows_used_++); }
  [[nodiscard]] bool is_row_of_slot(const double* pointer) { return pointer < row(tape_.slots_); }
  void find_own_starts();

  /// What the kernels point to must stay where it is.
  template <class T>
  [[nodiscard]] std::span<T> kept(const std::vector<T>& list) {
    T* const place = std::pmr::polymorphic_allocator<T>(&lists_).allocate(list.size());
    std::uninitialized_copy(list.begin(), list.end(), place);
    return {place, list.size()};
  }

  const CompiledFunction& tape_;
  const Workspace& constants_;
  std::size_t coordinates_;
  std::vector<bool> varies_;
  std::vector<Form> forms_;   ///< of slots that are sums
  std::vector<bool> is_sum_;  ///< slots with a form
  std::vector<Uses> uses_;
  std::vector<double> rows_;
  std::size_t first_{};  ///< coefficient 1 of a row begins a vector register's worth of memory
  std::size_t rows_used_{};
  double* one_{};  ///< the rate of the time
  std::pmr::monotonic_buffer_resource lists_;
  TaylorStart<double> start_;
  std::vector<taylor::Step> steps_;
  std::vector<std::pair<Function, Slot>> partners_;  ///< of hyperbolic steps, in their order: argument's slot
  taylor::Program program_;
};

}  // namespace qdot
