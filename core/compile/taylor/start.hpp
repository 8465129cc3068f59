#pragma once
// Coefficients 0 of the rows, and what the kernels multiply by instead of dividing: of one motion, or of two
// side by side.

#include <span>
#include <utility>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/compile/taylor/kernels.hpp"

namespace qdot {

template <class Number>
struct TaylorStart {
  struct System {
    std::size_t n{};
    std::vector<Slot> matrix_slots;
    Slot determinant_slot{};
    bool has_determinant{};
    std::vector<Number> matrix, inverse;
  };
  struct Entries {
    std::span<taylor::BasicEntry<Number>> all;
    const taylor::BasicSolve<Number>* solve{};
  };
  /// A step that begins with more than a slot's value.
  struct Own {
    std::size_t step{};
    bool is_row_of_slot{};
    Function partner{};    ///< of a hyperbolic one, and
    Slot argument_slot{};  ///< what that is of
  };

  std::vector<std::pair<Slot, Number*>> rows;  ///< of slots, where they are used
  /// Steps whose first coefficient the numbers give by which they have the others, instead of a slot: sums
  /// and linear systems in which constants were put together. Rounded otherwise, 1 part in 1e16 for ever the
  /// same, coefficients 0 and the rest would belong to two motions, and the energy would drift.
  std::vector<std::size_t> put_together;
  Number* time{};
  std::vector<taylor::BasicProduct<Number>*> products;
  std::vector<System> systems;
  std::vector<Entries> entries;  ///< of each system that is solved
  std::vector<Own> own;

  /// From the slots of an evaluation. False where a mass matrix has no inverse, and of two motions where one
  /// of them has reached a limit.
  [[nodiscard]] bool begin(std::span<const Number> slots, taylor::BasicStep<Number>* steps);
};

}  // namespace qdot
