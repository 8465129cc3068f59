#include "core/mechanics/parsed_scene.hpp"

#include <algorithm>
#include <set>

#include "core/expr/unfold.hpp"
#include "core/mechanics/scene_text.hpp"
#include "core/mechanics/sizes_in_forces.hpp"

namespace qdot {
namespace {

bool is_positive(const Domain& domain) {
  return domain.lower > 0 || (domain.lower == 0 && domain.lower_open);
}

class SceneParser {
 public:
  SceneParser(const Scene& scene, std::vector<Diagnostic>& diagnostics, const ExponentValues& exponents,
              const Followers& followers)
      : scene_(scene),
        text_(*parsed_.graph, diagnostics, scene.without_units ? Dimensions::none : Dimensions::checked,
              exponents, followers) {}

  ParsedScene parse() {
    declare_symbols();
    read_declarations();
    read_bodies();
    read_energies();
    read_constraints();
    read_forces();
    read_conditions();
    check_whole();
    parsed_.exponents = text_.exponents();
    return std::move(parsed_);
  }

 private:
  template <class Items, class Visit>
  void each(const Items& items, const std::string& place, Visit visit) {
    for (std::size_t i = 0; i < items.size(); ++i) visit(items[i], place + "/" + std::to_string(i));
  }

  void declare_symbols() {
    Symbols& symbols = parsed_.symbols;
    each(scene_.coordinates, "/coordinates", [&](const Coordinate& q, const std::string& place) {
      text_.declare_varying(symbols.coordinates, q.name, text_.unit(q.unit, place), Context::configuration,
                            Context::state, place);
      if (is_positive(q.domain)) text_.declare_positive(q.name);
    });
    symbols.t = text_.declare("t", dimension_of_unit("s"), Context::time, "");
    each(scene_.inputs, "/inputs", [&](const Input& input, const std::string& place) {
      text_.declare_varying(symbols.inputs, input.name, text_.unit(input.unit, place), Context::configuration,
                            Context::configuration, place);
    });
    each(scene_.held_lengths, "/held_lengths", [&](const HeldLength& held, const std::string& place) {
      text_.declare_varying(symbols.held, held.name, text_.unit(held.unit, place), Context::configuration,
                            Context::state, place);
    });
    each(scene_.parameters, "/parameters", [&](const Parameter& p, const std::string& place) {
      symbols.parameters.push_back(
          text_.declare(p.name, text_.unit(p.unit, place), Context::parameters, place + "/name"));
      if (is_positive(p.domain)) text_.declare_positive(p.name);
    });
  }

  void read_declarations() {
    each(scene_.parameters, "/parameters", [&](const Parameter& p, const std::string& place) {
      parsed_.parameter_defaults.push_back(
          text_.read(p.default_value, Context::parameters, place + "/default", dimension_of_unit(p.unit)));
    });
    each(scene_.coordinates, "/coordinates", [&](const Coordinate& q, const std::string& place) {
      const std::optional<Dimension> d = dimension_of_unit(q.unit);
      parsed_.initial.push_back(text_.read(q.initial, Context::parameters, place + "/initial", d));
      parsed_.initial_rates.push_back(
          text_.read(q.initial_rate, Context::parameters, place + "/initial_rate",
                     d ? std::optional(*d / *dimension_of_unit("s")) : std::nullopt));
      if (!q.scale.empty())
        (void)text_.read(q.scale, Context::parameters, place + "/scale", dimension_of_unit("m"));
    });
    each(scene_.inputs, "/inputs", [&](const Input& input, const std::string& place) {
      parsed_.input_defaults.push_back(
          text_.read(input.default_value, Context::time, place + "/default", dimension_of_unit(input.unit)));
    });
    each(scene_.held_lengths, "/held_lengths", [&](const HeldLength& held, const std::string& place) {
      parsed_.held_values.push_back(
          text_.read(held.value, Context::parameters, place + "/value", dimension_of_unit(held.unit)));
    });
    if (scene_.scales) {
      parsed_.scales = {
          text_.read(scene_.scales->mass, Context::parameters, "/scales/mass", dimension_of_unit("kg")),
          text_.read(scene_.scales->length, Context::parameters, "/scales/length", dimension_of_unit("m")),
          text_.read(scene_.scales->time, Context::parameters, "/scales/time", dimension_of_unit("s"))};
    }
  }

  void read_bodies() {
    const std::vector<Replacement> rates = parsed_.symbols.rates();
    each(scene_.points, "/points", [&](const Point& point, const std::string& place) {
      parsed_.points.push_back(text_.read_vector(point.components, Context::configuration,
                                                 place + "/components", dimension_of_unit("m")));
      text_.declare_point(point.name, parsed_.points.back());
    });
    each(scene_.bodies, "/bodies", [&](const Body& body, const std::string& place) {
      parsed_.bodies.push_back(parse_body(body, place, text_, *parsed_.graph, rates));
    });
    if (!scene_.gravity.empty()) {
      parsed_.gravity =
          text_.read_vector(scene_.gravity, Context::time, "/gravity", dimension_of_unit("m/s^2"));
    }
  }

  void read_energies() {
    each(scene_.springs, "/springs", [&](const Spring& spring, const std::string& place) {
      parsed_.springs.push_back(parse_spring(spring, place, text_));
    });
    parsed_.potential =
        text_.read_optional(scene_.potential, Context::configuration, "/potential", dimension_of_unit("J"));
    parsed_.dissipation =
        text_.read_optional(scene_.dissipation, Context::state, "/dissipation", dimension_of_unit("W"));
    check_dissipation();
    parsed_.lagrangian =
        text_.read_optional(scene_.lagrangian, Context::state, "/lagrangian", dimension_of_unit("J"));
  }

  void check_dissipation() {
    const auto& d = parsed_.dissipation;
    if (!d || d->is_zero() || text_.has_complaint("/dissipation")) return;
    if (depends_on(*d, parsed_.symbols.coordinates.rate) || depends_on(*d, parsed_.symbols.held.rate)) return;
    text_.complain(
        "/dissipation", "no_velocity",
        "No velocity stands here, so nothing is damped: the force is -dD/dq_dot, as of c*q_dot^2/2.");
  }

  void read_forces() {
    const std::vector<Replacement> rates = parsed_.symbols.rates();
    each(scene_.dampers, "/dampers", [&](const Damper& damper, const std::string& place) {
      parsed_.forces.push_back(parse_damper(damper, place, text_, rates));
      check_way(parsed_.forces.back(), place, field_of_way(damper));
    });
    each(scene_.forces, "/forces", [&](const Force& force, const std::string& place) {
      if (force.torque.empty()) {
        parsed_.forces.push_back(parse_force(force, place, text_));
        check_way(parsed_.forces.back(), place, force.value.empty() ? "/point" : "/along");
        check_multipliers(parsed_.forces.back().vector, place);
      } else {
        parsed_.torques.push_back(parse_torque(force, place, text_, parsed_.bodies, rates));
        check_multipliers(parsed_.torques.back().vector, place);
      }
    });
  }

  static const char* field_of_way(const Damper& damper) {
    if (damper.point) return "/point";
    if (!damper.between.empty()) return "/between";
    return damper.angle.empty() ? "/length" : "/angle";
  }

  /// A force along what no coordinate moves is none.
  void check_way(const ParsedForce& force, const std::string& place, const char* field) {
    if (text_.has_complaint_below(place)) return;
    const Symbols& symbols = parsed_.symbols;
    const auto moves = [&](const Expression& e) {
      return depends_on(e, symbols.coordinates.value) || depends_on(e, symbols.held.value);
    };
    if (std::ranges::any_of(force.point, moves)) return;
    text_.complain(
        place + field, "no_coordinate",
        "No coordinate stands here, so this force moves nothing: write what it acts along, such as the "
        "arc l*theta, or a point that moves.");
  }

  /// Reactions follow from a linear system.
  void check_multipliers(const Vector& force, const std::string& place) {
    const std::vector<Expression>& multipliers = parsed_.symbols.multipliers;
    const auto is_linear = [&](const Expression& c) { return is_linear_in_reactions(c, multipliers); };
    if (std::ranges::all_of(force, is_linear)) return;
    text_.complain(
        place, "not_linear",
        "A force is linear in multipliers, or in their sizes: for friction write -mu*N*sign(x_dot), with a "
        "condition under valid_while that ends the motion where N changes its sign, or "
        "-mu*abs(N)*sign(x_dot).");
  }

  void read_constraints() {
    each(scene_.constraints, "/constraints", [&](const Constraint& constraint, const std::string& place) {
      parsed_.constraints.push_back(read_constraint(constraint, place + "/expression"));
    });
    const Dimension work = *dimension_of_unit("J");
    for (std::size_t i = 0; i < scene_.constraints.size(); ++i) {
      ParsedConstraint& constraint = parsed_.constraints[i];
      const auto unit = text_.dimension(constraint.expression);
      const Dimension by = constraint.holonomic ? work : work / *dimension_of_unit("s");
      if (unit) constraint.multiplier_unit = to_text(by / *unit);
      if (scene_.without_units) constraint.multiplier_unit = "1";
      const bool is_given = !scene_.constraints[i].multiplier.empty();
      parsed_.symbols.multipliers.push_back(text_.declare(
          multiplier_name(scene_.constraints[i]), unit ? std::optional(by / *unit) : unit, Context::motion,
          "/constraints/" + std::to_string(i) + (is_given ? "/multiplier" : "/name")));
    }
  }

  ParsedConstraint read_constraint(const Constraint& constraint, const std::string& place) {
    const Expression e = text_.read(constraint.expression, Context::state, place, std::nullopt);
    if (text_.has_complaint(place)) return {e, true, {}};
    const std::vector<Expression>& rates = parsed_.symbols.coordinates.rate;
    const bool holonomic = !depends_on(e, rates);
    const bool linear = std::ranges::none_of(
        rates, [&](const Expression& rate) { return depends_on(differentiate(e, rate), rates); });
    if (!linear) {
      text_.complain(place, "not_linear",
                     "A constraint is linear in the velocities, a(q,t)*q_dot + b(q,t), or has none.");
    } else if (holonomic && !depends_on(e, parsed_.symbols.coordinates.value)) {
      text_.complain(place, "no_coordinate", "This constraint contains no coordinate and no velocity.");
    }
    if (has_kinks(e)) {
      text_.complain(place, "not_applicable",
                     "A constraint has a slope everywhere: abs and sign cannot stand in it.");
    } else if (has_corners(with_squares_under_roots(e, parsed_.symbols.coordinates.value))) {
      text_.complain(
          place, "not_applicable",
          "A constraint has a slope everywhere: a root of a square, which is an abs, cannot stand in it.");
    }
    return {e, holonomic, {}};
  }

  /// Some |u| stands in it, and not in a power that has a slope where u = 0.
  [[nodiscard]] bool has_corners(const Expression& e) const {
    const Graph& graph = *parsed_.graph;
    const auto is_size = [&](NodeId id) {
      const auto* call = std::get_if<Call>(&graph.node(id));
      return call != nullptr && call->function == Function::abs;
    };
    return is_size(e.id()) || std::ranges::any_of(reachable(graph, std::vector{e.id()}), [&](NodeId id) {
             const auto* power = std::get_if<Power>(&graph.node(id));
             if (power != nullptr && Number(1) < power->exponent) return false;
             return std::ranges::any_of(children(graph.node(id)), is_size);
           });
  }

  [[nodiscard]] bool has_kinks(const Expression& e) const {
    return std::ranges::any_of(reachable(*parsed_.graph, std::vector{e.id()}), [&](NodeId id) {
      const auto* call = std::get_if<Call>(&parsed_.graph->node(id));
      return call != nullptr && (call->function == Function::abs || call->function == Function::sign);
    });
  }

  void read_conditions() {
    each(scene_.valid_while, "/valid_while",
         [&](const ValidityCondition& condition, const std::string& place) {
           parsed_.valid_while.push_back(read_quantity(condition.quantity, condition.unit, place));
         });
    each(scene_.reports, "/reports", [&](const Report& report, const std::string& place) {
      parsed_.reports.push_back(read_quantity(report.quantity, report.unit, place));
    });
    each(scene_.singular_where, "/singular_where",
         [&](const Singularity& singularity, const std::string& place) {
           parsed_.singular_where.push_back(text_.read(singularity.expression, Context::configuration,
                                                       place + "/expression", std::nullopt));
         });
    each(scene_.events, "/events", [&](const SceneEvent& event, const std::string& place) {
      parsed_.events.push_back(
          {text_.read(event.expression, Context::motion, place + "/expression", std::nullopt),
           text_.read_optional(event.when, Context::motion, place + "/when", std::nullopt)});
    });
    parsed_.impacts = parse_impacts(scene_, parsed_.symbols, parsed_.events, text_);
  }

  ParsedCondition read_quantity(const std::variant<Reaction, std::string>& quantity, const std::string& unit,
                                const std::string& place) {
    const std::optional<Dimension> d = text_.unit(unit, place);
    if (const auto* reaction = std::get_if<Reaction>(&quantity)) return read_reaction(*reaction, place);
    return text_.read(std::get<std::string>(quantity), Context::motion, place + "/expression", d);
  }

  ParsedReaction read_reaction(const Reaction& reaction, const std::string& place) {
    for (std::size_t i = 0; i < scene_.held_lengths.size(); ++i) {
      if (scene_.held_lengths[i].name == reaction.length) return {i, reaction.sign};
    }
    text_.complain(place + "/reaction/length", "unknown_symbol",
                   "There is no held length '" + reaction.length + "' in this scene.");
    return {};
  }

  /// Names that answers have as keys beside each other, or that other parts of the scene point to.
  void check_names() {
    std::set<std::string> conditions, places, bodies, events;
    const auto check = [&](std::set<std::string>& names, const std::string& what) {
      return [&, what](const auto& named, const std::string& place) {
        if (named.name.empty() || names.insert(named.name).second) return;
        text_.complain(place + "/name", "duplicate_name",
                       "The name '" + named.name + "' is used twice: " + what + " have a name each.");
      };
    };
    each(scene_.valid_while, "/valid_while", check(conditions, "conditions and reports"));
    each(scene_.reports, "/reports", check(conditions, "conditions and reports"));
    each(scene_.points, "/points", check(places, "points"));
    each(scene_.events, "/events", check(events, "events"));
    each(scene_.bodies, "/bodies", [&](const Body& body, const std::string& place) {
      std::visit([&](const auto& some) { check(bodies, "bodies")(some, place); }, body);
    });
    each(scene_.lines, "/lines", [&](const std::vector<std::string>& line, const std::string& place) {
      each(line, place, [&](const std::string& point, const std::string& here) {
        if (!places.contains(point))
          text_.complain(here, "unknown_point", "There is no point '" + point + "' in this scene.");
      });
    });
  }

  void check_whole() {
    check_names();
    if (scene_.coordinates.empty())
      text_.complain("/coordinates", "missing", "A scene needs at least one coordinate.");
    const bool by_bodies = !scene_.bodies.empty();
    if (by_bodies == parsed_.lagrangian.has_value()) {
      text_.complain("/bodies", "missing", "A scene has either bodies or a lagrangian.");
    }
    if (!by_bodies && (!scene_.gravity.empty() || !scene_.springs.empty() || !scene_.potential.empty())) {
      text_.complain("/lagrangian", "exclusive",
                     "A lagrangian contains gravity, springs and potential already.");
    }
    check_constraints();
    check_default_cycles();
  }

  void check_constraints() {
    const std::size_t n = scene_.coordinates.size();
    if (scene_.constraints.size() > n) {
      text_.complain("/constraints", "redundant",
                     std::to_string(scene_.constraints.size()) + " constraints are too many for " +
                         std::to_string(n) + " coordinates.");
    }
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
          if (depends_on(parsed_.parameter_defaults[at], parsed_.symbols.parameters[j]) &&
              seen.insert(j).second) {
            open.push_back(j);
          }
        }
      }
      if (seen.contains(i)) {
        text_.complain("/parameters/" + std::to_string(i) + "/default", "cycle",
                       "The default of '" + scene_.parameters[i].name + "' depends on itself.");
      }
    }
  }

  const Scene& scene_;
  ParsedScene parsed_;
  SceneText text_;
};

}  // namespace

ParsedScene parse_scene(const Scene& scene, std::vector<Diagnostic>& diagnostics,
                        const ExponentValues& exponents, const Followers& followers) {
  return SceneParser(scene, diagnostics, exponents, followers).parse();
}

}  // namespace qdot
