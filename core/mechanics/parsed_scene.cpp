#include "core/mechanics/parsed_scene.hpp"

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/expr/parse.hpp"
#include "core/mechanics/dimension_check.hpp"

namespace qdot {
namespace {

/// What an expression may speak of.
enum class Context { parameters, time, configuration, state };

class SceneParser {
 public:
  SceneParser(const Scene& scene, std::vector<Diagnostic>& diagnostics) : scene_(scene), diagnostics_(diagnostics) {
    parsed_.graph = std::make_shared<Graph>();
  }

  ParsedScene parse() {
    declare_symbols();
    read_declarations();
    read_bodies();
    read_forces();
    read_conditions();
    check_whole();
    return std::move(parsed_);
  }

 private:
  void complain(const std::string& place, const std::string& code, const std::string& message) {
    diagnostics_.push_back({place, code, message});
  }

  // --- symbols ---------------------------------------------------------------------------------------------

  Expression declare(const std::string& name, const Dimension& dimension, Context first_context,
                     const std::string& place) {
    const Expression symbol = parsed_.graph->symbol(name);
    if (!declared_.insert(name).second) {
      complain(place, "duplicate_name", "The name '" + name + "' is used twice.");
    }
    dimensions_[symbol.id()] = dimension;
    for (int c = static_cast<int>(first_context); c <= static_cast<int>(Context::state); ++c) {
      allowed_[c].push_back(name);
    }
    return symbol;
  }

  Dimension unit(const std::string& text, const std::string& place) {
    const std::optional<Unit> unit = parse_unit(text);
    if (unit && unit->is_coherent()) return unit->dimension;
    complain(place + "/unit", "unit",
             unit ? "The unit '" + text + "' is not an SI unit without a prefix; write kg, m, s, rad, N, J, ..."
                  : "The unit '" + text + "' is not known; write a product of SI units such as kg*m/s^2.");
    return {};
  }

  void declare_varying(Symbols::Varying& varying, const std::string& name, const Dimension& dimension,
                       Context value, Context rate, const std::string& place) {
    const Dimension second = unit_of("s");
    varying.value.push_back(declare(name, dimension, value, place + "/name"));
    varying.rate.push_back(declare(name + "_dot", dimension / second, rate, place + "/name"));
    varying.second_rate.push_back(parsed_.graph->symbol(name + "_ddot"));
    dimensions_[varying.second_rate.back().id()] = dimension / second / second;
  }

  void declare_symbols() {
    Symbols& symbols = parsed_.symbols;
    each(scene_.coordinates, "/coordinates", [&](const Coordinate& q, const std::string& place) {
      declare_varying(symbols.coordinates, q.name, unit(q.unit, place), Context::configuration, Context::state, place);
    });
    symbols.t = declare("t", unit_of("s"), Context::time, "");
    each(scene_.inputs, "/inputs", [&](const Input& input, const std::string& place) {
      declare_varying(symbols.inputs, input.name, unit(input.unit, place), Context::configuration,
                      Context::configuration, place);
    });
    each(scene_.held_lengths, "/held_lengths", [&](const HeldLength& held, const std::string& place) {
      declare_varying(symbols.held, held.name, unit(held.unit, place), Context::configuration, Context::state, place);
    });
    each(scene_.parameters, "/parameters", [&](const Parameter& p, const std::string& place) {
      symbols.parameters.push_back(declare(p.name, unit(p.unit, place), Context::parameters, place + "/name"));
    });
  }

  // --- expressions -----------------------------------------------------------------------------------------

  template <class Items, class Visit>
  void each(const Items& items, const std::string& place, Visit visit) {
    for (std::size_t i = 0; i < items.size(); ++i) visit(items[i], place + "/" + std::to_string(i));
  }

  /// The expression, or 0 with a complaint.
  Expression read(const std::string& text, Context context, const std::string& place,
                  const std::optional<Dimension>& expected) {
    const ParseResult result = parse_all(text, *parsed_.graph, allowed_[static_cast<int>(context)]);
    for (const ParseError& error : result.errors) complain(place, error_code(error), error.message);
    if (!result.expression) return parsed_.graph->number(0);
    check_dimension(*result.expression, place, expected);
    return *result.expression;
  }

  static std::string error_code(const ParseError& error) {
    switch (error.code) {
      case ErrorCode::unknown_symbol: return "unknown_symbol";
      case ErrorCode::too_large: return "too_large";
      default: return "syntax";
    }
  }

  void check_dimension(const Expression& e, const std::string& place, const std::optional<Dimension>& expected) {
    const DimensionResult found = dimension_of(e, dimensions_);
    if (!found.mistake.empty()) {
      complain(place, "dimension", "The expression's dimensions do not fit: " + found.mistake + ".");
    } else if (expected && found.dimension && *found.dimension != *expected && e.number() == nullptr) {
      complain(place, "dimension",
               "The expression is in " + to_text(*found.dimension) + ", but " + to_text(*expected) + " belongs here.");
    }
  }

  Vector read_vector(const std::vector<std::string>& components, Context context, const std::string& place,
                     const char* unit_text) {
    Vector vector;
    each(components, place, [&](const std::string& text, const std::string& where) {
      vector.push_back(read(text, context, where, unit_of(unit_text)));
    });
    if (space_ == 0) space_ = components.size();
    if (components.size() != space_ || space_ < 2 || space_ > 3) {
      complain(place, "components", "Positions and vectors have two components, or all of them three.");
      vector.resize(std::max<std::size_t>(space_, 2), parsed_.graph->number(0));
    }
    return vector;
  }

  Vector read_position(const Position& position, const std::string& place) {
    if (position.point.empty()) return read_vector(position.components, Context::configuration, place, "m");
    for (std::size_t i = 0; i < scene_.points.size(); ++i) {
      if (scene_.points[i].name == position.point) return parsed_.points[i];
    }
    complain(place, "unknown_point", "There is no point '" + position.point + "' in this scene.");
    return Vector(std::max<std::size_t>(space_, 2), parsed_.graph->number(0));
  }

  // --- the scene's parts -----------------------------------------------------------------------------------

  void read_declarations() {
    each(scene_.parameters, "/parameters", [&](const Parameter& p, const std::string& place) {
      parsed_.parameter_defaults.push_back(
          read(p.default_value, Context::parameters, place + "/default", unit_of(p.unit)));
    });
    each(scene_.coordinates, "/coordinates", [&](const Coordinate& q, const std::string& place) {
      const Dimension d = unit_of(q.unit);
      parsed_.initial.push_back(read(q.initial, Context::parameters, place + "/initial", d));
      parsed_.initial_rates.push_back(
          read(q.initial_rate, Context::parameters, place + "/initial_rate", d / unit_of("s")));
      if (!q.scale.empty()) (void)read(q.scale, Context::parameters, place + "/scale", unit_of("m"));
    });
    each(scene_.inputs, "/inputs", [&](const Input& input, const std::string& place) {
      parsed_.input_defaults.push_back(
          read(input.default_value, Context::time, place + "/default", unit_of(input.unit)));
    });
    each(scene_.held_lengths, "/held_lengths", [&](const HeldLength& held, const std::string& place) {
      parsed_.held_values.push_back(read(held.value, Context::parameters, place + "/value", unit_of(held.unit)));
    });
    if (scene_.scales) {
      parsed_.scales = {read(scene_.scales->mass, Context::parameters, "/scales/mass", unit_of("kg")),
                        read(scene_.scales->length, Context::parameters, "/scales/length", unit_of("m")),
                        read(scene_.scales->time, Context::parameters, "/scales/time", unit_of("s"))};
    }
  }

  /// Already complained about where it was declared.
  [[nodiscard]] static Dimension unit_of(const std::string& text) {
    const std::optional<Unit> unit = parse_unit(text);
    return unit ? unit->dimension : Dimension{};
  }

  void read_bodies() {
    each(scene_.points, "/points", [&](const Point& point, const std::string& place) {
      parsed_.points.push_back(read_vector(point.components, Context::configuration, place + "/components", "m"));
    });
    each(scene_.bodies, "/bodies", [&](const Body& body, const std::string& place) {
      parsed_.bodies.push_back(std::visit([&](const auto& b) { return read_body(b, place); }, body));
    });
    if (!scene_.gravity.empty()) {
      parsed_.gravity = read_vector(scene_.gravity, Context::time, "/gravity", "m/s^2");
    }
    each(scene_.springs, "/springs", [&](const Spring& spring, const std::string& place) {
      parsed_.springs.push_back(
          {read(spring.stiffness, Context::parameters, place + "/stiffness", unit_of("N/m")),
           read(spring.length, Context::configuration, place + "/length", unit_of("m")),
           read(spring.rest_length, Context::parameters, place + "/rest_length", unit_of("m"))});
    });
  }

  Expression read_mass(const std::string& text, const std::string& place) {
    return read(text, Context::parameters, place + "/mass", unit_of("kg"));
  }

  ParsedBody read_body(const Particle& body, const std::string& place) {
    return ParsedParticle{read_mass(body.mass, place), read_position(body.position, place + "/position")};
  }
  ParsedBody read_body(const SlenderRod& body, const std::string& place) {
    return ParsedRod{read_mass(body.mass, place), read_position(body.start, place + "/start"),
                     read_position(body.end, place + "/end")};
  }
  ParsedBody read_body(const Disk& body, const std::string& place) {
    return ParsedDisk{read_mass(body.mass, place),
                      read(body.radius, Context::parameters, place + "/radius", unit_of("m")),
                      read_position(body.centre, place + "/centre"),
                      read(body.angle, Context::configuration, place + "/angle", Dimension{})};
  }

  std::optional<Expression> read_optional(const std::string& text, Context context, const std::string& place,
                                          const std::optional<Dimension>& expected) {
    if (text.empty()) return std::nullopt;
    return read(text, context, place, expected);
  }

  void read_forces() {
    parsed_.potential = read_optional(scene_.potential, Context::configuration, "/potential", unit_of("J"));
    parsed_.dissipation = read_optional(scene_.dissipation, Context::state, "/dissipation", unit_of("W"));
    parsed_.lagrangian = read_optional(scene_.lagrangian, Context::state, "/lagrangian", unit_of("J"));
    each(scene_.forces, "/forces", [&](const Force& force, const std::string& place) {
      parsed_.forces.push_back({read_vector(force.vector, Context::state, place + "/vector", "N"),
                                read_position(force.point, place + "/point")});
    });
  }

  void read_conditions() {
    each(scene_.valid_while, "/valid_while", [&](const ValidityCondition& condition, const std::string& place) {
      const Dimension d = unit(condition.unit, place);
      parsed_.valid_while.push_back(std::visit(
          overloaded{[&](const Reaction& reaction) -> ParsedCondition { return read_reaction(reaction, place); },
                     [&](const std::string& text) -> ParsedCondition {
                       return read(text, Context::state, place + "/expression", d);
                     }},
          condition.quantity));
    });
    each(scene_.singular_where, "/singular_where", [&](const Singularity& singularity, const std::string& place) {
      parsed_.singular_where.push_back(
          read(singularity.expression, Context::configuration, place + "/expression", std::nullopt));
    });
    each(scene_.events, "/events", [&](const SceneEvent& event, const std::string& place) {
      parsed_.events.push_back({read(event.expression, Context::state, place + "/expression", std::nullopt),
                                read_optional(event.when, Context::state, place + "/when", std::nullopt)});
    });
    if (scene_.impact) read_impact(*scene_.impact);
  }

  ParsedReaction read_reaction(const Reaction& reaction, const std::string& place) {
    for (std::size_t i = 0; i < scene_.held_lengths.size(); ++i) {
      if (scene_.held_lengths[i].name == reaction.length) return {i, reaction.sign};
    }
    complain(place + "/reaction/length", "unknown_symbol",
             "There is no held length '" + reaction.length + "' in this scene.");
    return {};
  }

  void read_impact(const Impact& impact) {
    const bool known = std::any_of(scene_.events.begin(), scene_.events.end(),
                                   [&](const SceneEvent& event) { return event.name == impact.event; });
    if (!known) complain("/impact/event", "unknown_event", "There is no event '" + impact.event + "' in this scene.");
    for (const auto& [name, text] : impact.map) {
      const std::string place = "/impact/map/" + name;
      const Expression symbol = parsed_.graph->symbol(name);
      const auto& q = parsed_.symbols.coordinates;
      const bool is_state = std::find(q.value.begin(), q.value.end(), symbol) != q.value.end() ||
                            std::find(q.rate.begin(), q.rate.end(), symbol) != q.rate.end();
      if (!is_state) complain(place, "unknown_symbol", "'" + name + "' is neither a coordinate nor a velocity.");
      const auto expected = is_state ? std::optional(dimensions_[symbol.id()]) : std::nullopt;
      parsed_.impact.emplace_back(symbol, read(text, Context::state, place, expected));
    }
  }

  // --- the whole -------------------------------------------------------------------------------------------

  void check_whole() {
    if (scene_.coordinates.empty()) complain("/coordinates", "missing", "A scene needs at least one coordinate.");
    const bool by_bodies = !scene_.bodies.empty();
    if (by_bodies == parsed_.lagrangian.has_value()) {
      complain("/bodies", "missing", "A scene has either bodies or a lagrangian.");
    }
    if (!by_bodies && (!scene_.gravity.empty() || !scene_.springs.empty() || !scene_.potential.empty())) {
      complain("/lagrangian", "conflict", "A lagrangian contains gravity, springs and potential already.");
    }
    check_default_cycles();
  }

  /// A default may use other parameters as long as no chain of them comes back.
  void check_default_cycles() {
    for (std::size_t i = 0; i < parsed_.parameter_defaults.size(); ++i) {
      std::set<std::size_t> seen;
      std::vector<std::size_t> open{i};
      while (!open.empty()) {
        const std::size_t at = open.back();
        open.pop_back();
        for (std::size_t j = 0; j < parsed_.symbols.parameters.size(); ++j) {
          if (depends_on(parsed_.parameter_defaults[at], parsed_.symbols.parameters[j]) && seen.insert(j).second) {
            open.push_back(j);
          }
        }
      }
      if (seen.contains(i)) {
        complain("/parameters/" + std::to_string(i) + "/default", "cycle",
                 "The default of '" + scene_.parameters[i].name + "' depends on itself.");
      }
    }
  }

  const Scene& scene_;
  std::vector<Diagnostic>& diagnostics_;
  ParsedScene parsed_;
  std::set<std::string> declared_;
  std::vector<std::string> allowed_[4];
  SymbolDimensions dimensions_;
  std::size_t space_{0};
};

}  // namespace

ParsedScene parse_scene(const Scene& scene, std::vector<Diagnostic>& diagnostics) {
  return SceneParser(scene, diagnostics).parse();
}

}  // namespace qdot
