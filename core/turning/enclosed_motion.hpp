#pragma once
// Quantities along a periodic motion of one coordinate, enclosed over whole pieces of it, so that what is
// said of their least values and signs holds between any two places.
//
// Between turning points a and b the states are those of x = a + (b - a) sin^2 s from both ends and in both
// directions; of a rotation those of one turn. The velocity follows from the energy, the ignored velocities
// from their momenta, which are linear in them. Pieces on which the motion does not come to rest are
// enclosed to second order (core/numerics/taylor_enclosure.hpp).
// Source: Ratschek, Rokne, New Computer Methods for Global Optimization (1988), chapters 3 and 4.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/turning/energy_balance.hpp"

namespace qdot {

/// Where a periodic motion goes.
struct PeriodicWay {
  Interval from, to;    ///< x, enclosed
  bool turns_back{};    ///< at both ends; else it goes round
  double direction{1};  ///< of a rotation
};

/// The least value that a quantity takes, and the state where it is reached.
struct LeastValue {
  double value{};
  Interval range;  ///< which it is in
  double x{}, x_dot{};
};

enum class Vanishes { never, changes_sign, undecided };

class EnclosedMotion {
 public:
  /// `values`: functions of (q, q'). `momenta`: those of the reduction's ignored coordinates. What is given
  /// by reference must outlive it.
  EnclosedMotion(EnergyBalance& energy, const PeriodicWay& way, const CompiledFunction& values,
                 const Dynamics& dynamics, const Reduction& reduction, const Reals& parameters,
                 std::span<const Ball> momenta, const Reals& y0);
  ~EnclosedMotion();

  /// Of the value number `index`; nothing where it cannot be enclosed.
  [[nodiscard]] std::optional<LeastValue> least(std::size_t index);
  [[nodiscard]] Vanishes vanishes(std::size_t index);

 private:
  struct Piece {
    Interval s;
    bool from_far_end{};
    double direction{1};
  };
  struct Seen;
  template <class T>
  class Values;

  [[nodiscard]] std::vector<Piece> whole_way() const;
  [[nodiscard]] Seen look(const Piece& piece, std::size_t index);
  [[nodiscard]] static std::vector<Piece> halves(const Piece& piece);

  EnergyBalance& energy_;
  PeriodicWay way_;
  std::shared_ptr<const CompiledFunction> momentum_function_;
  std::unique_ptr<Values<Interval>> plain_;
  std::unique_ptr<Values<Curvature>> curved_;  ///< neither where the functions solve equations
};

}  // namespace qdot
