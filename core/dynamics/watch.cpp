#include "core/dynamics/watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/short_number.hpp"
#include "core/compile/sharp_signs.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/compile/taylor/composition.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/taylor_enclosure.hpp"

namespace qdot {
namespace {

using Quantity = std::function<double(double t, std::span<const double> y)>;

/// A compiled function of one output; not a number where it has no value.
Quantity quantity(std::shared_ptr<const CompiledFunction> function, std::span<const double> parameters) {
  return [function, workspace = function->bind(parameters)](double t, std::span<const double> y) mutable {
    double value{};
    const Evaluation evaluation = function->evaluate(t, y, workspace, {&value, 1});
    return evaluation == Evaluation::ok ? value : std::numeric_limits<double>::quiet_NaN();
  };
}

using Series = decltype(EventFunction::series);

using SharedFunction = std::shared_ptr<const CompiledFunction>;

/// A watched function of (q, q'), and the same of (q, q', q'') where there is one.
struct Watched {
  SharedFunction value, by_accelerations;
};

/// Along a piece of a motion; made ready when it is first wanted, for all copies. Where the piece's defect is
/// known its slopes are the accelerations, which need not be solved for.
Series series_of(const Watched& watched, std::span<const double> parameters) {
  struct Made {
    std::unique_ptr<TaylorComposition> whole, by_accelerations;
  };
  return [watched, values = std::vector<double>(parameters.begin(), parameters.end()),
          made = std::make_shared<Made>()](const MotionPiece& piece, unsigned order,
                                           std::span<double> coefficients) {
    const bool is_short = watched.by_accelerations && !piece.defect.empty();
    auto& composition = is_short ? made->by_accelerations : made->whole;
    if (!composition) {
      composition = is_short ? std::make_unique<TaylorComposition>(watched.by_accelerations, values,
                                                                   Variables::state_and_accelerations)
                             : std::make_unique<TaylorComposition>(watched.value, values);
    }
    return composition->expand(piece.t, piece.rows, piece.order, piece.h, order, coefficients, piece.defect);
  };
}

/// Numbers are the decimals that were typed: half a unit in the last place from their doubles.
Interval around(double number) {
  return {std::nextafter(number, -infinity), std::nextafter(number, infinity)};
}

/// The width of the values at a state.
double rounding_by(const decltype(Watch::enclosure)& enclosure, double t, std::span<const double> y,
                   std::vector<Interval>& scratch) {
  scratch.assign(y.begin(), y.end());
  const Interval values = enclosure(t, scratch);
  return values.upper - values.lower;
}

/// Parameters beyond those that are known so, such as the sides of kinks, are exact.
std::vector<Ball> numbers_of(const Reals& known, std::span<const double> all) {
  std::vector<Ball> numbers = known.as<Ball>();
  for (std::size_t i = numbers.size(); i < all.size(); ++i) numbers.emplace_back(all[i]);
  return numbers;
}

decltype(Watch::exact) exact_of(const SharedFunction& function, std::span<const double> parameters) {
  return [function, all = std::vector<double>(parameters.begin(), parameters.end())](
             const Reals& known, const Real& t, const Reals& y) {
    TapeEvaluator<Ball> evaluate(*function, numbers_of(known, all));
    evaluate.set_time(Ball::literal(t));
    Ball value;
    evaluate(y.as<Ball>(), {&value, 1});
    return value;
  };
}

decltype(Watch::sharp_signs) sharp_signs_of(const SharedFunction& function,
                                            std::span<const double> parameters) {
  return [function, all = std::vector<double>(parameters.begin(), parameters.end())](
             const Reals& known, const Reals* start, const SharpLook& look) {
    const std::vector<Ball> numbers = numbers_of(known, all);
    const std::vector<Ball> begin = start == nullptr ? std::vector<Ball>() : start->as<Ball>();
    const FunctionAlong g{*function, numbers, look.piece.t, look.piece.rows, look.piece.order + 1, begin};
    return (look.is_of_slope ? sharp_slopes : sharp_signs)(g, look.from, look.to, look.shortest);
  };
}

/// One slope after the other, with all other variables anywhere in the box.
decltype(Watch::change_over) change_over_of(const SharedFunction& function,
                                            std::span<const double> parameters) {
  const auto is_solve = [](const Instruction& i) { return i.operation == Operation::solve; };
  if (std::ranges::any_of(function->instructions(), is_solve)) return nullptr;
  std::vector<Curvature> values;
  for (const double parameter : parameters) values.push_back(Curvature::constant(around(parameter)));
  return [function, values, made = std::make_shared<std::unique_ptr<TapeEvaluator<Curvature>>>()](
             double t, std::span<const Interval> y) {
    if (!*made) *made = std::make_unique<TapeEvaluator<Curvature>>(*function, values);
    (*made)->set_time(Curvature::constant(t));
    std::vector<Curvature> box;
    for (const Interval& x : y) box.push_back(Curvature::constant(x));
    Interval change(0);
    for (std::size_t k = 0; k < y.size(); ++k) {
      const Interval middle(y[k].middle());
      box[k] = Curvature::variable(middle, y[k]);
      Curvature value;
      (**made)(box, {&value, 1});
      if (value.terms > 1) change = change + value.over[1] * (y[k] - middle);
      box[k] = Curvature::constant(y[k]);
    }
    return change;
  };
}

bool is_jump(const Instruction& i) { return i.operation == Operation::call && i.function == Function::sign; }

/// Such as changes much where its argument changes little.
bool may_be_step(const Instruction& i) {
  const bool is_steep =
      i.function == Function::tanh || i.function == Function::atan || i.function == Function::exp;
  return is_jump(i) || (i.operation == Operation::call && is_steep);
}

void watch_function(Watch& watch, const Watched& watched, std::span<const double> parameters) {
  watch.value = quantity(watched.value, parameters);
  watch.series = series_of(watched, parameters);
  watch.enclosure = enclosure_of(watched.value, parameters);
  watch.change_over = change_over_of(watched.value, parameters);
  watch.passes_once = single_crossing_of(watched.value, parameters);
  watch.may_jump = std::ranges::any_of(watched.value->instructions(), is_jump);
  watch.exact = exact_of(watched.value, parameters);
  watch.sharp_signs = sharp_signs_of(watched.value, parameters);
}

/// A scene's own functions are compiled once for all motions.
Watched watched_column(const Dynamics& dynamics, const WatchRequest& request, const Column& column) {
  return {dynamics.columns({column}, request.staying),
          request.staying == nullptr ? dynamics.by_accelerations(column.value) : nullptr};
}

/// sign (y_i - limit)
void watch_component(Watch& watch, std::size_t i, double sign, double limit) {
  watch.value = [=](double, std::span<const double> y) { return sign * (y[i] - limit); };
  watch.enclosure = [=](const Interval&, std::span<const Interval> y) {
    return Interval(sign) * (y[i] - limit);
  };
  watch.series = [=](const MotionPiece& piece, unsigned order, std::span<double> coefficients) {
    const std::span<const double> row = piece.rows.subspan(i * (piece.order + 1), piece.order + 1);
    double rest = 0;
    for (unsigned k = piece.order; k > order; --k) rest = (rest + std::abs(row[k])) * piece.h;
    for (unsigned k = 1; k <= order; ++k) rest *= piece.h;
    for (unsigned k = 0; k <= std::min(order, piece.order); ++k) coefficients[k] = sign * row[k];
    coefficients[0] -= sign * limit;
    return rest;
  };
}

/// An event: the function whose zero it is, and where that counts; null where it counts everywhere.
struct EventFunctions {
  Watched value;
  SharedFunction when;
  Crossing direction{};
};

/// A scene's own events are compiled once for all motions, as columns are; others for this one.
EventFunctions functions_of(const Dynamics& dynamics, const WatchRequest& request, const std::string& text) {
  const Model& model = dynamics.model();
  const auto kept = [&](const Expression& value) {
    return watched_column(dynamics, request, {text, "", value});
  };
  for (std::size_t i = 0; i < model.scene.events.size(); ++i) {
    if (model.scene.events[i].name != text) continue;
    const ParsedSceneEvent& event = model.parsed.events[i];
    return {kept(event.value), event.when ? kept(*event.when).value : nullptr,
            model.scene.events[i].direction};
  }
  CompiledEvent event = dynamics.event(text, request.staying);
  return {{std::make_shared<const CompiledFunction>(std::move(event.value)), nullptr},
          event.when ? std::make_shared<const CompiledFunction>(std::move(*event.when)) : nullptr,
          event.direction};
}

Watch watch_event(const EventFunctions& event, const WatchRequest& request, const std::string& text) {
  Watch watch;
  watch.name = text;
  watch.direction = event.direction;
  watch_function(watch, event.value, request.parameters);
  if (event.when) {
    watch.condition = quantity(event.when, request.parameters);
    watch.when_enclosure = enclosure_of(event.when, request.parameters);
  }
  return watch;
}

/// Of an event that is reported only: at a jump or a step it may happen though it is not small.
void add_jumps(const EventFunctions& event, const WatchRequest& request, const std::string& text,
               std::vector<Watch>& all) {
  for (const Instruction& i : event.value.value->instructions()) {
    if (!may_be_step(i)) continue;
    Watch& watch = all.emplace_back(Watch{.kind = Watch::Kind::jump, .name = text});
    const auto argument = std::make_shared<const CompiledFunction>(event.value.value->argument_of(i));
    watch_function(watch, {argument, nullptr}, request.parameters);
  }
}

/// What must not fall below zero for e to have a value: arguments of roots and logarithms, and for those of
/// inverse sines and cosines how far they are from 1 and from -1.
std::vector<Expression> arguments_with_an_end(const Expression& e) {
  std::vector<Expression> found;
  const NodeId root = e.id();
  for (const NodeId id : reachable(e.graph(), {&root, 1})) {
    const Node& node = e.graph().node(id);
    const auto* call = std::get_if<Call>(&node);
    const auto* power = std::get_if<Power>(&node);
    if (call != nullptr && call->function == Function::log) found.emplace_back(e.graph(), call->argument);
    if (call != nullptr && (call->function == Function::asin || call->function == Function::acos)) {
      const Expression one = e.graph().number(1), argument(e.graph(), call->argument);
      found.push_back(one - argument);
      found.push_back(one + argument);
    }
    if (power != nullptr && !power->exponent.is_integer()) found.emplace_back(e.graph(), power->base);
  }
  return found;
}

/// By more than rounding, as 1 - cos(x) is not.
bool may_be_negative(const Watch& watch, const Dynamics& dynamics) {
  constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();
  const std::vector<Interval> anywhere(2 * dynamics.model().scene.coordinates.size(), Interval::whole());
  const Interval values = watch.enclosure(Interval::whole(), anywhere);
  return values.lower < 0 && !(values.lower >= -roundings * values.upper && values.is_finite());
}

/// A condition is broken where it ceases to have a value, too.
void add_validity(const Dynamics& dynamics, const WatchRequest& request, std::vector<Watch>& all) {
  const std::vector<Column> columns = validity_columns(dynamics.model());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const ValidityCondition& condition = dynamics.model().scene.valid_while[i];
    Watch watch{.kind = Watch::Kind::validity,
                .name = condition.name,
                .reason = condition.reason,
                .message = condition.message,
                .direction = Crossing::falling};
    std::vector<Column> functions{columns[i]};
    for (const Expression& u : arguments_with_an_end(columns[i].value))
      functions.push_back({condition.name, "", u});
    for (const Column& function : functions) {
      watch_function(watch, watched_column(dynamics, request, function), request.parameters);
      if (function.value == columns[i].value || may_be_negative(watch, dynamics)) all.push_back(watch);
    }
  }
}

Watch singularity(const std::string& name, const std::string& message, Crossing direction) {
  return {.kind = Watch::Kind::singularity,
          .name = name,
          .reason = "coordinate_singularity",
          .message = message,
          .direction = direction};
}

void add_domains(const Dynamics& dynamics, std::vector<Watch>& all) {
  const std::vector<Coordinate>& coordinates = dynamics.model().scene.coordinates;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const Domain& domain = coordinates[i].domain;
    const std::string message =
        "The coordinate " + coordinates[i].name + " left the range in which it describes a configuration.";
    const auto add = [&](double sign, double limit) {
      if (!std::isfinite(limit)) return;
      const std::string name = coordinates[i].name + " = " + short_number(limit);
      all.push_back(singularity(name, message, Crossing::falling));
      watch_component(all.back(), i, sign, limit);
    };
    add(1, domain.lower);
    add(-1, domain.upper);
  }
}

void add_singularities(const Dynamics& dynamics, const WatchRequest& request, std::vector<Watch>& all) {
  const Model& model = dynamics.model();
  for (std::size_t i = 0; i < model.scene.singular_where.size(); ++i) {
    const Singularity& place = model.scene.singular_where[i];
    const Column column{place.name, "", model.parsed.singular_where[i]};
    all.push_back(singularity(place.name, place.message, Crossing::either));
    watch_function(all.back(), watched_column(dynamics, request, column), request.parameters);
  }
}

}  // namespace

decltype(Watch::enclosure) enclosure_of(SharedFunction function, std::span<const double> parameters) {
  std::vector<Interval> values;
  for (const double parameter : parameters) values.push_back(around(parameter));
  return [function, values, made = std::make_shared<std::unique_ptr<TapeEvaluator<Interval>>>()](
             const Interval& t, std::span<const Interval> y) {
    if (!*made) *made = std::make_unique<TapeEvaluator<Interval>>(*function, values);
    (*made)->set_time(t);
    Interval value;
    (**made)(y, {&value, 1});
    return value;
  };
}

double Watch::rounding(double t, std::span<const double> y) const {
  std::vector<Interval> box;
  for (const double x : y) box.push_back(around(x));
  const Interval values = enclosure(t, box);
  return values.upper - values.lower;
}

double Watch::own_rounding(double t, std::span<const double> y) const {
  std::vector<Interval> scratch;
  return rounding_by(enclosure, t, y, scratch);
}

EventFunction Watch::event() const {
  EventFunction event{
      .value = value,
      .series = series,
      .rounding = [of = enclosure, scratch = std::vector<Interval>()](
                      double t, std::span<const double> y) mutable { return rounding_by(of, t, y, scratch); },
      .range = enclosure,
      .direction = direction,
      .terminal = kind != Kind::event && kind != Kind::jump,
      .counts_at_start = kind == Kind::impact,
      .condition = condition};
  event.must_have_value = kind == Kind::validity;
  return event;
}

std::vector<Watch> watches(const Dynamics& dynamics, const WatchRequest& request) {
  std::vector<Watch> all;
  const Model& model = dynamics.model();
  const std::span impacts =
      request.impacts == Impacts::apply ? std::span(model.parsed.impacts) : std::span<const ParsedImpact>();
  for (const std::string& text : request.events) {
    if (std::ranges::find(impacts, text, &ParsedImpact::event) != impacts.end()) continue;
    const EventFunctions event = functions_of(dynamics, request, text);
    all.push_back(watch_event(event, request, text));
    add_jumps(event, request, text, all);
  }
  if (request.on_invalid == OnInvalid::stop) add_validity(dynamics, request, all);
  add_domains(dynamics, all);
  add_singularities(dynamics, request, all);
  for (const ParsedImpact& impact : impacts) {
    all.push_back(watch_event(functions_of(dynamics, request, impact.event), request, impact.event));
    all.back().kind = Watch::Kind::impact;
  }
  return all;
}

}  // namespace qdot
