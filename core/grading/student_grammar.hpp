#pragma once
// The recursive descent behind read_submission: one function a rule of the grammar in student_parser.hpp.

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/grading/equation_labels.hpp"
#include "core/grading/read_equation.hpp"
#include "core/grading/student_tokens.hpp"
#include "core/grading/vocabulary.hpp"

namespace qdot {

/// Whether blanks between factors say anything: g/l x is read in one way, and no reader of LaTeX sees them.
enum class Blanks { are_seen, are_not_seen };

class StudentGrammar {
 public:
  StudentGrammar(std::string_view plain, Graph& graph, const Vocabulary& vocabulary, Blanks blanks)
      : tokens_(without_labels(student_tokens(plain))),
        graph_(graph),
        vocabulary_(vocabulary),
        blanks_(blanks),
        first_node_(graph.size()) {}

  /// Throws Error with what to write instead.
  std::vector<ReadEquation> whole();

 private:
  static constexpr int deepest = 64;

  [[nodiscard]] const StudentToken& token(std::size_t ahead = 0) const {
    return tokens_[std::min(next_ + ahead, tokens_.size() - 1)];
  }
  [[nodiscard]] bool at(Mark mark, std::size_t ahead = 0) const { return token(ahead).mark == mark; }
  [[nodiscard]] bool at_word(std::string_view word, std::size_t ahead = 0) const {
    return at(Mark::name, ahead) && token(ahead).text == word;
  }
  [[nodiscard]] bool at_number(const Number& value, std::size_t ahead) const {
    return at(Mark::number, ahead) && token(ahead).value == value;
  }
  bool accept(Mark mark);

  // sums and products
  ReadEquation equation();
  Expression sum();
  Expression term();
  /// Whether the factor that began there is a number and nothing else.
  [[nodiscard]] bool is_plain_number(std::size_t first) const;
  Expression divisor(bool is_fraction);
  bool signs();
  Expression signed_factor();
  [[nodiscard]] bool begins_factor() const;
  Expression factor();

  // powers
  Expression exponent();
  Expression raised(const Expression& base, const Expression& exponent);

  // what stands alone
  Expression primary();
  Expression bracket();
  void close();
  Expression between_bars();
  Expression named();
  /// Rational(3, 4), as SymPy prints it.
  Expression rational();
  Expression primed(Expression e);
  /// e without the "(t)" behind it: theta(t), theta''(t).
  Expression of_time(const Expression& e);
  Expression rate_of(const Expression& e);
  /// Puts the words that the token is made of in its place.
  void cut_word();
  [[noreturn]] void refuse_unknown(const StudentToken& word) const;
  /// "sin2" of a lost superscript or of twice an angle.
  void refuse_joined_number(const StudentToken& word) const;

  // functions
  Expression application();
  /// sin theta, sin 2 theta, cos Omega t.
  Expression bare_argument(const StudentToken& function);
  Expression lone_number(const std::vector<Expression>& factors, const StudentToken& function);
  /// sin theta^2, sin theta/2
  /// Whether a bracket opens there with a symbol in it: by that no angle is divided.
  [[nodiscard]] bool opens_with_symbols(std::size_t ahead) const;
  void refuse_ambiguous_end(const std::string& name, const Expression& argument) const;

  // derivatives
  [[nodiscard]] bool derivative_begins() const;
  /// diff, Derivative, or Mathematica's D where that is no symbol.
  [[nodiscard]] bool is_derivative_call() const;
  std::optional<Expression> derivative();
  /// d theta/dt, d^2 theta/dt^2, d^2/dt^2 theta
  std::optional<Expression> leibniz();
  /// "/dt" or "/dt^2" that many tokens ahead.
  [[nodiscard]] bool ends_with_dt(std::size_t ahead, bool is_second) const;
  /// dtheta/dt, d2theta/dt2
  std::optional<Expression> leibniz_of_word();
  /// d(l^2 theta')/dt
  std::optional<Expression> leibniz_of_bracket();
  /// diff(theta, t), diff(theta, t, t), diff(theta, t, 2), Derivative(theta(t), (t, 2))
  Expression called_derivative();

  // bounds and complaints
  template <class Read>
  Expression nested(Read read) {
    if (++depth_ > deepest) refuse("the formula is nested too deep", token().offset, ErrorCode::too_large);
    const Expression result = read();
    --depth_;
    return result;
  }
  [[nodiscard]] Expression checked(const Expression& e) const;
  [[noreturn]] void refuse_rest() const;

  [[noreturn]] static void refuse(const std::string& message, std::size_t offset = 0,
                                  ErrorCode code = ErrorCode::syntax) {
    throw Error(code, message, offset);
  }

  std::vector<StudentToken> tokens_;
  Graph& graph_;
  const Vocabulary& vocabulary_;
  Blanks blanks_;
  std::size_t first_node_;
  std::size_t next_{0};
  int depth_{0};
  int open_bars_{0};
};

}  // namespace qdot
