#pragma once
// What the Taylor kernels work on for two motions side by side, from what they work on for each of them.

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/compile/taylor/translation.hpp"

namespace qdot {

class PairTranslation {
 public:
  /// Of translations of one tape, as they are before their first start, and needed no more later. `slots` is
  /// where evaluations are found.
  PairTranslation(const TaylorTranslation& first, const TaylorTranslation& second,
                  std::span<const PairOfDoubles> slots);
  PairTranslation(const PairTranslation&) = delete;
  PairTranslation& operator=(const PairTranslation&) = delete;

  /// Whether both take the same steps; they do not where a sum of numbers is zero in one of them.
  [[nodiscard]] bool is_possible() const { return is_possible_; }
  /// Coefficients 0. False where one of both has to go alone.
  [[nodiscard]] bool start() { return start_.begin(slots_, steps_.data()); }
  [[nodiscard]] const taylor::PairProgram& program() const { return program_; }

 private:
  using Step = taylor::BasicStep<PairOfDoubles>;
  using Solve = taylor::BasicSolve<PairOfDoubles>;

  [[nodiscard]] bool takes_same_steps() const;
  [[nodiscard]] bool is_same(const double* a, const double* b) const;
  [[nodiscard]] bool is_same(const taylor::Step& a, const taylor::Step& b) const;
  [[nodiscard]] bool is_same(const taylor::Solve& a, const taylor::Solve& b) const;

  void take_rows();
  void take_systems();
  void take_steps();
  void take_start();
  [[nodiscard]] Step step(const taylor::Step& a, const taylor::Step& b);
  [[nodiscard]] const Solve* solve(const taylor::Solve& a, const taylor::Solve& b);
  /// The place in rows of both that is this one in the first's.
  [[nodiscard]] PairOfDoubles* at(const double* of_first);
  template <class T>
  [[nodiscard]] T* places(std::size_t count) {
    T* const place = std::pmr::polymorphic_allocator<T>(&lists_).allocate(count);
    std::uninitialized_value_construct_n(place, count);
    return place;
  }

  const TaylorTranslation &a_, &b_;  ///< while they are read
  std::span<const PairOfDoubles> slots_;
  bool is_possible_;
  std::vector<PairOfDoubles> rows_;
  PairOfDoubles* first_{};
  std::pmr::monotonic_buffer_resource lists_;
  std::vector<Step> steps_;
  TaylorStart<PairOfDoubles> start_;
  taylor::PairProgram program_;
};

}  // namespace qdot
