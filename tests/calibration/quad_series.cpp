#include "tests/calibration/quad_series.hpp"

#include <quadmath.h>

namespace qdot::test {
namespace {

/// sum_{j=from}^{k} u_j v_{k-j}.
Quad convolution(const Quad* u, const Quad* v, unsigned from, unsigned k) {
  Quad sum = 0;
  for (unsigned j = from; j <= k; ++j) sum += u[j] * v[k - j];
  return sum;
}

/// sum_{j=1}^{k} j u_j v_{k-j} / k.
Quad weighted(const Quad* u, const Quad* v, unsigned k) {
  Quad sum = 0;
  for (unsigned j = 1; j <= k; ++j) {
    if (u[j] != 0) sum += Quad(j) * u[j] * v[k - j];
  }
  return sum / Quad(k);
}

/// Half the work of a convolution.
Quad square(const Quad* u, unsigned k) {
  Quad sum = 0;
  for (unsigned j = 0; 2 * j < k; ++j) sum += u[j] * u[k - j];
  return 2 * sum + (k % 2 == 0 ? u[k / 2] * u[k / 2] : Quad(0));
}

}  // namespace

Series Recording::record(Kind kind, Series a, Series b, Quad c) {
  steps_.push_back({kind, a.place, b.place, c});
  rows_.resize(steps_.size() * (order_ + 1));
  return {this, steps_.size() - 1};
}

Series Recording::input() { return record(Kind::input, {}, {}, 0); }

Quad Recording::coefficient(const Step& step, const Quad* out, unsigned k) {
  const Quad* a = row(step.a);
  const Quad* b = row(step.b);
  switch (step.kind) {
    case Kind::input:
      return out[k];
    case Kind::sum:
      return a[k] + b[k];
    case Kind::difference:
      return a[k] - b[k];
    case Kind::multiple:
      return step.c * a[k];
    case Kind::shifted:
      return k == 0 ? step.c + a[0] : a[k];
    case Kind::product:
      return a == b ? square(a, k) : convolution(a, b, 0, k);
    case Kind::quotient:
      return (a[k] - convolution(b, out, 1, k)) / b[0];
    case Kind::sine:
      return k == 0 ? sinq(a[0]) : weighted(a, b, k);
    case Kind::cosine:
      return k == 0 ? cosq(a[0]) : -weighted(a, b, k);
    case Kind::exponential:
      return k == 0 ? expq(a[0]) : weighted(a, out, k);
  }
  return 0;
}

void Recording::advance(unsigned k) {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    Quad* out = row(i);
    out[k] = coefficient(steps_[i], out, k);
  }
}

Series operator+(Series a, Series b) { return a.recording->record(Recording::Kind::sum, a, b, 0); }
Series operator-(Series a, Series b) { return a.recording->record(Recording::Kind::difference, a, b, 0); }
Series operator*(Series a, Series b) { return a.recording->record(Recording::Kind::product, a, b, 0); }
Series operator/(Series a, Series b) { return a.recording->record(Recording::Kind::quotient, a, b, 0); }
Series operator*(Quad c, Series a) { return a.recording->record(Recording::Kind::multiple, a, a, c); }
Series operator+(Quad c, Series a) { return a.recording->record(Recording::Kind::shifted, a, a, c); }
Series exp(Series a) { return a.recording->record(Recording::Kind::exponential, a, a, 0); }

SineAndCosine sine_and_cosine(Series a) {
  // Each needs the lower orders of the other, so that the later one may be named before it is there.
  const Series next{a.recording, a.recording->input().place + 2};
  const Series sine = a.recording->record(Recording::Kind::sine, a, next, 0);
  const Series cosine = a.recording->record(Recording::Kind::cosine, a, sine, 0);
  return {sine, cosine};
}

}  // namespace qdot::test
