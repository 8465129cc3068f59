#include "core/grading/student_parser.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/parse_tokens.hpp"
#include "core/grading/student_functions.hpp"
#include "core/grading/student_tokens.hpp"

namespace qdot {
namespace {

constexpr int deepest = 64;
constexpr double largest_exponent = 64;
constexpr std::size_t most_nodes = 2000;
constexpr std::size_t most_words = 8000;

[[noreturn]] void refuse(const std::string& message, std::size_t offset = 0,
                         ErrorCode code = ErrorCode::syntax) {
  throw Error(code, message, offset);
}

class StudentParser {
 public:
  StudentParser(std::string_view plain, Graph& graph, const Vocabulary& vocabulary)
      : tokens_(student_tokens(plain)), graph_(graph), vocabulary_(vocabulary), first_node_(graph.size()) {}

  std::vector<ReadEquation> whole() {
    std::vector<ReadEquation> equations;
    for (;;) {
      while (at(Mark::line) || at(Mark::comma)) ++next_;
      if (at(Mark::end)) break;
      equations.push_back(equation());
      if (!at(Mark::line) && !at(Mark::comma) && !at(Mark::end)) refuse_rest();
    }
    if (equations.empty()) refuse("there is no formula");
    return equations;
  }

 private:
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
  bool accept(Mark mark) {
    if (!at(mark)) return false;
    ++next_;
    return true;
  }

  // --- sums and products ---------------------------------------------------------------------------------

  ReadEquation equation() {
    if (at_word("Eq") && at(Mark::open, 1)) {
      next_ += 2;
      const Expression left = sum();
      if (!accept(Mark::comma)) refuse("Eq has two sides, with a comma between them");
      const Expression right = sum();
      close();
      return {left, right};
    }
    const Expression left = sum();
    if (!accept(Mark::equals)) return {left, std::nullopt};
    const Expression right = sum();
    if (at(Mark::equals)) refuse("there are two equals signs in one equation");
    return {left, right};
  }

  Expression sum() {
    std::vector<Expression> terms{term()};
    while (at(Mark::plus) || at(Mark::minus)) {
      const bool is_negative = at(Mark::minus);
      ++next_;
      const Expression next = term();
      terms.push_back(is_negative ? -next : next);
    }
    return terms.size() == 1 ? terms[0] : checked(graph_.sum(terms));
  }

  Expression term() {
    const bool is_negative = signs();
    std::size_t before = next_;
    std::vector<Expression> factors{factor()};
    for (;;) {
      if (accept(Mark::times)) {
        before = next_;
        factors.push_back(signed_factor());
      } else if (accept(Mark::over)) {
        factors.push_back(divisor(is_plain_number(before)));
        before = tokens_.size();
      } else if (begins_factor()) {
        before = next_;
        factors.push_back(factor());
      } else {
        break;
      }
    }
    const Expression product = factors.size() == 1 ? factors[0] : checked(graph_.product(factors));
    return is_negative ? -product : product;
  }

  /// Whether the factor that began there is a number and nothing else.
  [[nodiscard]] bool is_plain_number(std::size_t first) const {
    return first < tokens_.size() && tokens_[first].mark == Mark::number && next_ == first + 2;
  }

  Expression divisor(bool is_fraction) {
    const std::size_t first = next_;
    const Expression e = signed_factor();
    if (e.is_zero()) refuse("division by zero");
    // g/2l and g/ml have two readings; 1/2m is a fraction before m.
    const bool is_single = next_ == first + 1;
    const bool goes_on = at(Mark::name) && !token().is_apart && !is_function_word(token().text);
    const bool fraction = is_fraction && tokens_[first].mark == Mark::number;
    if (is_single && goes_on && !fraction) {
      const std::string divisor(tokens_[first].text), next(token().text);
      refuse("'/" + divisor + next + "' has two readings: write /(" + divisor + "*" + next + ") or /" +
                 divisor + "*" + next,
             token().offset);
    }
    return checked(pow(e, Number(-1)));
  }

  bool signs() {
    bool is_negative = false;
    for (; at(Mark::plus) || at(Mark::minus); ++next_) is_negative ^= at(Mark::minus);
    return is_negative;
  }

  Expression signed_factor() {
    const bool is_negative = signs();
    const Expression e = factor();
    return is_negative ? -e : e;
  }

  [[nodiscard]] bool begins_factor() const {
    if (at(Mark::number)) refuse("two factors stand side by side: write * before the number", token().offset);
    return at(Mark::name) || at(Mark::open);
  }

  Expression factor() {
    const Expression base = primary();
    if (!accept(Mark::power)) return base;
    return raised(base, exponent());
  }

  // --- powers ----------------------------------------------------------------------------------------------

  Expression exponent() {
    const bool is_negative = signs();
    const bool is_one = at_number(1, 0);  // x^1/2 is meant as a root
    const Expression e = nested([this] {
      const Expression base = primary();
      return accept(Mark::power) ? raised(base, exponent()) : base;
    });
    if (is_one && at(Mark::over) && at(Mark::number, 1))
      refuse("a fraction in an exponent needs brackets: x^(1/2)", token().offset);
    return is_negative ? -e : e;
  }

  Expression raised(const Expression& base, const Expression& exponent) {
    const Number* number = exponent.number();
    if (number == nullptr) return checked(pow(base, exponent));
    if (std::abs(number->value()) > largest_exponent)
      refuse("an exponent is larger than 64", token().offset, ErrorCode::too_large);
    if (base.is_zero() && number->is_negative()) refuse("division by zero", token().offset);
    return checked(pow(base, *number));
  }

  // --- what stands alone -----------------------------------------------------------------------------------

  Expression primary() {
    spend_work(1);
    const StudentToken& first = token();
    if (accept(Mark::number)) return checked(graph_.number(first.value));
    if (at(Mark::open)) return bracket();
    if (accept(Mark::bar)) return between_bars();
    if (at(Mark::name)) return named();
    refuse(at(Mark::end) ? "the formula ends where a number, a symbol or a bracket is needed"
                         : "a number, a symbol or a bracket is needed at " + excerpt(first.text),
           first.offset);
  }

  Expression bracket() {
    ++next_;
    const Expression inside = nested([this] { return sum(); });
    close();
    return inside;
  }

  void close() {
    if (accept(Mark::close)) return;
    if (at(Mark::end)) refuse("a bracket is not closed");
    refuse_rest();
  }

  Expression between_bars() {
    const Expression inside = nested([this] { return sum(); });
    if (!accept(Mark::bar)) refuse("a bar | is not closed", token().offset);
    return checked(graph_.call(Function::abs, inside));
  }

  Expression named() {
    if (const auto found = derivative()) return primed(*found);
    if (at_word("Rational") && at(Mark::open, 1)) return rational();
    cut_word();
    const std::string_view word = token().text;
    if (!vocabulary_.find(word)) return application();
    const Expression e = *vocabulary_.find(word);
    ++next_;
    const bool is_of_time = at(Mark::open) && at_word("t", 1) && at(Mark::close, 2);
    if (is_of_time && vocabulary_.varies(e)) next_ += 3;  // theta(t)
    return primed(e);
  }

  /// Rational(3, 4), as SymPy prints it.
  Expression rational() {
    next_ += 2;
    const Expression above = nested([this] { return sum(); });
    if (!accept(Mark::comma)) refuse("Rational has two numbers, with a comma between them", token().offset);
    const Expression below = nested([this] { return sum(); });
    close();
    if (below.is_zero()) refuse("division by zero", token().offset);
    return checked(above / below);
  }

  Expression primed(Expression e) {
    while (accept(Mark::prime)) e = rate_of(e);
    return e;
  }

  Expression rate_of(const Expression& e) {
    if (!vocabulary_.varies(e))
      refuse("only coordinates have derivatives here, up to the second", token().offset);
    const Expression rate = total_derivative(e, vocabulary_.rates());
    if (rate.is_zero()) refuse("only coordinates have derivatives here, up to the second", token().offset);
    return checked(rate);
  }

  /// Puts the words that the token is made of in its place.
  void cut_word() {
    const StudentToken whole = token();
    const auto knows = [&](std::string_view w) { return vocabulary_.find(w) || is_function_word(w); };
    const bool is_word = knows(whole.text);
    if (is_word && (vocabulary_.is_certain(whole.text) || is_function_word(whole.text))) return;
    const auto found = cuts(whole.text, knows);
    if (found.empty() && whole.text == "e" && at(Mark::power, 1)) return;
    if (found.empty()) refuse_unknown(whole);
    if (found.size() > 1)
      refuse(excerpt(whole.text) + " has two readings: write its products with *", whole.offset);
    if (tokens_.size() + found[0].size() > most_words)
      refuse("the formula has too many words", whole.offset, ErrorCode::too_large);
    std::vector<StudentToken> words;
    for (const std::string_view word : found[0]) {
      words.push_back({.mark = Mark::name, .text = word, .offset = whole.offset, .is_apart = false});
    }
    words.front().is_apart = whole.is_apart;
    const auto here = tokens_.begin() + static_cast<std::ptrdiff_t>(next_);
    *here = words.front();
    tokens_.insert(here + 1, words.begin() + 1, words.end());
  }

  [[noreturn]] void refuse_unknown(const StudentToken& word) const {
    std::string names;
    for (const std::string& name : vocabulary_.names()) names += (names.empty() ? "" : ", ") + name;
    refuse("unknown symbol " + excerpt(word.text) + "; there are " + names, word.offset,
           ErrorCode::unknown_symbol);
  }

  // --- functions -------------------------------------------------------------------------------------------

  Expression application() {
    const StudentToken word = token();
    ++next_;
    if (word.text == "e") {
      ++next_;  // the ^ that cut_word saw
      return checked(graph_.call(Function::exp, exponent()));
    }
    std::optional<Expression> power;
    if (accept(Mark::power)) {
      power = exponent();
      const Number* number = power->number();
      if (number == nullptr || number->is_negative())
        refuse("sin^-1 has two readings: write asin or 1/sin", word.offset);
    }
    const Expression argument = at(Mark::open) ? bracket() : bare_argument(word);
    const auto value = applied(word.text, argument);
    if (!value) refuse(excerpt(word.text) + " has no value there", word.offset);
    return power ? raised(checked(*value), *power) : checked(*value);
  }

  /// sin theta, sin 2 theta, cos Omega t.
  Expression bare_argument(const StudentToken& function) {
    const std::string name(function.text);
    std::vector<Expression> factors;
    if (at(Mark::number)) {
      factors.push_back(graph_.number(token().value));
      ++next_;
    }
    if (!at(Mark::name) || (derivative_begins() && factors.empty())) return lone_number(factors, function);
    cut_word();
    const auto word = vocabulary_.find(token().text);
    if (!word) refuse("write brackets around the argument of " + name, token().offset);
    ++next_;
    const Expression last = primed(*word);
    factors.push_back(last);
    const bool is_parameter = !vocabulary_.varies(last) && !(last == vocabulary_.time());
    if (is_parameter && at(Mark::name)) {
      cut_word();
      const auto next = vocabulary_.find(token().text);
      if (next && !(*next == vocabulary_.time()))
        refuse("write brackets around the argument of " + name, token().offset);
      if (next) {
        factors.push_back(*next);
        ++next_;
      }
    }
    refuse_ambiguous_end(name, last);
    return checked(graph_.product(factors));
  }

  Expression lone_number(const std::vector<Expression>& factors, const StudentToken& function) {
    const std::string name(function.text);
    if (factors.empty()) refuse("write brackets around the argument of " + name, token().offset);
    if (at(Mark::open) || at(Mark::times) || at(Mark::over) || at(Mark::power))
      refuse("write brackets around the argument of " + name, token().offset);
    return factors[0];
  }

  /// sin theta^2, sin theta/2
  void refuse_ambiguous_end(const std::string& name, const Expression& argument) const {
    const bool is_clear = vocabulary_.is_angle(argument) && at(Mark::name, 1);
    const bool is_divided = at(Mark::over) && !is_clear;
    if (at(Mark::power) || is_divided)
      refuse("write brackets around the argument of " + name, token().offset);
  }

  // --- derivatives -----------------------------------------------------------------------------------------

  [[nodiscard]] bool derivative_begins() const {
    const std::string_view word = token().text;
    return word == "diff" || word == "Derivative" || word == "dot" || word == "ddot" ||
           (word == "d" && (at_word("dt", 2) || at_word("dt", 4)));
  }

  std::optional<Expression> derivative() {
    const std::string_view word = token().text;
    if ((word == "diff" || word == "Derivative") && at(Mark::open, 1)) return called_derivative();
    if ((word == "dot" || word == "ddot") && at(Mark::open, 1)) {
      ++next_;
      const Expression inside = rate_of(bracket());
      return word == "dot" ? inside : rate_of(inside);
    }
    if (const auto of_word = leibniz_of_word()) return of_word;
    if (word != "d") return std::nullopt;
    if (at(Mark::over, 1) && at_word("dt", 2)) {  // d/dt (...)
      next_ += 3;
      return rate_of(nested([this] { return primary(); }));
    }
    return leibniz();
  }

  /// d theta/dt, d^2 theta/dt^2, d^2/dt^2 theta
  std::optional<Expression> leibniz() {
    const bool is_second = at(Mark::power, 1) && at_number(2, 2);
    const std::size_t next = is_second ? 3 : 1;
    const std::size_t after = is_second ? 4 : 2;
    if (is_second && at(Mark::over, next) && ends_with_dt(next, true)) {
      next_ += next + 4;
      return rate_of(rate_of(nested([this] { return primary(); })));
    }
    if (!at(Mark::name, next) || !ends_with_dt(after, is_second)) return std::nullopt;
    const auto word = vocabulary_.find(token(next).text);
    if (!word || !vocabulary_.varies(*word)) return std::nullopt;
    next_ += after + (is_second ? 4 : 2);
    return is_second ? rate_of(rate_of(*word)) : rate_of(*word);
  }

  /// "/dt" or "/dt^2" that many tokens ahead.
  [[nodiscard]] bool ends_with_dt(std::size_t ahead, bool is_second) const {
    if (!at(Mark::over, ahead) || !at_word("dt", ahead + 1)) return false;
    return !is_second || (at(Mark::power, ahead + 2) && at_number(2, ahead + 3));
  }

  /// dtheta/dt, d2theta/dt2
  std::optional<Expression> leibniz_of_word() {
    const std::string_view word = token().text;
    const bool is_second = word.starts_with("d2");
    const std::string_view rest = word.substr(std::min<std::size_t>(is_second ? 2 : 1, word.size()));
    if (!word.starts_with('d') || rest.empty() || !at(Mark::over, 1)) return std::nullopt;
    if (!at_word(is_second ? "dt2" : "dt", 2)) return std::nullopt;
    const auto symbol = vocabulary_.find(rest);
    if (!symbol || !vocabulary_.varies(*symbol)) return std::nullopt;
    next_ += 3;
    return is_second ? rate_of(rate_of(*symbol)) : rate_of(*symbol);
  }

  /// diff(theta, t), diff(theta, t, t), diff(theta, t, 2), Derivative(theta(t), (t, 2))
  Expression called_derivative() {
    next_ += 2;
    Expression e = nested([this] { return sum(); });
    int order = 0;
    while (accept(Mark::comma)) {
      const bool is_pair = accept(Mark::open);
      if (at_word("t")) {
        ++next_;
        ++order;
        if (!is_pair) continue;
        if (!accept(Mark::comma)) refuse("a derivative is by t here", token().offset);
      }
      if (!at_number(1, 0) && !at_number(2, 0)) refuse("a derivative is by t here", token().offset);
      order += at_number(2, 0) ? 1 : 0;
      ++next_;
      if (is_pair) close();
    }
    close();
    if (order == 0) refuse("a derivative is by t here: diff(theta, t)", token().offset);
    for (int i = 0; i < order; ++i) e = rate_of(e);
    return e;
  }

  // --- bounds and complaints -------------------------------------------------------------------------------

  template <class Read>
  Expression nested(Read read) {
    if (++depth_ > deepest) refuse("the formula is nested too deep", token().offset, ErrorCode::too_large);
    const Expression result = read();
    --depth_;
    return result;
  }

  [[nodiscard]] Expression checked(const Expression& e) const {
    spend_work(1);
    if (graph_.size() - first_node_ > most_nodes)
      refuse("the formula has too many parts", token().offset, ErrorCode::too_large);
    const Number coefficient = split_coefficient(e).coefficient;
    if (!std::isfinite(coefficient.value()))
      refuse("a number in the formula is outside the range of a double", token().offset,
             ErrorCode::too_large);
    return e;
  }

  [[noreturn]] void refuse_rest() const {
    if (at(Mark::close)) refuse("there is no opening bracket for a closing one", token().offset);
    refuse("an operator is needed before " + excerpt(token().text), token().offset);
  }

  std::vector<StudentToken> tokens_;
  Graph& graph_;
  const Vocabulary& vocabulary_;
  std::size_t first_node_;
  std::size_t next_{0};
  int depth_{0};
};

}  // namespace

ReadSubmission read_submission(std::string_view text, Graph& graph, const Vocabulary& vocabulary) {
  ReadSubmission result;
  try {
    const std::string plain = plain_notation(text);
    result.equations = StudentParser(plain, graph, vocabulary).whole();
  } catch (const Error& error) {
    result.errors.emplace_back(error.what());
  }
  return result;
}

}  // namespace qdot
