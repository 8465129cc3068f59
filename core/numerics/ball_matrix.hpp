#pragma once
// Complex numbers known to lie in products of two balls, and square matrices of balls.

#include <complex>
#include <vector>

#include "core/numerics/ball.hpp"
#include "core/numerics/same_bits.hpp"

namespace qdot {

struct ComplexBall {
  Ball re, im;

  ComplexBall() = default;
  ComplexBall(const Ball& real, const Ball& imaginary = {}) : re(real), im(imaginary) {}  // implicit
};

[[nodiscard]] inline ComplexBall operator+(const ComplexBall& a, const ComplexBall& b) {
  return {a.re + b.re, a.im + b.im};
}
[[nodiscard]] inline ComplexBall operator-(const ComplexBall& a, const ComplexBall& b) {
  return {a.re - b.re, a.im - b.im};
}
[[nodiscard]] inline ComplexBall operator*(const ComplexBall& a, const ComplexBall& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
[[nodiscard]] ComplexBall operator/(const ComplexBall& a, const ComplexBall& b);

[[nodiscard]] inline double magnitude(const Ball& a) { return a.magnitude(); }
[[nodiscard]] inline double magnitude(const ComplexBall& a) {
  return hypotenuse(a.re.magnitude(), a.im.magnitude()) * (1 + 0x1p-50);
}
[[nodiscard]] inline Ball middle_of(const Ball& a) { return {a.middle, 0}; }
[[nodiscard]] inline ComplexBall middle_of(const ComplexBall& a) {
  return {middle_of(a.re), middle_of(a.im)};
}

/// n x n by rows; T is Ball or ComplexBall.
template <class T>
class SquareMatrix {
 public:
  explicit SquareMatrix(std::size_t size) : size_(size), entries_(size * size) {}
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T& operator()(std::size_t i, std::size_t j) { return entries_[i * size_ + j]; }
  [[nodiscard]] const T& operator()(std::size_t i, std::size_t j) const { return entries_[i * size_ + j]; }

 private:
  std::size_t size_;
  std::vector<T> entries_;
};

}  // namespace qdot
