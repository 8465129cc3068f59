#include "tests/calibration/quad_series.hpp"

#include "tests/calibration/precise_functions.hpp"

namespace qdot::test {
namespace {

/// sum_{j=from}^{k} u_j v_{k-j}.
template <typename Number>
Number convolution(const Number* u, const Number* v, unsigned from, unsigned k) {
  Number sum = 0;
  for (unsigned j = from; j <= k; ++j) sum += u[j] * v[k - j];
  return sum;
}

/// sum_{j=1}^{k} j u_j v_{k-j} / k.
template <typename Number>
Number weighted(const Number* u, const Number* v, unsigned k) {
  Number sum = 0;
  for (unsigned j = 1; j <= k; ++j) {
    if (u[j] != 0) sum += Number(j) * u[j] * v[k - j];
  }
  return sum / Number(k);
}

/// Half the work of a convolution.
template <typename Number>
Number square(const Number* u, unsigned k) {
  Number sum = 0;
  for (unsigned j = 0; 2 * j < k; ++j) sum += u[j] * u[k - j];
  return 2 * sum + (k % 2 == 0 ? u[k / 2] * u[k / 2] : Number(0));
}

}  // namespace

template <typename Number>
Series<Number> Recording<Number>::record(Kind kind, Series<Number> a, Series<Number> b, Number c) {
  steps_.push_back({kind, a.place, b.place, c});
  rows_.resize(steps_.size() * (order_ + 1));
  return {this, steps_.size() - 1};
}

template <typename Number>
Series<Number> Recording<Number>::input() {
  return record(Kind::input, {}, {}, 0);
}

template <typename Number>
Number Recording<Number>::coefficient(const Step& step, const Number* out, unsigned k) {
  const Number* a = row(step.a);
  const Number* b = row(step.b);
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
      return k == 0 ? sine(a[0]) : weighted(a, b, k);
    case Kind::cosine:
      return k == 0 ? cosine(a[0]) : -weighted(a, b, k);
    case Kind::exponential:
      return k == 0 ? exponential(a[0]) : weighted(a, out, k);
  }
  return 0;
}

template <typename Number>
void Recording<Number>::advance(unsigned k) {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    Number* out = row(i);
    out[k] = coefficient(steps_[i], out, k);
  }
}

template <typename Number>
Series<Number> operator+(Series<Number> a, Series<Number> b) {
  return a.recording->record(Recording<Number>::Kind::sum, a, b, 0);
}
template <typename Number>
Series<Number> operator-(Series<Number> a, Series<Number> b) {
  return a.recording->record(Recording<Number>::Kind::difference, a, b, 0);
}
template <typename Number>
Series<Number> operator*(Series<Number> a, Series<Number> b) {
  return a.recording->record(Recording<Number>::Kind::product, a, b, 0);
}
template <typename Number>
Series<Number> operator/(Series<Number> a, Series<Number> b) {
  return a.recording->record(Recording<Number>::Kind::quotient, a, b, 0);
}
template <typename Number>
Series<Number> operator*(std::type_identity_t<Number> c, Series<Number> a) {
  return a.recording->record(Recording<Number>::Kind::multiple, a, a, c);
}
template <typename Number>
Series<Number> operator+(std::type_identity_t<Number> c, Series<Number> a) {
  return a.recording->record(Recording<Number>::Kind::shifted, a, a, c);
}
template <typename Number>
Series<Number> exp(Series<Number> a) {
  return a.recording->record(Recording<Number>::Kind::exponential, a, a, 0);
}

template <typename Number>
SineAndCosine<Number> sine_and_cosine(Series<Number> a) {
  // Each needs the lower orders of the other, so that the later one may be named before it is there.
  using Kind = typename Recording<Number>::Kind;
  const Series<Number> next{a.recording, a.recording->input().place + 2};
  const Series<Number> sine = a.recording->record(Kind::sine, a, next, 0);
  const Series<Number> cosine = a.recording->record(Kind::cosine, a, sine, 0);
  return {sine, cosine};
}

#define QDOT_SERIES_OF(Number)                                       \
  template class Recording<Number>;                                  \
  template Series<Number> operator+(Series<Number>, Series<Number>); \
  template Series<Number> operator-(Series<Number>, Series<Number>); \
  template Series<Number> operator*(Series<Number>, Series<Number>); \
  template Series<Number> operator/(Series<Number>, Series<Number>); \
  template Series<Number> operator*<Number>(Number, Series<Number>); \
  template Series<Number> operator+<Number>(Number, Series<Number>); \
  template Series<Number> exp(Series<Number>);                       \
  template SineAndCosine<Number> sine_and_cosine(Series<Number>);
QDOT_SERIES_OF(Quad)
QDOT_SERIES_OF(Long)

}  // namespace qdot::test
