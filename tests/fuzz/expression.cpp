// A text that is an expression is printed as a text that is the same expression, and in every notation.

#include <string>
#include <vector>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "tests/fuzz/law.hpp"

namespace {

using namespace qdot;

/// A print may be too long, or need what Number cannot hold, and says so.
template <class Use>
void unless_refused(Use use) {
  try {
    use();
  } catch (const Error& error) {
    fuzz::require(*error.what() != '\0', "an error has a sentence");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<std::string> symbols{"m", "g", "l", "t", "theta", "theta_dot", "phi"};
  const std::string_view text = fuzz::text_of(data, size);
  Graph graph;
  const ParseResult result = parse_all(text, graph, symbols);
  fuzz::require(result.expression.has_value() == result.errors.empty(), "an expression or errors");
  for (const ParseError& error : result.errors) {
    fuzz::require(error.offset <= text.size(), "an error stands in the text");
    fuzz::require(!error.message.empty(), "an error has a message");
  }
  if (!result.expression) return 0;
  unless_refused([&] {
    const std::string printed = print(*result.expression, Form::text);
    const ParseLimits wide{.bytes = std::size_t{1} << 21,
                           .tokens = std::size_t{1} << 20,
                           .integer_digits = 400,
                           .depth = 4000,
                           .exponent = 100'000,
                           .nodes = 100'000};
    const ParseResult again = parse_all(printed, graph, symbols, wide);
    fuzz::require(again.expression.has_value(), "what is printed can be parsed");
    fuzz::require(*again.expression == *result.expression, "and is the same expression");
  });
  for (const PrintForm& form : print_forms()) {
    unless_refused(
        [&] { fuzz::require(!print(*result.expression, form.form).empty(), "a form is not empty"); });
  }
  return 0;
}
