// The kernels, included once for each instruction set inside a namespace of its own. Nothing here may call a
// function of another file that is inline: the linker would keep one copy, maybe the one for AVX2.
//
// Numbers are doubles, or two side by side: what is done to one of them is done to it alone as well, so that
// its bits are the same.
//
// What the pass before has just computed is the last to be added: the rest of a sum does not wait for it.

using Four [[gnu::vector_size(32)]] = double;

namespace {

template <class Number>
[[gnu::always_inline]] inline Four load(const Number* x) {
  Four v;
  __builtin_memcpy(&v, x, sizeof v);
  return v;
}

/// Four numbers.
template <class Number>
struct Block;
template <>
struct Block<double> {
  Four all;
};
template <>
struct Block<PairOfDoubles> {
  Four first, last;
};

[[gnu::always_inline]] inline Block<double> product(const double* x, const double* y) {
  return {load(x) * load(y)};
}
[[gnu::always_inline]] inline Block<PairOfDoubles> product(const PairOfDoubles* x, const PairOfDoubles* y) {
  return {load(x) * load(y), load(x + 2) * load(y + 2)};
}
[[gnu::always_inline]] inline void operator+=(Block<double>& sum, const Block<double>& x) {
  sum.all += x.all;
}
[[gnu::always_inline]] inline void operator+=(Block<PairOfDoubles>& sum, const Block<PairOfDoubles>& x) {
  sum.first += x.first;
  sum.last += x.last;
}
[[gnu::always_inline]] inline Block<double> operator*(double factor, const Block<double>& x) {
  return {factor * x.all};
}
[[gnu::always_inline]] inline Block<PairOfDoubles> operator*(const PairOfDoubles& factor,
                                                             const Block<PairOfDoubles>& x) {
  const Four twice = __builtin_shufflevector(factor, factor, 0, 1, 0, 1);
  return {twice * x.first, twice * x.last};
}
[[gnu::always_inline]] inline double joined(const Block<double>& x) {
  const PairOfDoubles sum =
      __builtin_shufflevector(x.all, x.all, 0, 1) + __builtin_shufflevector(x.all, x.all, 2, 3);
  return sum[0] + sum[1];
}
[[gnu::always_inline]] inline PairOfDoubles joined(const Block<PairOfDoubles>& x) {
  const Four sum = x.first + x.last;
  return __builtin_shufflevector(sum, sum, 0, 1) + __builtin_shufflevector(sum, sum, 2, 3);
}

/// Partial sums of a Cauchy product of order K without its ends j = 0 and j = K, which are younger than the
/// others and kept apart: a vector load of what was just stored would wait.
template <unsigned K>
struct Inner {
  static constexpr unsigned terms = K > 0 ? K - 1 : 0;
  static constexpr unsigned blocks = terms / 4;
  static constexpr unsigned rest = terms % 4;
};

template <unsigned K, class Number>
[[gnu::always_inline]] inline Block<Number> blocks_of(const Number* x, const Number* y) {
  const Number* backwards = y + (reversed - static_cast<int>(K));
  Block<Number> part = product(x + 1, backwards + 1);
#pragma GCC unroll 8
  for (unsigned b = 1; b < Inner<K>::blocks; ++b) part += product(x + 1 + 4 * b, backwards + 1 + 4 * b);
  return part;
}

template <unsigned K, class Number>
[[gnu::always_inline]] inline Number rest_of(const Number* x, const Number* y) {
  if constexpr (Inner<K>::rest == 0) return Number{};
  constexpr unsigned first = 1 + 4 * Inner<K>::blocks;
  Number sum = x[first] * y[K - first];
#pragma GCC unroll 4
  for (unsigned j = first + 1; j < K; ++j) sum += x[j] * y[K - j];
  return sum;
}

/// sum_{j=1}^{K-1} x_j y_{K-j}
template <unsigned K, class Number>
[[gnu::always_inline]] inline Number inner(const Number* x, const Number* y) {
  if constexpr (Inner<K>::blocks > 0) {
    const Number sum = joined(blocks_of<K>(x, y));
    return Inner<K>::rest > 0 ? sum + rest_of<K>(x, y) : sum;
  } else {
    return rest_of<K>(x, y);
  }
}

/// sum_{j=0}^{K} x_j y_{K-j}
template <unsigned K, class Number>
[[gnu::always_inline]] inline Number cauchy(const Number* x, const Number* y) {
  if constexpr (K == 0) {
    return x[0] * y[0];
  } else {
    return inner<K>(x, y) + (x[0] * y[K] + x[K] * y[0]);
  }
}

template <unsigned K, class Number>
[[gnu::always_inline]] inline void store(Number* row, const Number& value) {
  row[K] = value;
  row[reversed - static_cast<int>(K)] = value;
}

template <unsigned K>
inline constexpr double reciprocal = 1.0 / K;

/// x/K. Divided where it matters: the rounding of 1/3 is the same in every step,
/// and an energy would drift by it.
template <unsigned K, class Number>
[[gnu::always_inline]] inline Number divided(const Number& x) {
  return K <= 8 ? x / double{K} : x * reciprocal<K>;
}

/// What of the products was there before this pass.
template <unsigned K, class Number>
[[gnu::always_inline]] inline Number old_of(const BasicProduct<Number>* p, unsigned products) {
  Number total = p->factor * inner<K>(p->x, p->y);
#pragma GCC unroll 2
  for (unsigned i = 1; i < products; ++i) total += p[i].factor * inner<K>(p[i].x, p[i].y);
  return total;
}
template <unsigned K, class Number>
[[gnu::always_inline]] inline Number young_of(const BasicProduct<Number>& p) {
  return p.x_0 * p.y[K] + p.x[K] * p.y_0;
}

/// The factors of products are often what the step before has computed.
template <unsigned K, class Number>
[[gnu::always_inline]] inline void sum(const BasicStep<Number>& step, unsigned terms, unsigned products) {
  if (terms + products == 0) return store<K>(step.out, Number{});
  const BasicProduct<Number>* p = step.products;
  Number total = terms > 0 ? step.terms[0].factor * step.terms[0].x[K] : young_of<K>(*p);
#pragma GCC unroll 3
  for (unsigned i = 1; i < terms; ++i) total += step.terms[i].factor * step.terms[i].x[K];
#pragma GCC unroll 2
  for (unsigned i = terms > 0 ? 0 : 1; i < products; ++i) total += young_of<K>(p[i]);
  if constexpr (K > 1) {
    if (products > 0) total = old_of<K>(p, products) + total;
  }
  store<K>(step.out, total);
}

template <unsigned K, class Number>
[[gnu::noinline]] void sum_any(const BasicStep<Number>& step) {
  sum<K>(step, step.term_count, step.product_count);
}

template <unsigned K, class Number>
[[gnu::always_inline]] inline void rate_of_sum(const BasicStep<Number>& step) {
  Number total{};
  for (unsigned i = 0; i < step.term_count; ++i) total += step.terms[i].factor * step.terms[i].x[K - 1];
  store<K - 1>(step.out, total);
}

template <unsigned K, class Number>
[[gnu::always_inline]] inline void quotient(const BasicStep<Number>& step) {
  const Number old = inner<K>(step.y, step.out);
  store<K>(step.out, (step.x[K] - (old + step.y[K] * step.out[0])) * step.aux[0]);
}

template <unsigned K, class Number>
[[gnu::noinline]] void root(const BasicStep<Number>& step) {
  store<K>(step.out, (step.x[K] - inner<K>(step.out, step.out)) * step.aux[0]);
}

/// z = x^c: x z' = c x' z.
template <unsigned K, class Number>
[[gnu::noinline]] void power(const BasicStep<Number>& step) {
  Number total{};
  for (unsigned j = 0; j < K; ++j)
    total += (step.constant * double(K - j) - double(j)) * step.x[K - j] * step.out[j];
  store<K>(step.out, total / (double{K} * step.x[0]));
}

// f(u)' = f'(u) u': coefficient K - 1 of the product is K times the one wanted.

template <unsigned K, class Number>
[[gnu::always_inline]] inline void sine_cosine(const BasicStep<Number>& step) {
  const Number sine = cauchy<K - 1>(step.x, step.out2);
  const Number cosine = cauchy<K - 1>(step.x, step.out);
  store<K>(step.out, divided<K>(sine));
  store<K>(step.out2, -divided<K>(cosine));
}

template <unsigned K, class Number>
[[gnu::noinline]] void hyperbolic(const BasicStep<Number>& step) {
  const Number first = cauchy<K - 1>(step.x, step.out2);
  const Number second = cauchy<K - 1>(step.x, step.out);
  store<K>(step.out, divided<K>(first));
  store<K>(step.out2, divided<K>(second));
}

template <unsigned K, class Number>
[[gnu::noinline]] void exponential(const BasicStep<Number>& step) {
  store<K>(step.out, divided<K>(cauchy<K - 1>(step.x, step.out)));
}

/// z = log u: u z' = u'.
template <unsigned K, class Number>
[[gnu::noinline]] void logarithm(const BasicStep<Number>& step) {
  Number total{};
  for (unsigned j = 1; j < K; ++j) total += double(j) * step.out[j] * step.x[K - j];
  store<K>(step.out, (step.x[K] - total / double{K}) / step.x[0]);
}

/// z' = w u' with w = 1 + constant z^2.
template <unsigned K, class Number>
[[gnu::noinline]] void tangent(const BasicStep<Number>& step) {
  Number* z = step.out;
  store<K>(z, divided<K>(cauchy<K - 1>(step.x, step.aux)));
  store<K>(step.aux, step.constant * (inner<K>(z, z) + 2.0 * (z[0] * z[K])));
}

/// w z' = constant u'.
template <unsigned K, class Number>
[[gnu::noinline]] void arc(const BasicStep<Number>& step) {
  Number total{};
  for (unsigned j = 1; j < K; ++j) total += double(j) * step.out[j] * step.y[K - j];
  store<K>(step.out, (step.constant * step.x[K - 1] - total) / (double{K} * step.y[0]));
}

/// M_0 x_K = f_K - sum_{j>=1} M_j x_{K-j}
template <unsigned K, class Number>
[[gnu::always_inline]] inline void solve(const BasicSolve<Number>& system, unsigned n) {
  Number b[largest_system];
#pragma GCC unroll 3
  for (unsigned i = 0; i < n; ++i) {
    Number lagged{};
    Block<Number> lanes{};
#pragma GCC unroll 3
    for (unsigned j = 0; j < n; ++j) {
      const auto& [factor, m, m_factor_x] = system.matrix[i * n + j];
      if (m == nullptr) continue;
      const Number* x = system.unknowns[j];
      if constexpr (Inner<K>::blocks > 0) lanes += factor * blocks_of<K>(m, x);
      if constexpr (Inner<K>::rest > 0) lagged += factor * rest_of<K>(m, x);
      lagged += m[K] * m_factor_x;
    }
    if constexpr (Inner<K>::blocks > 0) lagged += joined(lanes);
    b[i] = system.right[i][K] - lagged;
  }
  const Number* inverse = system.inverse;
#pragma GCC unroll 3
  for (unsigned i = 0; i < n; ++i) {
    Number value = inverse[0] * b[0];
#pragma GCC unroll 3
    for (unsigned j = 1; j < n; ++j) value += inverse[j] * b[j];
    store<K>(system.unknowns[i], value);
    inverse += n;
  }
}

template <unsigned K, class Number>
[[gnu::noinline]] void solve_any(const BasicSolve<Number>& system) {
  solve<K>(system, system.n);
}

template <unsigned K, class Number>
[[gnu::always_inline]] inline void raise_state(const BasicState<Number>& state) {
  Number* q = state.rows;
  Number* v = q + state.n * stride;
  for (std::size_t i = 0; i < state.n; ++i, q += stride, v += stride) {
    store<K>(q, divided<K>(v[K - 1]));
    store<K>(v, divided<K>(state.accelerations[i][K - 1]));
  }
}

template <unsigned K, class Number>
[[gnu::noinline]] void pass(const BasicProgram<Number>& program) {
  raise_state<K>(program.state);
  for (const BasicStep<Number>*step = program.steps, *end = step + program.count; step != end; ++step) {
    switch (step->kind) {
      case Kind::sum:
        sum_any<K>(*step);
        break;
      case Kind::sum_1_0:
        sum<K>(*step, 1, 0);
        break;
      case Kind::sum_2_0:
        sum<K>(*step, 2, 0);
        break;
      case Kind::sum_0_1:
        sum<K>(*step, 0, 1);
        break;
      case Kind::sum_1_1:
        sum<K>(*step, 1, 1);
        break;
      case Kind::sum_2_1:
        sum<K>(*step, 2, 1);
        break;
      case Kind::sum_3_1:
        sum<K>(*step, 3, 1);
        break;
      case Kind::sum_0_2:
        sum<K>(*step, 0, 2);
        break;
      case Kind::sum_1_2:
        sum<K>(*step, 1, 2);
        break;
      case Kind::sum_2_2:
        sum<K>(*step, 2, 2);
        break;
      case Kind::rate:
        store<K - 1>(step->out, double{K} * step->x[K]);
        break;
      case Kind::rate_of_sum:
        rate_of_sum<K>(*step);
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
      case Kind::absolute:
        store<K>(step->out, step->constant * step->x[K]);
        break;
      case Kind::sign:
      case Kind::still:
        break;
      case Kind::arc:
        arc<K>(*step);
        break;
      case Kind::solve:
        solve_any<K>(*step->solve);
        break;
      case Kind::solve_2:
        solve<K>(*step->solve, 2);
        break;
      case Kind::solve_3:
        solve<K>(*step->solve, 3);
        break;
      default:
        __builtin_unreachable();
    }
  }
}

template <unsigned K, class Number>
void passes(const BasicProgram<Number>& program, unsigned order) {
  if constexpr (K < highest_order_of<Number>) {
    if (K < order) {
      pass<K>(program);
      return passes<K + 1>(program, order);
    }
  }
  raise_state<K>(program.state);  // K == order: the state alone has one coefficient more
}

}  // namespace

void expand(const Program& program, unsigned order) { passes<1>(program, order); }

void expand_pair(const PairProgram& program, unsigned order) { passes<1>(program, order); }
