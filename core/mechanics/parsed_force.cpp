#include "core/mechanics/parsed_force.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"
#include "core/mechanics/scene_text.hpp"

namespace qdot {
namespace {

/// Multiplied out (x - 99)^2 + y^2 is longer, and loses digits far from zero.
Expression shorter(const Expression& written, const Expression& simplified) {
  return written_length(written) < written_length(simplified) ? written : simplified;
}

/// |B - A|.
Expression distance_of(const std::vector<Position>& between, const std::string& place, SceneText& text) {
  const Vector a = text.read_position(between.front(), place + "/0");
  const Vector b = text.read_position(between.back(), place + "/1");
  std::vector<Expression> squares;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    squares.push_back(pow(b[i] - a[i], Number(2)));
  const Expression written = a.front().graph().sum(squares);
  const Expression square = shorter(written, simplify(written));
  if (square.is_zero() && !text.has_complaint_below(place))
    text.complain(place, "no_distance", "These two places are one: nothing can be stretched between them.");
  return sqrt(square);
}

/// u where e = u^2, of a product of even powers.
std::optional<Expression> root_of_square(const Expression& e) {
  Graph& graph = e.graph();
  const auto [coefficient, rest] = split_coefficient(e);
  const auto number = exact_root(coefficient);
  if (!number) return std::nullopt;
  Expression root = graph.number(*number);
  const auto* product = std::get_if<Product>(&rest.node());
  for (const NodeId id : product == nullptr ? std::vector<NodeId>{rest.id()} : product->factors) {
    const auto [base, exponent] = split_power(Expression(graph, id));
    const Number half = exponent * Number::ratio(1, 2);
    if (!half.is_integer()) return std::nullopt;
    root = root * pow(base, half);
  }
  return root;
}

/// |u| on a line or a circle, where a root of u^2 would hide that it has a kink.
Expression size_of(const Vector& v) {
  std::vector<Expression> squares;
  for (const Expression& component : v) squares.push_back(component * component);
  Graph& graph = v.front().graph();
  const Expression square = simplify(graph.sum(squares));
  const auto u = square.is_zero() ? std::nullopt : root_of_square(square);
  return u ? graph.call(Function::abs, *u) : sqrt(square);
}

/// What the damper works along: a point, or one quantity.
Vector way_of(const Damper& damper, const std::string& place, SceneText& text) {
  if (damper.point) return text.read_position(*damper.point, place + "/point");
  if (!damper.between.empty()) return {distance_of(damper.between, place + "/between", text)};
  if (!damper.angle.empty())
    return {text.read(damper.angle, Context::configuration, place + "/angle", Dimension{})};
  return {text.read(damper.length, Context::configuration, place + "/length", dimension_of_unit("m"))};
}

void require_partner(bool is_missing, const std::string& field, const std::string& meaning,
                     const std::string& place, SceneText& text) {
  if (is_missing) text.complain(place, "missing", "'" + field + "' is missing: " + meaning + ".");
}

const char* unit_of_coefficient(const Damper& damper) {
  const bool quadratic = damper.law == Damper::Law::quadratic;
  if (!damper.angle.empty()) return quadratic ? "kg*m^2" : "N*m*s";
  return quadratic ? "kg/m" : "N*s/m";
}

}  // namespace

ParsedSpring parse_spring(const Spring& spring, const std::string& place, SceneText& text) {
  const auto read = [&](const std::string& e, Context context, const char* field, const char* unit) {
    return text.read(e, context, place + field, dimension_of_unit(unit));
  };
  if (!spring.angle.empty()) {
    return {read(spring.stiffness, Context::parameters, "/stiffness", "N*m"),
            read(spring.angle, Context::configuration, "/angle", "rad"),
            read(spring.rest_angle, Context::parameters, "/rest_angle", "rad")};
  }
  const Expression stiffness = read(spring.stiffness, Context::parameters, "/stiffness", "N/m");
  const Expression length = spring.between.empty()
                                ? read(spring.length, Context::configuration, "/length", "m")
                                : distance_of(spring.between, place + "/between", text);
  return {stiffness, length, read(spring.rest_length, Context::parameters, "/rest_length", "m")};
}

ParsedForce parse_damper(const Damper& damper, const std::string& place, SceneText& text,
                         std::span<const Replacement> rates) {
  const Expression coefficient = text.read(damper.coefficient, Context::parameters, place + "/coefficient",
                                           dimension_of_unit(unit_of_coefficient(damper)));
  const Vector way = way_of(damper, place, text);
  Vector velocity, force;
  for (const Expression& x : way) velocity.push_back(total_derivative(x, rates));
  const Expression factor =
      damper.law == Damper::Law::quadratic ? coefficient * size_of(velocity) : coefficient;
  for (const Expression& v : velocity) force.push_back(-(factor * v));
  return {force, way};
}

ParsedForce parse_force(const Force& force, const std::string& place, SceneText& text) {
  if (force.value.empty()) {
    require_partner(force.point.point.empty() && force.point.components.empty(), "point",
                    "where the force is applied", place, text);
    if (text.has_complaint(place)) return {};
    return {text.read_vector(force.vector, Context::motion, place + "/vector", dimension_of_unit("N")),
            text.read_position(force.point, place + "/point")};
  }
  require_partner(force.along.empty(), "along", "the quantity that it pushes along", place, text);
  if (force.along.empty()) return {};
  const Expression along = text.read(force.along, Context::configuration, place + "/along", std::nullopt);
  const auto dimension = text.dimension(along);
  const auto of_value = dimension ? std::optional(*dimension_of_unit("J") / *dimension) : std::nullopt;
  return {{text.read(force.value, Context::motion, place + "/value", of_value)}, {along}};
}

ParsedTorque parse_torque(const Force& force, const std::string& place, SceneText& text,
                          const std::vector<ParsedBody>& bodies, std::span<const Replacement> rates) {
  ParsedTorque torque{
      text.read_vector(force.torque, Context::motion, place + "/torque", dimension_of_unit("N*m")), {}};
  torque.angular_velocity.assign(torque.vector.size(), torque.vector.front().graph().number(0));
  const auto body = std::ranges::find(bodies, force.body, &ParsedBody::name);
  if (force.body.empty()) {
    require_partner(true, "body", "the name of the body that it turns", place, text);
  } else if (body == bodies.end()) {
    text.complain(place + "/body", "unknown_body", "There is no body '" + force.body + "' in this scene.");
  } else if (body->turns.empty()) {
    text.complain(place + "/body", "not_applicable",
                  "'" + force.body +
                      "' has no orientation in space: give a torque in the plane as 'value' along an angle.");
  } else if (torque.vector.size() == 3) {
    torque.angular_velocity = space_angular_velocity(torque.vector.front().graph(), body->turns, rates);
  }
  return torque;
}

}  // namespace qdot
