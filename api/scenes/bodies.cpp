#include "api/scenes/bodies.hpp"

#include <functional>
#include <string>
#include <utility>

#include "api/scenes/scene_fields.hpp"
#include "core/mechanics/shapes.hpp"

namespace qdot::api {
namespace {

/// A kind of body, which beside `fields` has a name and a mass as all have.
template <class Struct>
BodyKind body(const std::string& kind, std::string description, std::vector<BoundField<Struct>> fields,
              std::vector<OneOf> one_of = {}, const std::function<void(Struct&)>& prepare = {}) {
  std::vector<BoundField<Struct>> all{
      {detail::info("kind", ChoiceKind{{kind}}, "what the body is", required)},
      value("name", &Struct::name, NameKind{}, "what the body is called"),
      value("mass", &Struct::mass, ExpressionKind{}, "its mass, an expression of the parameters",
            {.need = Need::required, .aliases = {"m"}}),
  };
  all.insert(all.end(), fields.begin(), fields.end());
  const Table<Struct> table(kind, std::move(description), std::move(all), std::move(one_of));
  return {table.set(), [table, prepare](const Json& resolved) -> Body {
            Struct result;
            if (prepare) prepare(result);
            table.store(resolved, result);
            return result;
          }};
}

const Table<Rotation> rotations(
    "rotation", "A turn about an axis through the body's centre.",
    {value("axis", &Rotation::axis, VectorKind{},
           "its direction in the axes that the rotations before it have turned, such as [0, 0, 1]", required),
     value("angle", &Rotation::angle, ExpressionKind{}, "how far, right-handed", required)});

const Table<Orientation> orientations(
    "orientation",
    "How the body's axes are turned from those of space: by a sequence and its angles, or by rotations one "
    "after the other.",
    {value(
         "sequence", &Orientation::sequence, TextKind{6},
         "one letter for each turn. Capital letters are axes that turn with the body: ZXZ are Euler's angles, "
         "ZYX yaw, pitch and roll. Small letters are the fixed axes of space"),
     value("angles", &Orientation::angles, ListKind{ExpressionKind{}, 6, 1}, "an angle for each letter"),
     records("rotations", &Orientation::rotations, rotations, 1, 6,
             "turns one after the other, each about an axis that those before it have carried along")},
    {{.ways = {{"sequence", "angles"}, {"rotations"}}, .need = Need::required}});

std::vector<BoundField<RigidBody>> place_fields() {
  return {value("centre", &RigidBody::centre, PositionKind{}, "where its centre of mass is",
                {.need = Need::required, .aliases = {"position"}}),
          value("angle", &RigidBody::angle, ExpressionKind{},
                "in the plane, how far it has turned against an inertial frame, counter-clockwise positive"),
          record("orientation", &RigidBody::orientation, orientations, "in space, how it is turned")};
}

const OneOf ways_of_turning{.ways = {{"angle"}, {"orientation"}}, .need = Need::required};

BodyKind body_of_shape(const Shape& shape) {
  std::vector<BoundField<RigidBody>> fields;
  for (const ShapeSize& size : shape.sizes) {
    const std::string meaning = size.meaning + (size.along_axis_3 ? "; only in space" : "");
    const Need need = size.along_axis_3 ? Need::optional : Need::required;
    fields.push_back({detail::info(size.name, ExpressionKind{}, meaning, {.need = need}),
                      [name = size.name](RigidBody& target, const Json& text) {
                        target.sizes[name] = text.get<std::string>();
                      }});
  }
  if (shape.sizes.front().name == "radius") fields.front().info.aliases = {"r"};
  for (BoundField<RigidBody>& field : place_fields()) fields.push_back(std::move(field));
  return body<RigidBody>(shape.name, shape.meaning, std::move(fields), {ways_of_turning},
                         [name = shape.name](RigidBody& target) { target.shape = name; });
}

BodyKind body_of_moments() {
  std::vector<BoundField<RigidBody>> fields{
      value("inertia", &RigidBody::inertia, ExpressionKind{},
            "in the plane, its moment of inertia about its centre"),
      value("principal_moments", &RigidBody::principal_moments, ListKind{ExpressionKind{}, 3, 3},
            "in space, its moments of inertia about its axes 1, 2 and 3 through its centre",
            {.aliases = {"moments"}})};
  for (BoundField<RigidBody>& field : place_fields()) fields.push_back(std::move(field));
  return body<RigidBody>(
      "rigid_body", "A rigid body by its moments of inertia.", std::move(fields),
      {{.ways = {{"inertia"}, {"principal_moments"}}, .need = Need::required}, ways_of_turning},
      [](RigidBody& target) { target.shape = "rigid_body"; });
}

std::vector<BodyKind> bodies_of_points() {
  return {
      body<Particle>("particle", "A point mass.",
                     {value("position", &Particle::position, PositionKind{}, "where it is",
                            {.need = Need::required, .aliases = {"r", "pos", "at", "xy", "point"}})}),
      body<SlenderRod>("rod", "A uniform slender rod, by its two ends.",
                       {value("start", &SlenderRod::start, PositionKind{}, "where one end is", required),
                        value("end", &SlenderRod::end, PositionKind{}, "where the other end is", required)}),
  };
}

}  // namespace

const std::vector<BodyKind>& body_kinds() {
  static const std::vector<BodyKind> kinds = [] {
    std::vector<BodyKind> all = bodies_of_points();
    for (const Shape& shape : shapes()) all.push_back(body_of_shape(shape));
    all.push_back(body_of_moments());
    return all;
  }();
  return kinds;
}

}  // namespace qdot::api
