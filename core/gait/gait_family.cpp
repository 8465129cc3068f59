#include "core/gait/gait_family.hpp"
#include "core/numerics/same_bits.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_family_corrections = 8;
constexpr double difference_share = 1e-5;  // of the range, for derivatives by the parameter

}  // namespace

GaitFamily::GaitFamily(SectionMap& map, std::span<const double> parameters, std::size_t index, double from,
                       double to, double rtol)
    : map_(map),
      parameters_(parameters.begin(), parameters.end()),
      index_(index),
      from_(from),
      to_(to),
      rtol_(rtol) {}

void GaitFamily::set(double p) {
  parameters_[index_] = p;
  map_.set_parameters(parameters_);
}

VectorXd GaitFamily::along_parameter() const { return VectorXd::Unit(map_.size() + 2, map_.size() + 1); }

Corrections GaitFamily::corrections() const { return {most_family_corrections, left_by_newton * rtol_}; }

std::optional<GaitFamily::Linearization> GaitFamily::linearized(const Place& place) {
  const auto& [at, p] = place;
  const double h = difference_share * (to_ - from_);
  const double ahead = std::min(p + h, std::max(to_, p)), behind = std::max(p - h, std::min(from_, p));
  set(ahead);
  const auto a = shoot(map_, at, rtol_);
  set(behind);
  const auto b = shoot(map_, at, rtol_);
  set(p);
  auto shooting = shoot(map_, at, rtol_);
  if (!a || !b || !shooting || !(ahead > behind)) return std::nullopt;
  const Index k = map_.size();
  const double size = at.u.norm();
  MatrixXd derivative(k + 1, k + 2);
  derivative << shooting->derivative.leftCols(k), shooting->derivative.col(k) * (at.duration / size),
      (a->residual - b->residual) * ((to_ - from_) / (ahead - behind) / size);
  MatrixXd section = map_.derivative(shooting->flow);
  return Linearization{std::move(derivative), shooting->residual / size, std::move(shooting->flow),
                       std::move(section)};
}

std::optional<GaitFamily::Place> GaitFamily::moved(const Place& place, const VectorXd& step) const {
  const auto& [at, p] = place;
  const Index k = at.u.size();
  return Place{{at.u + at.u.norm() * step.head(k), at.duration * exponential(step[k])},
               p + (to_ - from_) * step[k + 1]};
}

std::optional<GaitOnCurve> GaitFamily::point(const Place& place, const VectorXd& direction) {
  return corrected(*this, place, direction, corrections());
}

std::optional<GaitOnCurve> GaitFamily::ahead(const GaitOnCurve& from, double advance) {
  return point(*moved(from.at, advance * from.tangent), from.tangent);
}

VectorXd GaitFamily::step_to(const Place& of, const Place& at) const {
  VectorXd x(at.at.u.size() + 2);
  x << (of.at.u - at.at.u) / at.at.u.norm(), logarithm(of.at.duration / at.at.duration),
      (of.p - at.p) / (to_ - from_);
  return x;
}

}  // namespace qdot
