#include "core/grading/sampled_states.hpp"

#include <array>
#include <cmath>

namespace qdot {
namespace {

/// How far from an end of its domain, or from 0, a value lies.
double distance(RandomBits& random, bool is_wide) {
  constexpr std::array<double, 3> scales{0.15, 1.7, 4.3};
  const double near = 0.3 + 1.6 * random.fraction();
  return is_wide ? near * scales[random() % scales.size()] : near;
}

double value_in(const Domain& domain, RandomBits& random, bool is_wide) {
  const bool has_lower = std::isfinite(domain.lower), has_upper = std::isfinite(domain.upper);
  if (has_lower && has_upper)
    return domain.lower + (domain.upper - domain.lower) * (0.05 + 0.9 * random.fraction());
  const double far = distance(random, is_wide);
  if (has_lower) return domain.lower + far;
  if (has_upper) return domain.upper - far;
  return random() % 2 == 0 ? far : -far;
}

}  // namespace

std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325U;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  return hash;
}

std::vector<double> SampledStates::next() {
  is_wide_ = !is_wide_;
  std::vector<double> values;
  for (const SymbolDomain& symbol : symbols_) values.push_back(value_in(symbol.domain, random_, is_wide_));
  return values;
}

}  // namespace qdot
