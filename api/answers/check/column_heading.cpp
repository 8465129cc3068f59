#include "api/answers/check/column_heading.hpp"

#include <optional>

#include "api/json/text.hpp"
#include "core/base/error.hpp"
#include "core/grading/plain_notation.hpp"
#include "core/mechanics/units.hpp"

namespace qdot::api {
namespace {

struct NameAndUnit {
  std::string_view name;
  std::optional<Unit> unit{};
};

/// "l [cm]", "l (cm)" and "l/cm" in two; a heading whose end is no unit stays whole.
NameAndUnit parted(std::string_view cell) {
  for (const auto& [opens, closes] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t open = cell.rfind(opens);
    if (!cell.ends_with(closes) || open == std::string_view::npos || open == 0) continue;
    if (auto unit = parse_unit(cell.substr(open + 1, cell.size() - open - 2)))
      return {trimmed(cell.substr(0, open)), std::move(unit)};
  }
  const std::size_t slash = cell.find('/');
  if (slash == std::string_view::npos || slash == 0) return {cell};
  auto unit = parse_unit(cell.substr(slash + 1));
  return unit ? NameAndUnit{trimmed(cell.substr(0, slash)), std::move(unit)} : NameAndUnit{cell};
}

/// "θ̇" and "theta'" as theta_dot; what is no name stays as it is.
std::string plain_name(std::string_view name) {
  constexpr std::size_t longest = 80;
  if (name.size() > longest) return std::string(name);
  try {
    std::string plain(trimmed(plain_notation(name)));
    if (plain.ends_with('\'') && !plain.ends_with("''")) plain = plain.substr(0, plain.size() - 1) + "_dot";
    return lower_case(plain) == "time" ? "t" : plain;
  } catch (const Error&) {
    return std::string(name);
  }
}

}  // namespace

ColumnHeading column_heading(std::string_view cell) {
  const auto [name, unit] = parted(trimmed(cell));
  ColumnHeading heading{.name = plain_name(name)};
  if (!unit) return heading;
  heading.factor = unit->to_si(Number(1)).value;
  heading.has_unit = true;
  heading.dimension = unit->dimension;
  return heading;
}

}  // namespace qdot::api
