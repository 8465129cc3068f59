#include "api/contract/domain_text.hpp"

#include <charconv>
#include <cmath>
#include <vector>

#include "api/json/text.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

enum class Side { below, above };

struct Bound {
  Side side{Side::below};  ///< "> 0" bounds from below
  bool open{false};
  double value{0};
};

std::optional<double> finite_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<Bound> parse_bound(std::string_view text) {
  text = trimmed(text);
  if (text.empty() || (text.front() != '>' && text.front() != '<')) return std::nullopt;
  Bound bound{.side = text.front() == '>' ? Side::below : Side::above,
              .open = !text.substr(1).starts_with('=')};
  const auto value = finite_number(trimmed(text.substr(bound.open ? 1 : 2)));
  if (!value) return std::nullopt;
  bound.value = *value;
  return bound;
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t comma = text.find(','); comma != std::string_view::npos; comma = text.find(',')) {
    parts.push_back(text.substr(0, comma));
    text.remove_prefix(comma + 1);
  }
  parts.push_back(text);
  return parts;
}

}  // namespace

std::optional<Domain> parse_domain(std::string_view text) {
  Domain domain;
  const auto parts = split_at_commas(text);
  if (parts.size() > 2) return std::nullopt;
  for (const std::string_view part : parts) {
    const auto bound = parse_bound(part);
    if (!bound) return std::nullopt;
    double& end = bound->side == Side::below ? domain.lower : domain.upper;
    if (std::isfinite(end)) return std::nullopt;
    end = bound->value;
    (bound->side == Side::below ? domain.lower_open : domain.upper_open) = bound->open;
  }
  const bool one_point = domain.lower == domain.upper && !domain.lower_open && !domain.upper_open;
  if (domain.lower < domain.upper || one_point) return domain;
  return std::nullopt;
}

std::string domain_pattern() {
  const std::string blanks = "[ \\t]*";
  const std::string number = R"(-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)";
  const std::string bound = blanks + "[<>]=?" + blanks + number + blanks;
  return "^" + bound + "(," + bound + ")?$";
}

std::string to_text(const Domain& domain) {
  const auto bound = [](const char* relation, double value) {
    std::string text(relation);
    append_number(text, value);
    return text;
  };
  std::string text;
  if (std::isfinite(domain.lower)) text += bound(domain.lower_open ? "> " : ">= ", domain.lower);
  if (std::isfinite(domain.upper)) {
    text += (text.empty() ? "" : " and ") + bound(domain.upper_open ? "< " : "<= ", domain.upper);
  }
  return text;
}

}  // namespace qdot::api
