// The kernels, included once for each instruction set inside a namespace of its own. Nothing here may call a
// function of another file that is not always inlined: the linker would keep one copy, maybe the one for FMA.

using Four = FourDoubles;

namespace {

[[gnu::always_inline]] inline Four load(const double* x) {
  Four v;
  __builtin_memcpy(&v, x, sizeof v);
  return v;
}

[[gnu::always_inline]] inline DoubleDouble coefficient(const double* row, unsigned k) {
  return {row[k], row[run_length + k]};
}

[[gnu::always_inline]] inline void store(double* row, unsigned k, const DoubleDouble& value) {
  row[k] = value.high;
  row[run_length + k] = value.low;
  row[2 * run_length + last - k] = value.high;
  row[3 * run_length + last - k] = value.low;
}

/// sum_{j=0}^{n} x_j y_{n-j}, in four sums with their errors beside them. Source: Ogita, Rump, Oishi,
/// Accurate sum and dot product, SIAM J. Sci. Comput. 26 (2005), algorithm 5.3, with the low parts' products
/// added to the errors.
[[gnu::always_inline]] inline DoubleDouble cauchy(const double* x, const double* y, unsigned n) {
  const double* backwards = y + 2 * run_length + last - n;
  Four sum{}, errors{};
  for (unsigned j = 0; j <= n; j += 4) {
    const Four a = load(x + j), a_low = load(x + run_length + j);
    const Four b = load(backwards + j), b_low = load(backwards + run_length + j);
    const Four product = a * b;
    const Four next = sum + product;
    const Four other = next - sum;
    const Four lost = (sum - (next - other)) + (product - other);
    errors += (lost + product_error(a, b, product)) + (a * b_low + a_low * b);
    sum = next;
  }
  const DoubleDouble left = two_sum(sum[0], sum[2]), right = two_sum(sum[1], sum[3]);
  const DoubleDouble high = two_sum(left.high, right.high);
  const double low = (left.low + right.low) + ((errors[0] + errors[2]) + (errors[1] + errors[3]));
  return fast_two_sum(high.high, high.low + low);
}

/// factor x for a factor that is often 1 or -1.
[[gnu::always_inline]] inline DoubleDouble multiple(const DoubleDouble& factor, const DoubleDouble& x) {
  if (factor.low == 0 && factor.high == 1) return x;
  if (factor.low == 0 && factor.high == -1) return -x;
  return factor * x;
}

[[gnu::always_inline]] inline void sum(const Step& step, unsigned n) {
  DoubleDouble total;
  for (const Term& term : step.terms) total = total + multiple(term.factor, coefficient(term.x, n));
  for (const Product& product : step.products) {
    total = total + multiple(product.factor, cauchy(product.x, product.y, n));
  }
  store(step.out, n, total);
}

/// M_0 x_k = f_k - sum_{j>=1} M_j x_{k-j}
[[gnu::noinline]] void solve(const System& system, unsigned k) {
  DoubleDouble b[largest_system];
  for (std::size_t i = 0; i < system.n; ++i) {
    b[i] = coefficient(system.right[i], k);
    for (std::size_t j = 0; j < system.n; ++j) {
      const double* m = system.matrix[i * system.n + j];
      if (m != nullptr) b[i] = b[i] - cauchy(m, system.unknowns[j], k);
    }
  }
  const DoubleDouble* inverse = system.inverse;
  for (std::size_t i = 0; i < system.n; ++i) {
    DoubleDouble value;
    for (std::size_t j = 0; j < system.n; ++j) value = value + *inverse++ * b[j];
    store(system.unknowns[i], k, value);
  }
}

[[gnu::noinline]] void run(const Step& step, unsigned k, const DoubleDouble& reciprocal) {
  const unsigned n = k - step.lag;
  switch (step.kind) {
    case Kind::sum:
      return sum(step, n);
    case Kind::rate:
      return store(step.out, n, DoubleDouble(k) * coefficient(step.x, k));
    case Kind::integral:
      return store(step.out, k, multiple(step.factor, coefficient(step.x, k - 1) * reciprocal));
    case Kind::quotient:
      return store(step.out, n, (coefficient(step.x, n) - cauchy(step.y, step.out, n)) * step.inverse);
    case Kind::root:
      return store(step.out, n, (coefficient(step.x, n) - cauchy(step.out, step.out, n)) * step.inverse);
    case Kind::solve:
      return solve(*step.system, n);
    case Kind::still:
      return;
  }
}

}  // namespace

void expand(const Program& program, unsigned order) {
  const State& state = program.state;
  for (unsigned k = 1; k <= order; ++k) {
    const DoubleDouble reciprocal = DoubleDouble(1) / DoubleDouble(k);
    for (std::size_t i = 0; i < state.n; ++i) {
      store(state.rows[i], k, coefficient(state.rows[state.n + i], k - 1) * reciprocal);
      store(state.rows[state.n + i], k, coefficient(state.accelerations[i], k - 1) * reciprocal);
    }
    if (k == order) break;  // the state alone has one coefficient more
    for (const Step& step : program.steps) run(step, k, reciprocal);
  }
}
