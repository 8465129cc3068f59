#include <array>

#include "core/expr/print/forms.hpp"
#include "core/expr/print/one_line.hpp"

namespace qdot {
namespace {

constexpr std::array<std::string_view, 35> python_keywords{
    "False", "None",     "True",  "and",    "as",   "assert", "async",  "await",    "break",
    "class", "continue", "def",   "del",    "elif", "else",   "except", "finally",  "for",
    "from",  "global",   "if",    "import", "in",   "is",     "lambda", "nonlocal", "not",
    "or",    "pass",     "raise", "return", "try",  "while",  "with",   "yield"};

constexpr std::array<std::string_view, 34> c_keywords{
    "auto",   "break",    "case",     "char",     "const", "continue", "default", "do",     "double",
    "else",   "enum",     "extern",   "float",    "for",   "goto",     "if",      "inline", "int",
    "long",   "register", "restrict", "return",   "short", "signed",   "sizeof",  "static", "struct",
    "switch", "typedef",  "union",    "unsigned", "void",  "volatile", "while"};

constexpr Language plain_text{.keywords = {},
                              .pi = "pi",
                              .numbers = Language::Numbers::decimal,
                              .ratio = "",
                              .power = "^",
                              .abs = "abs(#)",
                              .sign = "sign(#)"};

constexpr Language python{.keywords = python_keywords,
                          .pi = "pi",
                          .numbers = Language::Numbers::exact,
                          .ratio = "Rational",
                          .power = "**",
                          .abs = "Abs(#)",
                          .sign = "sign(#)"};

constexpr Language maxima_input{.keywords = {},
                                .pi = "%pi",
                                .numbers = Language::Numbers::exact,
                                .ratio = "",
                                .power = "^",
                                .abs = "abs(#)",
                                .sign = "signum(#)"};

constexpr Language c99{.keywords = c_keywords,
                       .pi = "3.141592653589793",  // C99 has no M_PI
                       .numbers = Language::Numbers::floating_point,
                       .ratio = "",
                       .power = "",
                       .abs = "fabs(#)",
                       .sign = "(((#) > 0) - ((#) < 0))"};

}  // namespace

std::string text_form(const Layout& layout, NodeId id, const Notation&) {
  return one_line(layout, id, plain_text);
}

std::string sympy_form(const Layout& layout, NodeId id, const Notation&) {
  return one_line(layout, id, python);
}

std::string maxima_form(const Layout& layout, NodeId id, const Notation&) {
  return one_line(layout, id, maxima_input);
}

std::string c_form(const Layout& layout, NodeId id, const Notation&) { return one_line(layout, id, c99); }

}  // namespace qdot
