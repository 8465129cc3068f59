#include "core/mechanics/parsed_body.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "core/expr/simplify.hpp"
#include "core/mechanics/scene_text.hpp"
#include "core/mechanics/shapes.hpp"

namespace qdot {
namespace {

class BodyParser {
 public:
  BodyParser(std::string place, SceneText& text, Graph& graph, std::span<const Replacement> rates)
      : place_(std::move(place)), text_(text), graph_(graph), rates_(rates) {}

  ParsedBody operator()(const Particle& body) {
    return of(body, text_.read_position(body.position, place_ + "/position"));
  }

  ParsedBody operator()(const SlenderRod& rod) {
    const Vector start = text_.read_position(rod.start, place_ + "/start");
    const Vector end = text_.read_position(rod.end, place_ + "/end");
    Vector middle, along;
    for (std::size_t i = 0; i < std::min(start.size(), end.size()); ++i) {
      middle.push_back(Number::ratio(1, 2) * (start[i] + end[i]));
      along.push_back(end[i] - start[i]);
    }
    ParsedBody body = of(rod, middle);
    body.marks = {start, end};
    for (const Expression& component : along) {
      body.spins.push_back({Number::ratio(1, 12) * body.mass, total_derivative(component, rates_),
                            Number::ratio(1, 4) * body.mass});
    }
    return body;
  }

  ParsedBody operator()(const RigidBody& rigid) {
    ParsedBody body = of(rigid, text_.read_position(rigid.centre, place_ + "/centre"));
    const bool in_space = body.centre.size() > 2;
    if (rigid.orientation) body.turns = read_turns(*rigid.orientation, place_ + "/orientation");
    if (!rigid.angle.empty())
      body.angle = text_.read(rigid.angle, Context::configuration, place_ + "/angle", Dimension{});
    check_space(rigid, in_space);
    if (in_space) {
      const std::array<Expression, 3> moments = principal_moments(rigid, body.mass);
      const Vector omega = angular_velocity(body.turns, moments);
      for (std::size_t k = 0; k < 3; ++k) {
        body.spins.push_back({moments[k], omega[k], zero()});
        body.marks.push_back(end_of_axis(body, k));
      }
    } else if (body.angle) {
      body.spins.push_back({moment_in_plane(rigid, body.mass), total_derivative(*body.angle, rates_),
                            more_at_rim(rigid, body.mass)});
    }
    return body;
  }

 private:
  [[nodiscard]] Expression zero() const { return graph_.number(0); }

  [[nodiscard]] Vector end_of_axis(const ParsedBody& body, std::size_t k) const {
    Vector axis(3, zero());
    axis[k] = graph_.number(1);
    Vector end = turned(body.turns, axis);
    for (std::size_t i = 0; i < 3; ++i) end[i] = end[i] + body.centre[i];
    return end;
  }

  template <class Kind>
  ParsedBody of(const Kind& body, const Vector& centre) {
    const Expression mass =
        text_.read(body.mass, Context::parameters, place_ + "/mass", dimension_of_unit("kg"));
    return {body.name, mass, centre, {}, std::nullopt, {}, {centre}};
  }

  /// In the body's axes; a last turn about an axis of symmetry changes no moment, and is left out of them.
  [[nodiscard]] Vector angular_velocity(std::span<const Turn> turns,
                                        const std::array<Expression, 3>& moments) const {
    if (turns.empty()) return body_angular_velocity(graph_, turns, rates_);
    const Turn& last = turns.back();
    const auto is_symmetric = [&](std::size_t k) {
      return last.axis[k].is_one() && moments[(k + 1) % 3] == moments[(k + 2) % 3];
    };
    if (!is_symmetric(0) && !is_symmetric(1) && !is_symmetric(2))
      return body_angular_velocity(graph_, turns, rates_);
    Vector omega = body_angular_velocity(graph_, turns.first(turns.size() - 1), rates_);
    const Expression rate = total_derivative(last.angle, rates_);
    for (std::size_t k = 0; k < 3; ++k) omega[k] = omega[k] + rate * last.axis[k];
    return omega;
  }

  void check_space(const RigidBody& rigid, bool in_space) {
    if (in_space && !rigid.angle.empty()) {
      text_.complain(place_ + "/angle", "not_applicable",
                     "In space one angle does not say where a body points: give its 'orientation'.");
    } else if (!in_space && rigid.orientation) {
      text_.complain(place_ + "/orientation", "not_applicable",
                     "In the plane a body turns about one axis only: give its 'angle', or three components "
                     "for every position.");
    }
    if (!in_space && !rigid.principal_moments.empty()) {
      text_.complain(place_ + "/principal_moments", "not_applicable",
                     "In the plane a body has one moment of inertia: give it as 'inertia'.");
    } else if (in_space && !rigid.inertia.empty()) {
      text_.complain(place_ + "/inertia", "not_applicable",
                     "In space a body has three moments of inertia: give them as 'principal_moments'.");
    }
  }

  Expression read_moment(const std::string& moment, const std::string& field) {
    return text_.read(moment, Context::parameters, place_ + field, dimension_of_unit("kg*m^2"));
  }

  std::array<Expression, 3> principal_moments(const RigidBody& rigid, const Expression& mass) {
    std::array<Expression, 3> moments{zero(), zero(), zero()};
    const Shape* shape = find_shape(rigid.shape);
    if (shape != nullptr) {
      moments = shape->gyration_squared(sizes_of(rigid, *shape, true));
      for (Expression& moment : moments) moment = mass * moment;
    }
    for (std::size_t k = 0; k < rigid.principal_moments.size() && k < 3; ++k)
      moments[k] = read_moment(rigid.principal_moments[k], "/principal_moments/" + std::to_string(k));
    return moments;
  }

  Expression moment_in_plane(const RigidBody& rigid, const Expression& mass) {
    const Shape* shape = find_shape(rigid.shape);
    if (shape != nullptr) return mass * shape->gyration_squared(sizes_of(rigid, *shape, false))[2];
    return rigid.inertia.empty() ? zero() : read_moment(rigid.inertia, "/inertia");
  }

  Expression more_at_rim(const RigidBody& rigid, const Expression& mass) {
    const Shape* shape = find_shape(rigid.shape);
    if (shape == nullptr || !shape->rolls) return zero();
    return mass * pow(sizes_of(rigid, *shape, false).front(), Number(2));
  }

  /// Read once, in the order of the shape; 0 where there is none.
  const std::vector<Expression>& sizes_of(const RigidBody& rigid, const Shape& shape, bool in_space) {
    if (!sizes_.empty()) return sizes_;
    for (const ShapeSize& size : shape.sizes) {
      const std::string place = place_ + "/" + size.name;
      const auto given = rigid.sizes.find(size.name);
      const bool is_needed = in_space || !size.along_axis_3;
      if (given == rigid.sizes.end()) {
        if (is_needed)
          text_.complain(place_, "missing", "'" + size.name + "' is missing: " + size.meaning + ".");
        sizes_.push_back(zero());
        continue;
      }
      if (!is_needed) {
        text_.complain(place, "not_applicable",
                       "In the plane nothing depends on '" + size.name + "': leave it out.");
      }
      sizes_.push_back(text_.read(given->second, Context::parameters, place, dimension_of_unit("m")));
    }
    return sizes_;
  }

  std::vector<Turn> read_turns(const Orientation& orientation, const std::string& place) {
    if (!orientation.sequence.empty()) return read_sequence(orientation, place);
    std::vector<Turn> turns;
    for (std::size_t k = 0; k < orientation.rotations.size(); ++k) {
      const std::string here = place + "/rotations/" + std::to_string(k);
      const Rotation& rotation = orientation.rotations[k];
      turns.push_back(
          {read_axis(rotation.axis, here + "/axis"), read_angle(rotation.angle, here + "/angle")});
    }
    return turns;
  }

  std::vector<Turn> read_sequence(const Orientation& orientation, const std::string& place) {
    const auto sequence = turn_sequence(orientation.sequence);
    if (!sequence) {
      text_.complain(place + "/sequence", "not_allowed",
                     "'sequence' names axes in order: ZXZ or ZYX about axes that turn with the body, zxz in "
                     "small letters about the fixed axes of space.");
      return {};
    }
    const std::size_t count = sequence->axes.size();
    if (orientation.angles.size() != count) {
      text_.complain(place + "/angles", "components",
                     "'" + orientation.sequence + "' has " + std::to_string(count) + " turns, and 'angles' " +
                         std::to_string(orientation.angles.size()) + ": one for each letter.");
      return {};
    }
    std::vector<Turn> turns;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t given = sequence->backwards ? count - 1 - k : k;
      Vector axis(3, zero());
      axis[sequence->axes[k]] = graph_.number(1);
      turns.push_back({std::move(axis),
                       read_angle(orientation.angles[given], place + "/angles/" + std::to_string(given))});
    }
    return turns;
  }

  Expression read_angle(const std::string& angle, const std::string& place) {
    return text_.read(angle, Context::configuration, place, Dimension{});
  }

  Vector read_axis(const std::vector<std::string>& components, const std::string& place) {
    Vector axis = text_.read_vector(components, Context::parameters, place, Dimension{});
    axis.resize(3, zero());
    const Expression square = simplify(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    if (square.is_zero()) {
      if (!text_.has_complaint_below(place))
        text_.complain(place, "domain", "This axis has no direction: all its components are 0.");
      return axis;
    }
    const std::optional<Number> whole =
        square.number() != nullptr ? exact_root(*square.number()) : std::nullopt;
    const Expression length = whole ? graph_.number(*whole) : sqrt(square);
    for (Expression& component : axis) component = component / length;
    return axis;
  }

  std::string place_;
  SceneText& text_;
  Graph& graph_;
  std::span<const Replacement> rates_;
  std::vector<Expression> sizes_;
};

}  // namespace

ParsedBody parse_body(const Body& body, const std::string& place, SceneText& text, Graph& graph,
                      std::span<const Replacement> rates) {
  return std::visit(BodyParser(place, text, graph, rates), body);
}

}  // namespace qdot
