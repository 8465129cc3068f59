#include "api/scenes/scene_reader.hpp"

#include <utility>

#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "api/scenes/scene_fields.hpp"
#include "api/scenes/scene_values.hpp"

namespace qdot::api {
namespace {

// Each table lists one kind of object in the order of core/mechanics/scene.hpp.

const Fields<Parameter> parameter_fields{
    required("name", &Parameter::name, read_name),
    required("unit", &Parameter::unit, read_word),
    required("default", &Parameter::default_value, read_expression),
    optional("domain", &Parameter::domain, read_domain),
    optional("meaning", &Parameter::meaning, read_prose),
    optional("latex", &Parameter::latex, read_word),
};

const Fields<Coordinate> coordinate_fields{
    required("name", &Coordinate::name, read_name),
    required("unit", &Coordinate::unit, read_word),
    optional("initial", &Coordinate::initial, read_expression),
    optional("initial_rate", &Coordinate::initial_rate, read_expression),
    optional("scale", &Coordinate::scale, read_expression),
    optional("domain", &Coordinate::domain, read_domain),
    optional("meaning", &Coordinate::meaning, read_prose),
    optional("latex", &Coordinate::latex, read_word),
};

const Fields<Input> input_fields{
    required("name", &Input::name, read_name),
    required("unit", &Input::unit, read_word),
    optional("default", &Input::default_value, read_expression),
    optional("meaning", &Input::meaning, read_prose),
};

const Fields<HeldLength> held_length_fields{
    required("name", &HeldLength::name, read_name),
    required("unit", &HeldLength::unit, read_word),
    required("value", &HeldLength::value, read_expression),
    optional("meaning", &HeldLength::meaning, read_prose),
};

const Fields<Point> point_fields{
    required("name", &Point::name, read_name),
    required("components", &Point::components, read_vector),
};

/// The field that says which of the bodies this is: read_body has already looked at it.
template <class Target>
Field<Target> kind_field() {
  return {"kind", Presence::required, [](const Cursor&, Target&) {}};
}

const Fields<Particle> particle_fields{
    kind_field<Particle>(),
    optional("name", &Particle::name, read_name),
    required("mass", &Particle::mass, read_expression),
    required("position", &Particle::position, read_position),
};

const Fields<SlenderRod> rod_fields{
    kind_field<SlenderRod>(),
    optional("name", &SlenderRod::name, read_name),
    required("mass", &SlenderRod::mass, read_expression),
    required("start", &SlenderRod::start, read_position),
    required("end", &SlenderRod::end, read_position),
};

const Fields<Disk> disk_fields{
    kind_field<Disk>(),
    optional("name", &Disk::name, read_name),
    required("mass", &Disk::mass, read_expression),
    required("radius", &Disk::radius, read_expression),
    required("centre", &Disk::centre, read_position),
    required("angle", &Disk::angle, read_expression),
};

void read_body(const Cursor& cursor, Body& body) {
  static const std::vector<std::string> kinds{"particle", "rod", "disk"};
  const Json& value = cursor.value();
  if (!value.is_object()) return cursor.report_type("an object with a kind");
  if (!value.contains("kind"))
    return cursor.report("missing", "The field 'kind' is missing: particle, rod or disk.");
  const Json& given = value.at("kind");
  // As a text: comparing JSON with a literal takes memory, and may not fail.
  const std::string_view kind = given.is_string() ? given.get_ref<const std::string&>() : std::string_view();
  if (kind == "particle") return read_fields(cursor, particle_fields, body.emplace<Particle>());
  if (kind == "rod") return read_fields(cursor, rod_fields, body.emplace<SlenderRod>());
  if (kind == "disk") return read_fields(cursor, disk_fields, body.emplace<Disk>());
  const std::string nearest = kind.empty() ? "" : closest(kind, kinds);
  cursor.field("kind").report("bad_value", "The kind of a body must be \"particle\", \"rod\" or \"disk\"." +
                                               (nearest.empty() ? "" : " Did you mean '" + nearest + "'?"));
}

const Fields<Spring> spring_fields{
    optional("name", &Spring::name, read_name),
    required("stiffness", &Spring::stiffness, read_expression),
    required("length", &Spring::length, read_expression),
    optional("rest_length", &Spring::rest_length, read_expression),
};

const Fields<Force> force_fields{
    optional("name", &Force::name, read_name),
    required("vector", &Force::vector, read_vector),
    required("point", &Force::point, read_position),
};

const Fields<Reaction> reaction_fields{
    required("length", &Reaction::length, read_name),
    required("sign", &Reaction::sign, read_sign),
};

// `quantity` has two names in JSON, one for each of its alternatives.
void read_reaction(const Cursor& cursor, std::variant<Reaction, std::string>& quantity) {
  read_fields(cursor, reaction_fields, quantity.emplace<Reaction>());
}

void read_quantity(const Cursor& cursor, std::variant<Reaction, std::string>& quantity) {
  read_expression(cursor, quantity.emplace<std::string>());
}

const Fields<ValidityCondition> condition_fields{
    required("name", &ValidityCondition::name, read_name),
    required("unit", &ValidityCondition::unit, read_word),
    optional("reaction", &ValidityCondition::quantity, read_reaction),
    optional("expression", &ValidityCondition::quantity, read_quantity),
    required("reason", &ValidityCondition::reason, read_name),
    required("message", &ValidityCondition::message, read_prose),
};

const Fields<Report> report_fields{
    required("name", &Report::name, read_name),
    required("unit", &Report::unit, read_word),
    optional("reaction", &Report::quantity, read_reaction),
    optional("expression", &Report::quantity, read_quantity),
    optional("meaning", &Report::meaning, read_prose),
};

void check_quantity(const Cursor& cursor, const std::string& what) {
  const Json& value = cursor.value();
  if (!value.is_object() || value.contains("reaction") != value.contains("expression")) return;
  cursor.report(value.contains("reaction") ? "conflict" : "missing",
                what + " has either a 'reaction' or an 'expression'.");
}

void read_condition(const Cursor& cursor, ValidityCondition& condition) {
  read_fields(cursor, condition_fields, condition);
  check_quantity(cursor, "A condition");
}

void read_report(const Cursor& cursor, Report& report) {
  read_fields(cursor, report_fields, report);
  check_quantity(cursor, "A report");
}

const Fields<Singularity> singularity_fields{
    required("name", &Singularity::name, read_name),
    required("expression", &Singularity::expression, read_expression),
    optional("message", &Singularity::message, read_prose),
};

const Fields<SceneEvent> event_fields{
    required("name", &SceneEvent::name, read_name),
    required("expression", &SceneEvent::expression, read_expression),
    optional("direction", &SceneEvent::direction, read_crossing),
    optional("when", &SceneEvent::when, read_expression),
    optional("meaning", &SceneEvent::meaning, read_prose),
};

const Fields<Impact> impact_fields{
    required("event", &Impact::event, read_name),
    required("map", &Impact::map, read_map),
    optional("meaning", &Impact::meaning, read_prose),
};

const Fields<Scales> scales_fields{
    required("mass", &Scales::mass, read_expression),
    required("length", &Scales::length, read_expression),
    required("time", &Scales::time, read_expression),
    optional("names", &Scales::names, read_new_names),
};

namespace most = scene_limits;

const Fields<Scene> scene_fields{
    required("name", &Scene::name, read_name),
    optional("title", &Scene::title, read_prose),
    optional("problem", &Scene::problem, read_word),
    optional("model_version", &Scene::model_version, read_word),
    optional("description", &Scene::description, read_prose),
    optional("parameters", &Scene::parameters, array(object(parameter_fields), 0, most::parameters)),
    required("coordinates", &Scene::coordinates, array(object(coordinate_fields), 1, most::coordinates)),
    optional("inputs", &Scene::inputs, array(object(input_fields), 0, most::inputs)),
    optional("held_lengths", &Scene::held_lengths, array(object(held_length_fields), 0, most::held_lengths)),
    optional("points", &Scene::points, array(object(point_fields), 0, most::points)),
    optional("bodies", &Scene::bodies, array(read_body, 1, most::bodies)),
    optional("gravity", &Scene::gravity, read_vector),
    optional("springs", &Scene::springs, array(object(spring_fields), 0, most::springs)),
    optional("potential", &Scene::potential, read_expression),
    optional("forces", &Scene::forces, array(object(force_fields), 0, most::forces)),
    optional("dissipation", &Scene::dissipation, read_expression),
    optional("lagrangian", &Scene::lagrangian, read_expression),
    optional("valid_while", &Scene::valid_while, array(read_condition, 0, most::conditions)),
    optional("reports", &Scene::reports, array(read_report, 0, most::conditions)),
    optional("singular_where", &Scene::singular_where,
             array(object(singularity_fields), 0, most::conditions)),
    optional("events", &Scene::events, array(object(event_fields), 0, most::events)),
    optional("impact", &Scene::impact, into_optional(object(impact_fields))),
    optional("scales", &Scene::scales, into_optional(object(scales_fields))),
    optional("lines", &Scene::lines, array(array(read_name, 2, most::lines), 0, most::lines)),
};

/// A scene says where its bodies are, or gives a Lagrangian instead of bodies, gravity, springs and
/// potential.
void check_bodies_or_lagrangian(const Cursor& cursor) {
  const Json& value = cursor.value();
  if (!value.contains("lagrangian")) {
    if (!value.contains("bodies")) {
      cursor.report("missing", "The scene has neither 'bodies' nor a 'lagrangian'.");
    }
    return;
  }
  for (const char* name : {"bodies", "gravity", "springs", "potential"}) {
    if (!value.contains(name)) continue;
    cursor.field(name).report(
        "conflict", "A 'lagrangian' stands instead of '" + std::string{name} + "'; give one of the two.");
  }
}

/// What optional fields mean when they are absent: at rest at 0, no input, a spring of no length.
void fill_defaults(Scene& scene) {
  const auto zero_if_empty = [](std::string& text) {
    if (text.empty()) text = "0";
  };
  for (Coordinate& coordinate : scene.coordinates) {
    zero_if_empty(coordinate.initial);
    zero_if_empty(coordinate.initial_rate);
  }
  for (Input& input : scene.inputs) zero_if_empty(input.default_value);
  for (Spring& spring : scene.springs) zero_if_empty(spring.rest_length);
}

}  // namespace

SceneReading read_scene(const Json& json) {
  SceneReading reading;
  const Cursor cursor{json, "", reading.diagnostics};
  read_fields(cursor, scene_fields, reading.scene);
  if (json.is_object()) check_bodies_or_lagrangian(cursor);
  fill_defaults(reading.scene);
  return reading;
}

}  // namespace qdot::api
