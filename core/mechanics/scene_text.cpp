#include "core/mechanics/scene_text.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/expr/parse.hpp"

namespace qdot {
namespace {

std::string error_code(const ParseError& error) {
  switch (error.code) {
    case ErrorCode::unknown_symbol:
      return "unknown_symbol";
    case ErrorCode::too_large:
      return "too_large";
    default:
      return "syntax";
  }
}

constexpr std::size_t short_text = 24;  ///< bytes: one sees at once what is meant

std::string sentence(const ParseError& error, const std::string& text) {
  const bool has_place = error.code != ErrorCode::unknown_symbol && text.size() > short_text;
  return error.message + (has_place ? ", at byte " + std::to_string(error.offset) + "." : ".");
}

}  // namespace

std::optional<Dimension> dimension_of_unit(const std::string& text) {
  const std::optional<Unit> unit = parse_unit(text);
  return unit ? std::optional(unit->dimension) : std::nullopt;
}

void SceneText::complain(const std::string& place, const std::string& code, const std::string& message) {
  diagnostics_.push_back({.place = place, .code = code, .message = message});
}

bool SceneText::has_complaint(const std::string& place) const {
  return std::ranges::find(diagnostics_, place, &Diagnostic::place) != diagnostics_.end();
}

bool SceneText::has_complaint_below(const std::string& place) const {
  return std::ranges::any_of(diagnostics_, [&](const Diagnostic& d) {
    return d.place == place || d.place.starts_with(place + "/");
  });
}

Expression SceneText::declare(const std::string& name, const std::optional<Dimension>& dimension,
                              Context context, const std::string& place) {
  const Expression symbol = graph_.symbol(name);
  // A coordinate's name is said before that of its velocity, which nobody wrote.
  if (!declared_.insert(name).second && !has_complaint(place)) {
    complain(place, "duplicate_name", "The name '" + name + "' is used twice.");
  }
  if (dimension) dimensions_[symbol.id()] = *dimension;
  if (context == Context::parameters) exponent_symbols_.parameters.push_back(symbol);
  for (int c = static_cast<int>(context); c <= static_cast<int>(Context::motion); ++c)
    allowed_[c].push_back(name);
  return symbol;
}

void SceneText::declare_varying(Symbols::Varying& varying, const std::string& name,
                                const std::optional<Dimension>& dimension, Context value, Context rate,
                                const std::string& place) {
  const Dimension second = parse_unit("s")->dimension;
  const auto over_time = [&](const std::optional<Dimension>& d) {
    return d ? std::optional(*d / second) : std::nullopt;
  };
  varying.value.push_back(declare(name, dimension, value, place + "/name"));
  varying.rate.push_back(declare(name + "_dot", over_time(dimension), rate, place + "/name"));
  varying.second_rate.push_back(graph_.symbol(name + "_ddot"));
  if (dimension) dimensions_[varying.second_rate.back().id()] = *dimension / second / second;
}

std::optional<Dimension> SceneText::unit(const std::string& text, const std::string& place) {
  if (dimensions_kind_ == Dimensions::none) {
    if (text.empty() || text == "1" || text == "rad") return Dimension{};
    complain(place + "/unit", "exclusive",
             "The scene has no units: leave '" + text + "' out, or write rad where it is an angle.");
    return std::nullopt;
  }
  if (text.empty()) {
    complain(place + "/unit", "missing",
             "'unit' is missing: write 1 where there is none, or \"units\": \"none\" for the whole scene.");
    return std::nullopt;
  }
  const std::optional<Unit> unit = parse_unit(text);
  if (unit && unit->is_coherent()) return unit->dimension;
  complain(place + "/unit", "unknown_unit",
           unit ? "The unit '" + text + "' is not an SI unit without a prefix; write kg, m, s, rad, N, J, ..."
                : "The unit '" + text + "' is not known; write a product of SI units such as kg*m/s^2.");
  return std::nullopt;
}

Expression SceneText::read(const std::string& text, Context context, const std::string& place,
                           const std::optional<Dimension>& expected) {
  const ParseResult result = parse_all(text, graph_, allowed_[static_cast<int>(context)]);
  const std::vector<std::string>& allowed = allowed_[static_cast<int>(context)];
  for (const ParseError& error : result.errors) {
    complain(place, error_code(error), sentence(error, text));
    if (error.code != ErrorCode::unknown_symbol) continue;
    diagnostics_.back().symbol = error.symbol;
    diagnostics_.back().meant = error.product;
    diagnostics_.back().allowed = allowed;
  }
  if (!result.expression) return graph_.number(0);
  check_dimension(*result.expression, place, expected);
  return with_exponents(with_followers(*result.expression), exponent_symbols_, exponents_, found_exponents_);
}

Expression SceneText::with_followers(const Expression& e) {
  if (followers_.empty()) return e;
  if (following_.empty())
    following_ = follower_replacements(graph_, followers_, allowed_[static_cast<int>(Context::parameters)]);
  return substitute(e, following_);
}

std::optional<Expression> SceneText::read_optional(const std::string& text, Context context,
                                                   const std::string& place,
                                                   const std::optional<Dimension>& expected) {
  if (text.empty()) return std::nullopt;
  return read(text, context, place, expected);
}

void SceneText::check_dimension(const Expression& e, const std::string& place,
                                const std::optional<Dimension>& expected) {
  if (dimensions_kind_ == Dimensions::none) return;
  const DimensionResult found = dimension_of(e, dimensions_);
  if (!found.mistake.empty()) {
    complain(place, "wrong_dimension", "The expression's dimensions do not fit: " + found.mistake + ".");
  } else if (expected && found.dimension && *found.dimension != *expected && e.number() == nullptr) {
    complain(place, "wrong_dimension",
             "The expression is in " + to_text(*found.dimension) + ", but " + to_text(*expected) +
                 " belongs here.");
  }
}

Vector SceneText::read_vector(const std::vector<std::string>& components, Context context,
                              const std::string& place, const std::optional<Dimension>& dimension) {
  Vector vector;
  for (std::size_t i = 0; i < components.size(); ++i) {
    vector.push_back(read(components[i], context, place + "/" + std::to_string(i), dimension));
  }
  if (space_ == 0) space_ = components.size();
  if (components.size() != space_ || space_ < 2 || space_ > 3) {
    complain(place, "components", "Positions and vectors have two components, or all of them three.");
    vector.resize(zero_vector().size(), graph_.number(0));
  }
  return vector;
}

Vector SceneText::read_position(const Position& position, const std::string& place) {
  if (position.point.empty())
    return read_vector(position.components, Context::configuration, place, dimension_of_unit("m"));
  const auto found =
      std::ranges::find(points_, position.point, [](const auto& point) { return point.first; });
  if (found != points_.end()) return found->second;
  complain(place, "unknown_point", "There is no point '" + position.point + "' in this scene.");
  return zero_vector();
}

Vector SceneText::zero_vector() const { return Vector(std::max<std::size_t>(space_, 2), graph_.number(0)); }

}  // namespace qdot
