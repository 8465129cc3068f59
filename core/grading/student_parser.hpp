#pragma once
// Reading submissions, as students write them: theta'' + (g/l) sin theta = 0.
//
//   equation = sum [ = sum ]                              also Eq(sum, sum)
//   sum      = term { (+|-) term }
//   term     = {+|-} factor { (*|/) {+|-} factor | factor }   a product needs no sign: 1/2 m l^2
//   factor   = primary [ ^ exponent ]
//   primary  = number | Rational(p, q) | word { ' } | word(t) | function [ ^ number ] argument | ( sum ) | |
//   sum | | derivative derivative = dx/dt | d^2 x/dt^2 | d/dt ( sum ) | diff(x, t) | Derivative(x(t), (t, 2))
//   | dot(x) | ddot(x)
//
// A word that is not known is cut into words that are: mgl is m g l. An argument without brackets is one
// word, with a number before it or, for a parameter, the time behind it: sin 2 theta, cos Omega t. What two
// readers would read in two ways is refused with what to write instead: g/2l, sin theta^2, sin theta/2.
//
// Text, nodes and depth are bounded as in core/expr/parse.hpp.

#include <string>
#include <string_view>
#include <vector>

#include "core/grading/read_equation.hpp"
#include "core/grading/vocabulary.hpp"

namespace qdot {

struct ReadSubmission {
  std::vector<ReadEquation> equations;  ///< one a line
  std::vector<std::string> errors;      ///< why it could not be read; then there are no equations
};

/// Reads into the graph of the vocabulary's symbols.
[[nodiscard]] ReadSubmission read_submission(std::string_view text, Graph& graph,
                                             const Vocabulary& vocabulary);

}  // namespace qdot
