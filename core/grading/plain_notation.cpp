#include "core/grading/plain_notation.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/base/error.hpp"

namespace qdot {
namespace {

struct Sign {
  char32_t code;
  std::string_view plain;
};

constexpr std::array letters{
    Sign{U'α', "alpha"},   Sign{U'β', "beta"},    Sign{U'γ', "gamma"}, Sign{U'δ', "delta"},
    Sign{U'ε', "epsilon"}, Sign{U'ϵ', "epsilon"}, Sign{U'ζ', "zeta"},  Sign{U'η', "eta"},
    Sign{U'θ', "theta"},   Sign{U'ϑ', "theta"},   Sign{U'κ', "kappa"}, Sign{U'λ', "lambda"},
    Sign{U'μ', "mu"},      Sign{U'µ', "mu"},      Sign{U'ν', "nu"},    Sign{U'ξ', "xi"},
    Sign{U'π', "pi"},      Sign{U'ρ', "rho"},     Sign{U'σ', "sigma"}, Sign{U'τ', "tau"},
    Sign{U'φ', "phi"},     Sign{U'ϕ', "phi"},     Sign{U'χ', "chi"},   Sign{U'ψ', "psi"},
    Sign{U'ω', "omega"},   Sign{U'Γ', "Gamma"},   Sign{U'Δ', "Delta"}, Sign{U'Θ', "Theta"},
    Sign{U'Λ', "Lambda"},  Sign{U'Σ', "Sigma"},   Sign{U'Φ', "Phi"},   Sign{U'Ψ', "Psi"},
    Sign{U'Ω', "Omega"},   Sign{U'Ω', "Omega"},   Sign{U'ℓ', "l"}};

/// Letters with one dot above and with two.
constexpr std::array dotted{Sign{U'ẋ', "x_dot"},  Sign{U'ẍ', "x_ddot"}, Sign{U'ẏ', "y_dot"},
                            Sign{U'ÿ', "y_ddot"}, Sign{U'ż', "z_dot"},  Sign{U'ṙ', "r_dot"},
                            Sign{U'ṡ', "s_dot"},  Sign{U'ṗ', "p_dot"},  Sign{U'ṫ', "t_dot"},
                            Sign{U'ü', "u_ddot"}};

constexpr std::array signs{
    Sign{U'·', "*"},      Sign{U'⋅', "*"},      Sign{U'∙', "*"},      Sign{U'×', "*"},
    Sign{U'−', "-"},      Sign{U'–', "-"},      Sign{U'÷', "/"},      Sign{U'∕', "/"},
    Sign{U'⁄', "/"},      Sign{U'∗', "*"},      Sign{U'′', "'"},      Sign{U'’', "'"},
    Sign{U'″', "''"},     Sign{U'”', "''"},     Sign{U'√', "sqrt"},   Sign{U'½', "(1/2)"},
    Sign{U'¼', "(1/4)"},  Sign{U'¾', "(3/4)"},  Sign{U'⅓', "(1/3)"},  Sign{U'⅔', "(2/3)"},
    Sign{U'\u00A0', " "}, Sign{U'\u2009', " "}, Sign{U'\u202F', " "}, Sign{U'\u2061', " "},
    Sign{U'\u2062', " "}, Sign{U'\u200B', " "}, Sign{U'\uFEFF', " "}};

constexpr std::array superscripts{Sign{U'⁰', "0"}, Sign{U'¹', "1"}, Sign{U'²', "2"}, Sign{U'³', "3"},
                                  Sign{U'⁴', "4"}, Sign{U'⁵', "5"}, Sign{U'⁶', "6"}, Sign{U'⁷', "7"},
                                  Sign{U'⁸', "8"}, Sign{U'⁹', "9"}, Sign{U'⁻', "-"}};
constexpr std::array subscripts{Sign{U'₀', "0"}, Sign{U'₁', "1"}, Sign{U'₂', "2"}, Sign{U'₃', "3"},
                                Sign{U'₄', "4"}, Sign{U'₅', "5"}, Sign{U'₆', "6"}, Sign{U'₇', "7"},
                                Sign{U'₈', "8"}, Sign{U'₉', "9"}};

constexpr char32_t dot_above = U'\u0307', two_dots_above = U'\u0308';

std::string_view find(const auto& table, char32_t code) {
  for (const Sign& sign : table) {
    if (sign.code == code) return sign.plain;
  }
  return {};
}

[[noreturn]] void refuse(const std::string& message, std::size_t offset) {
  throw Error(ErrorCode::syntax, message, offset);
}

/// The character at the beginning of `text`, and its bytes. Throws Error(syntax) for what is not UTF-8.
std::pair<char32_t, std::size_t> decoded(std::string_view text, std::size_t offset) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < size) refuse("the text is not UTF-8", offset);
  char32_t code = first & (0xFFU >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) refuse("the text is not UTF-8", offset);
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  return {code, size};
}

bool is_ascii_letter(char32_t c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

class UnicodeReader {
 public:
  explicit UnicodeReader(std::string_view text) : text_(text) {}

  std::string read() {
    while (at_ < text_.size()) {
      const auto [code, size] = decoded(text_.substr(at_), at_);
      const std::size_t offset = at_;
      at_ += size;
      if (code < 0x80) {
        ascii(code);
      } else if (const auto letter = find(letters, code); !letter.empty()) {
        name(std::string(letter));
      } else if (const auto dots = find(dotted, code); !dots.empty()) {
        name(std::string(dots));
      } else {
        other(code, offset);
      }
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] char32_t next() const {
    return at_ < text_.size() ? decoded(text_.substr(at_), at_).first : U'\0';
  }

  void ascii(char32_t code) {
    const char32_t after = is_ascii_letter(code) ? next() : U'\0';
    if (after == dot_above || after == two_dots_above) return name(std::string(1, static_cast<char>(code)));
    if (code == '"' || code == '`') {
      out_ += code == '"' ? "''" : "'";  // theta" is what keyboards make of theta''
    } else {
      out_ += static_cast<char>(code);
    }
  }

  /// A name apart from what stands beside it, unless that belongs to it: θ₀, θ_dot.
  void name(std::string word) {
    std::string dots;
    for (char32_t c = next(); c == dot_above || c == two_dots_above; c = next()) {
      dots = c == dot_above && dots.empty() ? "_dot" : "_ddot";
      at_ += decoded(text_.substr(at_), at_).second;
    }
    std::string index;
    for (auto digit = find(subscripts, next()); !digit.empty(); digit = find(subscripts, next())) {
      index += digit;
      at_ += decoded(text_.substr(at_), at_).second;
    }
    if (!index.empty()) word += "_" + index;
    const char32_t after = next();
    const bool goes_on = after == '_' || after == '\'' || after == '(' || (after >= '0' && after <= '9');
    out_ += " " + word + dots + (goes_on ? "" : " ");
  }

  void other(char32_t code, std::size_t offset) {
    if (const auto sign = find(signs, code); !sign.empty()) {
      out_ += sign;
    } else if (!find(superscripts, code).empty()) {
      power(code);
    } else if (!find(subscripts, code).empty()) {
      out_ += "_";
      out_ += find(subscripts, code);
    } else {
      refuse("there is a character that formulas do not have", offset);
    }
  }

  /// Brackets only around what needs them: d²θ/dt² is d^2 theta/dt^2.
  void power(char32_t code) {
    std::string exponent(find(superscripts, code));
    for (auto more = find(superscripts, next()); !more.empty(); more = find(superscripts, next())) {
      exponent += more;
      at_ += decoded(text_.substr(at_), at_).second;
    }
    const bool is_digit = exponent.size() == 1 && exponent != "-" && exponent != "1";
    out_ += is_digit ? "^" + exponent + " " : "^(" + exponent + ")";
  }

  std::string_view text_;
  std::size_t at_{0};
  std::string out_;
};

}  // namespace

std::string without_unicode(std::string_view text) { return UnicodeReader(text).read(); }

std::string plain_notation(std::string_view text, std::size_t longest) {
  if (text.size() > longest) {
    throw Error(ErrorCode::too_large, "the text is longer than " + std::to_string(longest) + " bytes");
  }
  return without_latex(without_unicode(text));
}

}  // namespace qdot
