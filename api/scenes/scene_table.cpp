#include "api/scenes/scene_table.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "api/contract/document_schema.hpp"
#include "api/scenes/bodies.hpp"
#include "api/scenes/scene_fields.hpp"

namespace qdot::api {
namespace {

namespace most = scene_limits;

/// Where an expression may be left out, it is 0.
const FieldOptions zero{.default_value = "0"};

template <class Struct>
BoundField<Struct> name_field(std::string description) {
  return value("name", &Struct::name, NameKind{}, std::move(description), required);
}

template <class Struct>
BoundField<Struct> unit_field() {
  return value(
      "unit", &Struct::unit, short_text,
      "an SI unit, such as kg, N/m, rad/s or m/s^2; 1 where there is none. Only a scene without units "
      "leaves it out, or has rad for an angle");
}

template <class Struct>
BoundField<Struct> meaning_field() {
  return value("meaning", &Struct::meaning, prose, "what it is, in words");
}

template <class Struct>
BoundField<Struct> latex_field() {
  return value("latex", &Struct::latex, short_text, "how LaTeX writes its name, where not as it is");
}

/// Names or expressions by their names, in the order in which they were given.
template <class Struct>
BoundField<Struct> map(std::string name, std::vector<std::pair<std::string, std::string>> Struct::*member,
                       NameOf keys, MapTo values, std::string description, FieldOptions options = {}) {
  return {detail::info(std::move(name), MapKind{keys, values, most::map_entries}, std::move(description),
                       std::move(options)),
          [member](Struct& target, const Json& entries) {
            for (const auto& [key, entry] : entries.items()) {
              (target.*member).emplace_back(key, entry.template get<std::string>());
            }
          }};
}

const Table<Parameter> parameters("parameter", "A number that stays the same during a motion.",
                                  {name_field<Parameter>("what expressions and requests call it"),
                                   unit_field<Parameter>(),
                                   value("default", &Parameter::default_value, ExpressionKind{},
                                         "a number, or an expression of other parameters, such as 2*m",
                                         required),
                                   value("domain", &Parameter::domain, DomainKind{}, "where it makes sense"),
                                   meaning_field<Parameter>(), latex_field<Parameter>()});

const Table<Coordinate> coordinates(
    "coordinate", "A generalized coordinate. Its velocity is called <name>_dot.",
    {name_field<Coordinate>("what expressions and requests call it"), unit_field<Coordinate>(),
     value("initial", &Coordinate::initial, ExpressionKind{},
           "value at the start when a request gives none: an expression of the parameters", zero),
     value("initial_rate", &Coordinate::initial_rate, ExpressionKind{},
           "velocity at the start when a request gives none", zero),
     value("scale", &Coordinate::scale, ExpressionKind{},
           "a length that turns this angle into an arc, so that mode shapes can be compared"),
     value("domain", &Coordinate::domain, DomainKind{},
           "where the coordinate describes a configuration; a motion that leaves it ends"),
     meaning_field<Coordinate>(), latex_field<Coordinate>()});

const Table<Input> inputs("input", "A function of time that a request supplies, such as a force.",
                          {name_field<Input>("what expressions and requests call it"), unit_field<Input>(),
                           value("default", &Input::default_value, ExpressionKind{},
                                 "an expression of t and the parameters", zero),
                           meaning_field<Input>()});

const Table<HeldLength> held_lengths(
    "held_length",
    "A length that the motion keeps. Positions use its name; the force that keeps it can then be derived "
    "(see valid_while).",
    {name_field<HeldLength>("what positions call it"), unit_field<HeldLength>(),
     value("value", &HeldLength::value, ExpressionKind{},
           "what it is kept at: an expression of the parameters", required),
     meaning_field<HeldLength>()});

const Table<Point> points("point", "A place with a name, in an inertial frame.",
                          {name_field<Point>("what positions call it"),
                           value("components", &Point::components, VectorKind{}, "where it is", required)});

/// What is stretched, or damped.
template <class Struct>
BoundField<Struct> length_field() {
  return value("length", &Struct::length, ExpressionKind{}, "how long it is");
}
template <class Struct>
BoundField<Struct> between_field() {
  return value("between", &Struct::between, ListKind{PositionKind{}, 2, 2}, "the two places that it joins",
               {.aliases = {"points", "ends", "from", "to"}});
}
template <class Struct>
BoundField<Struct> angle_field() {
  return value("angle", &Struct::angle, ExpressionKind{},
               "the angle that it works on, as a torsion spring does");
}

const Table<Spring> springs(
    "spring",
    "A linear spring with the energy stiffness*(length - rest_length)^2/2, or a torsion spring with "
    "stiffness*(angle - rest_angle)^2/2.",
    {value("name", &Spring::name, NameKind{}, "what it is called"),
     value("stiffness", &Spring::stiffness, ExpressionKind{}, "force by length, or torque by angle",
           {.need = Need::required, .aliases = {"k", "constant"}}),
     length_field<Spring>(),
     value("rest_length", &Spring::rest_length, ExpressionKind{}, "how long it is without a force",
           {.default_value = "0", .aliases = {"l0", "l_0", "natural_length", "free_length"}}),
     between_field<Spring>(), angle_field<Spring>(),
     value("rest_angle", &Spring::rest_angle, ExpressionKind{}, "the angle without a torque", zero)},
    {{.ways = {{"length"}, {"between"}, {"angle", "rest_angle"}}, .need = Need::required},
     {.ways = {{"rest_length"}, {"angle", "rest_angle"}}}});

const Table<Damper> dampers(
    "damper",
    "A force against the rate of a length, of the distance between two places, of an angle, or against the "
    "velocity of a point.",
    {value("name", &Damper::name, NameKind{}, "what it is called"),
     value("coefficient", &Damper::coefficient, ExpressionKind{}, "c in -c*v, or in -c*|v|*v",
           {.need = Need::required, .aliases = {"c", "b", "damping"}}),
     choice("law", &Damper::law, {{"linear", Damper::Law::linear}, {"quadratic", Damper::Law::quadratic}},
            "linear: -c*v; quadratic: -c*|v|*v, as of air", {.default_value = "linear"}),
     length_field<Damper>(), between_field<Damper>(), angle_field<Damper>(),
     value("point", &Damper::point, PositionKind{}, "the place whose velocity it acts against")},
    {{.ways = {{"length"}, {"between"}, {"angle"}, {"point"}}, .need = Need::required}});

const Table<Force> forces(
    "force",
    "A force applied at a point, a force or torque along one quantity, or a torque on a body in space. Each may "
    "depend on the state and the time, and as friction does on the multiplier N of a constraint: -mu*N*sign(x_dot), or "
    "-mu*abs(N)*sign(x_dot) where the constraint holds from both sides.",
    {value("name", &Force::name, NameKind{}, "what it is called"),
     value("vector", &Force::vector, VectorKind{}, "the components of a force",
           {.aliases = {"force", "components", "f"}}),
     value("point", &Force::point, PositionKind{}, "where it is applied"),
     value("value", &Force::value, ExpressionKind{},
           "a force that pushes along a length, or a torque that turns an angle"),
     value("along", &Force::along, ExpressionKind{},
           "what the value pushes: a coordinate, theta, or an expression such as theta2 - theta1"),
     value("torque", &Force::torque, VectorKind{}, "the components of a torque, in the axes of space"),
     value("body", &Force::body, NameKind{}, "the name of the body in space that the torque turns")},
    {{.ways = {{"vector", "point"}, {"value", "along"}, {"torque", "body"}}, .need = Need::required}});

const Table<Constraint> constraints(
    "constraint",
    "What every motion obeys: an expression that stays 0, either without velocities, such as x^2 + y^2 - l^2, "
    "or linear in them, such as x_dot - r*theta_dot. Its force has a multiplier, which conditions, reports and "
    "events may use.",
    {name_field<Constraint>("what answers call it"),
     value("expression", &Constraint::expression, ExpressionKind{}, "what stays 0", required),
     value("multiplier", &Constraint::multiplier, NameKind{},
           "what expressions call its multiplier; without it, lambda_<name>"),
     meaning_field<Constraint>()});

const Table<Reaction> reactions(
    "reaction", "The force that keeps a held length, derived from the Lagrangian.",
    {value("length", &Reaction::length, NameKind{}, "the name of the held length", required),
     value("sign", &Reaction::sign, SignKind{},
           "-1 where the reaction pulls inwards (a string), 1 where it pushes outwards (a support)",
           required)});

const OneOf ways_of_quantity{.ways = {{"reaction"}, {"expression"}}, .need = Need::required};

/// `quantity` has two names in JSON, one for each of its alternatives.
template <class Struct>
BoundField<Struct> reaction_field() {
  return {detail::info("reaction", RecordKind{&reactions.set()}, "the quantity, as a reaction", {}),
          [](Struct& target, const Json& resolved) {
            reactions.store(resolved, target.quantity.template emplace<Reaction>());
          }};
}

template <class Struct>
BoundField<Struct> expression_field() {
  return {detail::info("expression", ExpressionKind{}, "the quantity, as an expression", {}),
          [](Struct& target, const Json& text) { target.quantity = text.get<std::string>(); }};
}

const Table<ValidityCondition> conditions(
    "condition", "The model holds while this quantity is at least 0: a string pulls, a support pushes.",
    {name_field<ValidityCondition>("what answers call the quantity, such as tension"),
     unit_field<ValidityCondition>(), reaction_field<ValidityCondition>(),
     expression_field<ValidityCondition>(),
     value("reason", &ValidityCondition::reason, NameKind{},
           "how answers call this ending, such as string_slack", required),
     value("message", &ValidityCondition::message, prose, "the sentence to print when the condition fails",
           required)},
    {ways_of_quantity});

const Table<Report> reports("report",
                            "A quantity to know beside the conditions, such as the friction that rolling "
                            "asks for. It limits nothing.",
                            {name_field<Report>("what answers call the quantity"), unit_field<Report>(),
                             reaction_field<Report>(), expression_field<Report>(), meaning_field<Report>()},
                            {ways_of_quantity});

const Table<Singularity> singularities(
    "singularity",
    "The coordinates describe no configuration where the expression is 0: every motion ends there.",
    {name_field<Singularity>("how answers call this ending"),
     value("expression", &Singularity::expression, ExpressionKind{}, "what is 0 there", required),
     value("message", &Singularity::message, prose, "the sentence to print when a motion comes there")});

const Table<SceneEvent> events(
    "event", "Something that happens when an expression crosses 0.",
    {name_field<SceneEvent>("what requests and answers call it"),
     value("expression", &SceneEvent::expression, ExpressionKind{}, "what crosses 0", required),
     choice("direction", &SceneEvent::direction,
            {{"rising", Crossing::rising}, {"falling", Crossing::falling}, {"either", Crossing::either}},
            "which crossings count", {.default_value = "either"}),
     value("when", &SceneEvent::when, ExpressionKind{},
           "the crossing counts only where this is greater than 0"),
     meaning_field<SceneEvent>()});

const Table<Impact> impacts(
    "impact",
    "At an event, the state jumps: by restitution, by a contact that is made and one that is left, or as a map "
    "says.",
    {value("event", &Impact::event, NameKind{}, "the name of the event", required),
     map("map", &Impact::map, NameOf::thing_or_velocity, MapTo::expressions,
         "each coordinate or velocity after the jump, as an expression of the state before it; what is not "
         "named stays"),
     value(
         "restitution", &Impact::restitution, ExpressionKind{},
         "what is left of the speed: the event's expression is a distance, and after the impact grows by this "
         "part of the rate at which it fell. There is no friction"),
     value("contact_made", &Impact::contact_made, NameKind{},
           "the point that comes to rest at the impact, such as a foot"),
     value("contact_left", &Impact::contact_left, NameKind{},
           "the point that rested until then, on which all positions stand, and leaves without a push"),
     map("renamed", &Impact::renamed, NameOf::thing, MapTo::expressions,
         "what the coordinates are afterwards, where the point that rests takes the place of the other: "
         "legs that change roles"),
     value("meaning", &Impact::meaning, prose, "what it is, in words")},
    {{.ways = {{"map"}, {"restitution"}, {"contact_made", "contact_left", "renamed"}},
      .need = Need::required}});

const Table<Scales> scales("scales", "Units of the dimensionless form: expressions of the parameters.",
                           {value("mass", &Scales::mass, ExpressionKind{}, "the unit of mass", required),
                            value("length", &Scales::length, ExpressionKind{}, "the unit of length",
                                  required),
                            value("time", &Scales::time, ExpressionKind{}, "the unit of time", required),
                            map("names", &Scales::names, NameOf::thing, MapTo::names,
                                "what a parameter in these units is called, such as {\"m\": \"mu\"}; others "
                                "are called <name>_hat")});

BoundField<Scene> bodies_field() {
  VariantKind kinds;
  for (const BodyKind& kind : body_kinds()) kinds.sets.push_back(&kind.fields);
  return {detail::info("bodies", ListKind{std::move(kinds), most::bodies, 1},
                       "what moves; the energies follow from it", {}),
          [](Scene& scene, const Json& bodies) {
            for (const Json& body : bodies) {
              const auto& name = body.at("kind").get_ref<const std::string&>();
              const auto is_kind = [&](const BodyKind& kind) { return kind.fields.name == name; };
              scene.bodies.push_back(std::ranges::find_if(body_kinds(), is_kind)->from_fields(body));
            }
          }};
}

Table<Scene> make_table() {
  return {
      "Scene",
      "A mechanical system for qdot: where its bodies are, as expressions of the generalized coordinates, "
      "and what acts on them. Kinetic and potential energy, equations of motion, equilibria, frequencies and "
      "reactions are derived from it. An expression may use the scene's parameters, its coordinates q and "
      "velocities q_dot, its held lengths and inputs, the time t, the number pi and the functions sin, cos, "
      "tan, asin, acos, atan, sinh, cosh, tanh, exp, log, sqrt, abs, sign, max and min. Units are SI units and "
      "angles are radians.",
      {name_field<Scene>("what requests call the system, such as spring_pendulum"),
       value("title", &Scene::title, prose, "a heading"),
       value("problem", &Scene::problem, short_text, "number of the problem on the practice sheet"),
       value("model_version", &Scene::model_version, short_text,
             "changes when the system's answers change, such as 1.0.0"),
       choice("units", &Scene::without_units, {{"SI", false}, {"none", true}},
              "none: everything is a number, t included, as textbooks print Lagrangians; without it, SI"),
       value("description", &Scene::description, prose, "one or two sentences for students"),
       records("parameters", &Scene::parameters, parameters, 0, most::parameters,
               "the numbers that a request may set"),
       records("coordinates", &Scene::coordinates, coordinates, 1, most::coordinates,
               "the generalized coordinates, in the order of every vector and matrix of an answer", required),
       records("inputs", &Scene::inputs, inputs, 0, most::inputs, "the functions of time that act"),
       records("held_lengths", &Scene::held_lengths, held_lengths, 0, most::held_lengths,
               "the lengths whose reactions are wanted"),
       records("points", &Scene::points, points, 0, most::points, "the places that have names"),
       bodies_field(),
       value("gravity", &Scene::gravity, VectorKind{},
             "the acceleration of gravity, with as many components as the positions; without it there is no "
             "gravity"),
       records("springs", &Scene::springs, springs, 0, most::springs, "the springs"),
       records("dampers", &Scene::dampers, dampers, 0, most::springs, "the dampers, and drag"),
       value("potential", &Scene::potential, ExpressionKind{}, "potential energy beside gravity and springs"),
       records("forces", &Scene::forces, forces, 0, most::forces, "the forces that no energy gives"),
       records("constraints", &Scene::constraints, constraints, 0, most::constraints,
               "what the motion obeys beside its coordinates"),
       value(
           "dissipation", &Scene::dissipation, ExpressionKind{},
           "Rayleigh's function D, a power: the generalized force on q is -dD/dq_dot, so D = b*x_dot^2/2 is "
           "a damper b",
           {.aliases = {"damping", "friction", "rayleigh"}}),
       value("lagrangian", &Scene::lagrangian, ExpressionKind{},
             "the Lagrangian itself, instead of bodies, gravity, springs and potential",
             {.aliases = {"l", "t", "v", "u", "kinetic", "kinetic_energy", "potential_energy"}}),
       records("valid_while", &Scene::valid_while, conditions, 0, most::conditions,
               "the conditions under which the model holds"),
       records("reports", &Scene::reports, reports, 0, most::conditions, "quantities to know"),
       records("singular_where", &Scene::singular_where, singularities, 0, most::conditions,
               "where the coordinates fail"),
       records("events", &Scene::events, events, 0, most::events, "what happens during a motion"),
       record("impact", &Scene::impact, impacts, "the jump at one of the events"),
       records("impacts", &Scene::impacts, impacts, 0, most::events,
               "the jumps at several events; those of one instant follow each other in this order"),
       record("scales", &Scene::scales, scales, "the units of the dimensionless form"),
       value("lines", &Scene::lines, ListKind{ListKind{NameKind{}, most::lines, 2}, most::lines},
             "for a drawing: chains of points to join")},
      {{.ways = {{"lagrangian"}, {"bodies", "gravity", "springs", "potential"}}, .need = Need::required},
       {.ways = {{"impact"}, {"impacts"}}}}};
}

}  // namespace

const Table<Scene>& scene_table() {
  static const Table<Scene> table = make_table();
  return table;
}

const std::vector<std::string>& lists_with_units() {
  static const std::vector<std::string> lists{"parameters",   "coordinates", "inputs",
                                              "held_lengths", "valid_while", "reports"};
  return lists;
}

const Json& scene_schema() {
  static const Json schema = [] {
    Json document = document_schema(scene_table().set(), "/v1/scene-schema");
    Json with_units = Json::object();
    for (const std::string& list : lists_with_units())
      with_units["properties"][list] = {{"items", {{"required", Json::array({"unit"})}}}};
    document["allOf"].push_back(
        {{"if", {{"properties", {{"units", {{"const", "none"}}}}}, {"required", Json::array({"units"})}}},
         {"else", std::move(with_units)}});
    return document;
  }();
  return schema;
}

}  // namespace qdot::api
