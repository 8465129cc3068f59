// The kernels, included once for each instruction set inside a namespace of its own. Nothing here may call a
// function of another file that is inline: the linker would keep one copy, maybe the one for AVX2.

using Four [[gnu::vector_size(32)]] = double;

namespace {

[[gnu::always_inline]] inline Four load(const double* x) {
  Four v;
  __builtin_memcpy(&v, x, sizeof v);
  return v;
}

/// Partial sums of a Cauchy product of order K without its ends j = 0 and j = K, which are younger than the
/// others and kept apart: a vector load of what was just stored would wait.
template <unsigned K>
struct Inner {
  static constexpr unsigned terms = K > 0 ? K - 1 : 0;
  static constexpr unsigned blocks = terms / 4;
  static constexpr unsigned rest = terms % 4;
};

template <unsigned K>
[[gnu::always_inline]] inline void add_blocks(Four& sum, const double* x, const double* y, double c) {
  if constexpr (Inner<K>::blocks > 0) {
    const double* backwards = y + (reversed - K);
    Four part = load(x + 1) * load(backwards + 1);
#pragma GCC unroll 8
    for (unsigned b = 1; b < Inner<K>::blocks; ++b) part += load(x + 1 + 4 * b) * load(backwards + 1 + 4 * b);
    sum += c * part;
  }
}

template <unsigned K>
[[gnu::always_inline]] inline double rest_of(const double* x, const double* y) {
  double sum = 0;
#pragma GCC unroll 4
  for (unsigned j = 1 + 4 * Inner<K>::blocks; j < K; ++j) sum += x[j] * y[K - j];
  return sum;
}

[[gnu::always_inline]] inline double joined(const Four& sum) { return (sum[0] + sum[2]) + (sum[1] + sum[3]); }

/// sum_{j=1}^{K-1} x_j y_{K-j}
template <unsigned K>
[[gnu::always_inline]] inline double inner(const double* x, const double* y) {
  Four sum{};
  add_blocks<K>(sum, x, y, 1.0);
  return joined(sum) + rest_of<K>(x, y);
}

template <unsigned K>
[[gnu::always_inline]] inline void store(double* row, double value) {
  row[K] = value;
  row[reversed - K] = value;
}

template <unsigned K>
[[gnu::always_inline]] inline void sum(const Step& step) {
  const double* const* operand = step.operands;
  double total = 0;
  for (unsigned i = 0; i < step.pairs; ++i, operand += 2) total += operand[0][0] * operand[1][K];
  if (step.triples > 0) {
    Four lanes{};
    for (unsigned i = 0; i < step.triples; ++i, operand += 3) {
      const double c = operand[0][0];
      const double* x = operand[1];
      const double* y = operand[2];
      add_blocks<K>(lanes, x, y, c);
      total += c * (rest_of<K>(x, y) + (x[0] * y[K] + x[K] * y[0]));
    }
    if constexpr (Inner<K>::blocks > 0) total += joined(lanes);
  }
  store<K>(step.out, total);
}

template <unsigned K>
[[gnu::always_inline]] inline void quotient(const Step& step) {
  const double* x = step.operands[0];
  const double* y = step.operands[1];
  store<K>(step.out, (x[K] - (inner<K>(y, step.out) + y[K] * step.out[0])) / y[0]);
}

template <unsigned K>
[[gnu::always_inline]] inline void root(const Step& step) {
  store<K>(step.out, (step.operands[0][K] - inner<K>(step.out, step.out)) / (2 * step.out[0]));
}

/// z = x^c: x z' = c x' z.
template <unsigned K>
[[gnu::always_inline]] inline void power(const Step& step) {
  const double* x = step.operands[0];
  double total = 0;
  for (unsigned j = 0; j < K; ++j) total += (step.constant * (K - j) - j) * x[K - j] * step.out[j];
  store<K>(step.out, total / (K * x[0]));
}

/// The row of k u_k, with which (f(u))' = f'(u) u' becomes a product.
template <unsigned K>
[[gnu::always_inline]] inline void differentiate(const Step& step) {
  store<K>(step.aux, K * step.operands[0][K]);
}

template <unsigned K>
[[gnu::always_inline]] inline void sine_cosine(const Step& step) {
  differentiate<K>(step);
  const double last = step.aux[K];
  const double sine = inner<K>(step.aux, step.out2) + last * step.out2[0];
  const double cosine = inner<K>(step.aux, step.out) + last * step.out[0];
  store<K>(step.out, sine / K);
  store<K>(step.out2, -(cosine / K));
}

template <unsigned K>
[[gnu::always_inline]] inline void hyperbolic(const Step& step) {
  differentiate<K>(step);
  const double last = step.aux[K];
  const double first = inner<K>(step.aux, step.out2) + last * step.out2[0];
  const double second = inner<K>(step.aux, step.out) + last * step.out[0];
  store<K>(step.out, first / K);
  store<K>(step.out2, second / K);
}

template <unsigned K>
[[gnu::always_inline]] inline void exponential(const Step& step) {
  differentiate<K>(step);
  store<K>(step.out, (inner<K>(step.aux, step.out) + step.aux[K] * step.out[0]) / K);
}

/// z = log u: u z' = u'.
template <unsigned K>
[[gnu::always_inline]] inline void logarithm(const Step& step) {
  const double* u = step.operands[0];
  double total = 0;
  for (unsigned j = 1; j < K; ++j) total += j * step.out[j] * u[K - j];
  store<K>(step.out, (u[K] - total / K) / u[0]);
}

/// z' = w u' with w = 1 + constant z^2.
template <unsigned K>
[[gnu::always_inline]] inline void tangent(const Step& step) {
  differentiate<K>(step);
  double* z = step.out;
  store<K>(z, (inner<K>(step.aux, step.aux2) + step.aux[K] * step.aux2[0]) / K);
  store<K>(step.aux2, step.constant * (inner<K>(z, z) + 2 * (z[0] * z[K])));
}

/// w z' = constant u', w in the row that the instruction before has filled.
template <unsigned K>
[[gnu::always_inline]] inline void arc(const Step& step) {
  differentiate<K>(step);
  const double* w = step.aux2;
  double total = 0;
  for (unsigned j = 1; j < K; ++j) total += j * step.out[j] * w[K - j];
  store<K>(step.out, (step.constant * step.aux[K] - total) / (K * w[0]));
}

template <unsigned K>
[[gnu::always_inline]] inline void solve(const Solve& system) {
  double b[16];
  for (unsigned i = 0; i < system.n; ++i) {
    double value = system.right[i][K];
    for (unsigned j = 0; j < system.n; ++j) {
      const double* m = system.matrix[i * system.n + j];
      if (m == nullptr) continue;
      const double* x = system.unknowns[j];
      value -= inner<K>(m, x) + m[K] * x[0];
    }
    b[i] = value;
  }
  system.substitute(system.factors, b);
  for (unsigned i = 0; i < system.n; ++i) store<K>(system.unknowns[i], b[i]);
}

template <unsigned K>
[[gnu::always_inline]] inline void raise_state(const State& state) {
  for (std::size_t i = 0; i < state.n; ++i) {
    store<K>(state.rows[i], state.rows[state.n + i][K - 1] / K);
    store<K>(state.rows[state.n + i], state.accelerations[i][K - 1] / K);
  }
}

template <unsigned K>
[[gnu::noinline]] void pass(const Program& program) {
  raise_state<K>(program.state);
  for (const Step *step = program.steps, *end = step + program.count; step != end; ++step) {
    switch (step->kind) {
      case Kind::sum:
        sum<K>(*step);
        break;
      case Kind::quotient:
        quotient<K>(*step);
        break;
      case Kind::power:
        power<K>(*step);
        break;
      case Kind::root:
        root<K>(*step);
        break;
      case Kind::sine_cosine:
        sine_cosine<K>(*step);
        break;
      case Kind::exponential:
        exponential<K>(*step);
        break;
      case Kind::logarithm:
        logarithm<K>(*step);
        break;
      case Kind::tangent:
        tangent<K>(*step);
        break;
      case Kind::hyperbolic:
        hyperbolic<K>(*step);
        break;
      case Kind::arc:
        arc<K>(*step);
        break;
      case Kind::solve:
        solve<K>(*step->solve);
        break;
    }
  }
}

template <unsigned K>
void passes(const Program& program, unsigned order) {
  if constexpr (K < highest_order) {
    if (K < order) {
      pass<K>(program);
      return passes<K + 1>(program, order);
    }
  }
  raise_state<K>(program.state);  // K == order: the state alone has one coefficient more
}

}  // namespace

void expand(const Program& program, unsigned order) { passes<1>(program, order); }
