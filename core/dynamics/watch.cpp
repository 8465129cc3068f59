#include "core/dynamics/watch.hpp"

#include <cmath>
#include <limits>

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

Watch watch_event(const Dynamics& dynamics, const WatchRequest& request, const std::string& text) {
  CompiledEvent event = dynamics.event(text);
  Watch watch;
  watch.name = text;
  watch.direction = event.direction;
  watch.value =
      quantity(std::make_shared<const CompiledFunction>(std::move(event.value)), request.parameters);
  if (event.when) {
    const Quantity when =
        quantity(std::make_shared<const CompiledFunction>(std::move(*event.when)), request.parameters);
    watch.condition = [when](double t, std::span<const double> y) { return when(t, y) > 0; };
  }
  return watch;
}

void add_validity(const Dynamics& dynamics, const WatchRequest& request, std::vector<Watch>& all) {
  const std::vector<Column> columns = validity_columns(dynamics.model());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const ValidityCondition& condition = dynamics.model().scene.valid_while[i];
    Watch watch{Watch::Kind::validity,
                condition.name,
                condition.reason,
                condition.message,
                Crossing::falling,
                {},
                {}};
    watch.value = quantity(dynamics.columns({columns[i]}), request.parameters);
    all.push_back(std::move(watch));
  }
}

Watch singularity(const std::string& message, Crossing direction, Quantity value) {
  return {Watch::Kind::singularity, "", "coordinate_singularity", message, direction, std::move(value), {}};
}

void add_domains(const Dynamics& dynamics, std::vector<Watch>& all) {
  const std::vector<Coordinate>& coordinates = dynamics.model().scene.coordinates;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const Domain& domain = coordinates[i].domain;
    const std::string message =
        "The coordinate " + coordinates[i].name + " left the range in which it describes a configuration.";
    if (std::isfinite(domain.lower)) {
      all.push_back(
          singularity(message, Crossing::falling,
                      [i, lower = domain.lower](double, std::span<const double> y) { return y[i] - lower; }));
    }
    if (std::isfinite(domain.upper)) {
      all.push_back(
          singularity(message, Crossing::falling,
                      [i, upper = domain.upper](double, std::span<const double> y) { return upper - y[i]; }));
    }
  }
}

void add_singularities(const Dynamics& dynamics, const WatchRequest& request, std::vector<Watch>& all) {
  const Model& model = dynamics.model();
  for (std::size_t i = 0; i < model.scene.singular_where.size(); ++i) {
    const Column column{model.scene.singular_where[i].name, "", model.parsed.singular_where[i]};
    all.push_back(singularity(model.scene.singular_where[i].message, Crossing::either,
                              quantity(dynamics.columns({column}), request.parameters)));
  }
}

}  // namespace

EventFunction Watch::event() const { return {value, direction, kind != Kind::event, condition}; }

std::vector<Watch> watches(const Dynamics& dynamics, const WatchRequest& request) {
  std::vector<Watch> all;
  const Model& model = dynamics.model();
  const bool with_impacts = model.scene.impact && request.impacts == Impacts::apply;
  for (const std::string& text : request.events) {
    if (!with_impacts || text != model.scene.impact->event)
      all.push_back(watch_event(dynamics, request, text));
  }
  if (request.on_invalid == OnInvalid::stop) add_validity(dynamics, request, all);
  add_domains(dynamics, all);
  add_singularities(dynamics, request, all);
  if (with_impacts) {
    all.push_back(watch_event(dynamics, request, model.scene.impact->event));
    all.back().kind = Watch::Kind::impact;
  }
  return all;
}

}  // namespace qdot
