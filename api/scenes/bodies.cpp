#include "api/scenes/bodies.hpp"

#include <string>
#include <utility>

#include "api/scenes/scene_fields.hpp"

namespace qdot::api {
namespace {

/// A kind of body, which beside `fields` has a name and a mass as all have.
template <class Struct>
BodyKind body(const std::string& kind, std::string description, std::vector<BoundField<Struct>> fields) {
  std::vector<BoundField<Struct>> all{
      {detail::info("kind", ChoiceKind{{kind}}, "what the body is", required)},
      value("name", &Struct::name, NameKind{}, "what the body is called"),
      value("mass", &Struct::mass, ExpressionKind{}, "its mass, an expression of the parameters",
            {.need = Need::required, .aliases = {"m"}}),
  };
  all.insert(all.end(), fields.begin(), fields.end());
  const Table<Struct> table(kind, std::move(description), std::move(all));
  return {table.set(), [table](const Json& resolved) -> Body {
            Struct result;
            table.store(resolved, result);
            return result;
          }};
}

}  // namespace

const std::vector<BodyKind>& body_kinds() {
  static const std::vector<BodyKind> kinds{
      body<Particle>("particle", "A point mass.",
                     {value("position", &Particle::position, PositionKind{}, "where it is",
                            {.need = Need::required, .aliases = {"r", "pos", "at", "xy", "point"}})}),
      body<SlenderRod>("rod", "A uniform slender rod, by its two ends.",
                       {value("start", &SlenderRod::start, PositionKind{}, "where one end is", required),
                        value("end", &SlenderRod::end, PositionKind{}, "where the other end is", required)}),
      body<Disk>(
          "disk", "A uniform disk that stays in the plane.",
          {value("radius", &Disk::radius, ExpressionKind{}, "its radius",
                 {.need = Need::required, .aliases = {"r"}}),
           value("centre", &Disk::centre, PositionKind{}, "where its centre is",
                 {.need = Need::required, .aliases = {"position"}}),
           value("angle", &Disk::angle, ExpressionKind{},
                 "how far it has turned against an inertial frame, counter-clockwise positive", required)}),
  };
  return kinds;
}

}  // namespace qdot::api
