#pragma once
// A scene is data: where things are, as expressions of the coordinates, and nothing that follows from it.
// Every string that is not a name, a unit or prose is an expression (core/expr/parse.hpp) in the scene's
// parameters, coordinates q, velocities q_dot, held lengths, inputs and the time t.

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/numerics/crossing.hpp"

namespace qdot {

/// The interval in which a number makes sense: "> 0" is lower = 0, lower_open = true.
struct Domain {
  double lower{-std::numeric_limits<double>::infinity()};
  double upper{std::numeric_limits<double>::infinity()};
  bool lower_open{false};
  bool upper_open{false};

  [[nodiscard]] bool contains(double value) const {
    return (lower_open ? value > lower : value >= lower) && (upper_open ? value < upper : value <= upper);
  }
};

struct Parameter {
  std::string name;
  std::string unit;           ///< "kg", "N/m", "rad/s", "1"; see core/mechanics/dimension_check.hpp
  std::string default_value;  ///< a number or an expression of the other parameters, "2*m"
  Domain domain;
  std::string meaning;
  std::string latex;  ///< empty: from the name
};

struct Coordinate {
  std::string name;
  std::string unit;          ///< of the coordinate; its velocity `<name>_dot` has unit/s
  std::string initial;       ///< default initial value, an expression of the parameters
  std::string initial_rate;  ///< default initial velocity
  std::string scale;         ///< optional length that turns an angle into an arc, "l"
  /// Where the coordinate describes a configuration: l > 0. Leaving it ends every motion.
  Domain domain;
  std::string meaning;
  std::string latex;
};

/// A function of time that a request supplies, such as a force F(t).
struct Input {
  std::string name;
  std::string unit;
  std::string default_value;  ///< expression in t and the parameters
  std::string meaning;
};

/// A length that the motion keeps at `value`.
/// It is varied to derive the reaction that keeps it (see Reaction).
struct HeldLength {
  std::string name;
  std::string unit;
  std::string value;  ///< expression of the parameters
  std::string meaning;
};

/// Either the name of one of the scene's points, or its own components (2 or 3).
struct Position {
  std::string point;
  std::vector<std::string> components;
};

/// A named point, in an inertial frame: x, y (up) in the plane, x, y, z (up) in space.
struct Point {
  std::string name;
  std::vector<std::string> components;
};

struct Particle {
  std::string name;
  std::string mass;
  Position position;
};

/// Uniform slender rod: T = m/6 (vA.vA + vA.vB + vB.vB), exact in space.
struct SlenderRod {
  std::string name;
  std::string mass;
  Position start;
  Position end;
};

/// A turn about an axis through the body's centre, which the turns before it have carried along.
struct Rotation {
  std::vector<std::string> axis{};  ///< of any length but 0
  std::string angle{};
};

/// How a body is turned from the axes of space (core/mechanics/rotation.hpp): by a sequence such as ZXZ and
/// an angle for each of its letters, or by rotations one after the other.
struct Orientation {
  std::string sequence{};
  std::vector<std::string> angles{};
  std::vector<Rotation> rotations{};
};

/// A body that has a size in every direction. In the plane T = m/2 v.v + I/2 angle_dot^2; in space
/// T = m/2 v.v + (I1 w1^2 + I2 w2^2 + I3 w3^2)/2 with the angular velocity w in the body's axes.
struct RigidBody {
  std::string name{};
  std::string mass{};
  std::string shape{};                           ///< of core/mechanics/shapes.hpp; "rigid_body" without one
  std::map<std::string, std::string> sizes{};    ///< of its shape, by their names
  std::string inertia{};                         ///< in the plane, where there is no shape
  std::vector<std::string> principal_moments{};  ///< I1, I2, I3 in space, where there is no shape
  Position centre{};
  std::string angle{};                       ///< in the plane, counter-clockwise
  std::optional<Orientation> orientation{};  ///< in space
};

using Body = std::variant<Particle, SlenderRod, RigidBody>;

/// V = k/2 (length - rest_length)^2, the length being an expression or the distance of two places; or, of a
/// torsion spring, V = k/2 (angle - rest_angle)^2.
struct Spring {
  std::string name{};
  std::string stiffness{};
  std::string length{};
  std::string rest_length{};
  std::vector<Position> between{};  ///< two places, or none
  std::string angle{};
  std::string rest_angle{};
};

/// The force -c s' along s, or -c |s'| s' where it is quadratic: s an expression, the distance of two places,
/// an angle, or the way of a point through a medium at rest.
struct Damper {
  enum class Law { linear, quadratic };
  std::string name{};
  std::string coefficient{};  ///< c
  Law law{Law::linear};
  std::string length{};
  std::vector<Position> between{};  ///< two places, or none
  std::string angle{};
  std::optional<Position> point{};
};

/// Q_i = vector . d(point)/dq_i, or value * d(along)/dq_i, or torque . d(omega)/dq_i_dot with the angular
/// velocity omega of a body in space.
struct Force {
  std::string name{};
  std::vector<std::string> vector{};
  Position point{};
  std::string value{};
  std::string along{};
  std::vector<std::string> torque{};
  std::string body{};
};

/// What every motion obeys: `expression` stays 0. Holonomic where no velocity stands in it, x^2 + y^2 - l^2;
/// else linear in the velocities, such as rolling x_dot - r*theta_dot or a knife edge. Both may contain t.
/// Its force on q_i is multiplier * d(expression)/dq_i, or * d(expression)/dq_i_dot where it has velocities:
/// it does no work on any displacement that the constraint allows.
struct Constraint {
  std::string name;
  std::string expression;
  std::string multiplier;  ///< what expressions call it; empty: lambda_<name>
  std::string meaning;
};

[[nodiscard]] inline std::string multiplier_name(const Constraint& constraint) {
  return constraint.multiplier.empty() ? "lambda_" + constraint.name : constraint.multiplier;
}

/// The generalized force that keeps `length`: sign (d/dt dL/dlength' - dL/dlength) with length held.
/// A string pulls inwards, so its tension has sign -1; a normal force pushes outwards, sign +1.
struct Reaction {
  std::string length;
  int sign{1};
};

/// The model holds while `quantity` >= 0.
struct ValidityCondition {
  std::string name;  ///< the column's name, "tension"
  std::string unit;
  std::variant<Reaction, std::string> quantity;  ///< a derived reaction, or an expression
  std::string reason;                            ///< code of the ending, "string_slack"
  std::string message;                           ///< the sentence to print when it fails
};

/// A quantity to know beside the conditions, such as the friction that rolling asks for; it limits nothing.
struct Report {
  std::string name;
  std::string unit;
  std::variant<Reaction, std::string> quantity;
  std::string meaning;
};

/// The coordinates describe no configuration where `expression` is 0: every motion ends there.
struct Singularity {
  std::string name;
  std::string expression;
  std::string message;
};

struct SceneEvent {
  std::string name;
  std::string expression;  ///< the event is a zero of this
  Crossing direction{Crossing::either};
  std::string when;  ///< optional: expression that is > 0 where the crossing counts, "-theta"
  std::string meaning;
};

/// At `event`, the state jumps: as a map says; or by an impulse along the gradient of the event's expression,
/// which returns `restitution` of the speed at which that falls; or by a contact that is made, where a point
/// comes to rest, while the one that held the system until then is left (core/mechanics/impacts.hpp).
struct Impact {
  std::string event{};
  std::vector<std::pair<std::string, std::string>> map{};  ///< of the state before
  std::string meaning{};
  std::string restitution{};
  std::string contact_made{}, contact_left{};  ///< names of points
  /// What the coordinates are called afterwards, where the contact that is made takes the place of the one
  /// that is left.
  std::vector<std::pair<std::string, std::string>> renamed{};
};

/// Units of the dimensionless form: expressions of the parameters with dimensions kg, m and s.
struct Scales {
  std::string mass;
  std::string length;
  std::string time;
  /// What a parameter over its scale is called: {"m", "mu"}. Others become `<name>_hat`.
  std::vector<std::pair<std::string, std::string>> names;
};

struct Scene {
  std::string name;
  std::string title;
  std::string problem;  ///< number on the practice sheet, or empty
  std::string model_version;
  std::string description;
  /// Everything is a number, t included, as textbooks print Lagrangians: no dimension is asked for.
  bool without_units{false};
  std::vector<Parameter> parameters;
  std::vector<Coordinate> coordinates;
  std::vector<Input> inputs;
  std::vector<HeldLength> held_lengths;
  std::vector<Point> points;
  std::vector<Body> bodies;
  std::vector<std::string>
      gravity;  ///< acceleration vector, as many components as the positions; may be empty
  std::vector<Spring> springs;
  std::vector<Damper> dampers;
  std::string potential;  ///< extra potential energy, or empty
  std::vector<Force> forces;
  std::vector<Constraint> constraints;
  std::string dissipation;  ///< Rayleigh function D: Q_i = -dD/dq_i_dot, or empty
  std::string lagrangian;   ///< instead of bodies, gravity, springs and potential
  std::vector<ValidityCondition> valid_while;
  std::vector<Report> reports;
  std::vector<Singularity> singular_where;
  std::vector<SceneEvent> events;
  std::optional<Impact> impact;  ///< where there is one only
  std::vector<Impact> impacts;   ///< where there are several: those of one instant follow in this order
  std::optional<Scales> scales;
  std::vector<std::vector<std::string>> lines;  ///< drawing hint: chains of points to join

  [[nodiscard]] bool has_impacts() const { return impact || !impacts.empty(); }
};

/// One mistake in a scene.
struct Diagnostic {
  std::string place;     ///< path inside the scene, "/bodies/0/position/1"
  std::string code;      ///< unknown_symbol, syntax, dimension, duplicate_name, domain, missing, ...
  std::string message;   ///< one sentence that names the symbol and says what to write instead
  std::string symbol{};  ///< of unknown_symbol
  std::string meant{};   ///< product of symbols for it; or empty
  std::vector<std::string> allowed{};  ///< the symbols that may stand there
};

}  // namespace qdot
