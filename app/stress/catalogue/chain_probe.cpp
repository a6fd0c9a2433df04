// Chains on targets in closed form, over many seeds, block by block.
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/stress/catalogue/probes.h"
#include "app/stress/oracle.h"
#include "app/stress/technique.h"
#include "app/stress/toy.h"
#include "core/base/log.h"

namespace pssmlt::stress {
namespace {

constexpr int width = 8, height = 4, blocks = 4;  // blocks: columns of two pixels
// What the text of the catalogue asks of chi-squares; seeds are fixed, so a run repeats itself.
constexpr double least_p = 1e-4;
constexpr double rounding = 1e-6;  // relative; of targets, which are floats

float radiance(const ChainTarget& t, double x, float a, float b) {
  const auto ramp = static_cast<float>(1.0 + x / width);
  switch (t.kind) {
    case ChainTarget::constant:
      return 1.f;
    case ChainTarget::smooth:
      return ramp * (.5f + a) * (.5f + b);
    // Half of the energy in `size` of the space.
    case ChainTarget::spike: {
      const auto side = static_cast<float>(std::sqrt(t.size));
      return ramp * (a < side && b < side ? 1.f + 1.f / (side * side) : 1.f);
    }
    // Eight islands along the diagonal, each `size` wide and high.
    case ChainTarget::islands: {
      const float u = 8.f * a, v = 8.f * b;
      const bool on = std::floor(u) == std::floor(v) && u - std::floor(u) < 8.f * t.size &&
                      v - std::floor(v) < 8.f * t.size;
      return on ? ramp / static_cast<float>(8.0 * t.size * t.size) : 0.f;
    }
    // A gap `size` wide in one number.
    case ChainTarget::gap:
      return std::abs(a - .5f) < .5f * t.size ? ramp / t.size : 0.f;
  }
  return 0.f;
}

// Means over the picture's columns of two pixels; the side lengths are what floats make of them.
std::array<double, blocks> truth(const ChainTarget& t) {
  std::array<double, blocks> values{};
  for (int b = 0; b < blocks; ++b) {
    const double ramp = 1.0 + (2.0 * b + 1.0) / width;
    values[static_cast<size_t>(b)] = t.kind == ChainTarget::constant ? 1.0
                                     : t.kind == ChainTarget::spike  ? 2.0 * ramp
                                                                     : ramp;
  }
  return values;
}

ParameterSet parameters(const ChainTarget& t, const std::string& sampler) {
  ParameterSet set;
  const auto add = [&](const char* name, ParameterType type, double value) {
    if (!has_parameter("sampler", sampler, name)) return;
    Parameter p;
    p.type = type;
    p.name = name;
    if (type == ParameterType::Integer) {
      p.ints = {static_cast<int>(value)};
    } else {
      p.floats = {static_cast<float>(value)};
    }
    set.push_back(p);
  };
  add("bootstrapsamples", ParameterType::Integer, t.bootstrap);
  add("chains", ParameterType::Integer, t.chains);
  add("largestepprobability", ParameterType::Float, t.large);
  if (t.sigma > 0.0) add("sigma", ParameterType::Float, t.sigma);
  if (t.keep_b && has_parameter("sampler", sampler, "b")) {
    Parameter p;
    p.type = ParameterType::String;
    p.name = "b";
    p.strings = {"bootstrap"};
    set.push_back(p);
  }
  return set;
}

using Means = std::vector<std::array<double, blocks>>;

// b' a^-1 b for a covariance a, in the directions in which it is not singular, and their number. In
// the others (the whole, where a target is the same everywhere) b must vanish; else inconsistent.
struct Form {
  double value = 0.0;
  int rank = 0;
  bool consistent = true;
};
Form inverse_form(std::array<std::array<double, blocks>, blocks> a,
                  const std::array<double, blocks>& b) {
  constexpr double singular = 1e-7, vanishing = 1e-5;
  std::array<double, blocks> y{};  // by the Cholesky factor, row by row
  Form form;
  for (size_t i = 0; i < blocks; ++i) {
    const double whole = a[i][i];
    double rest = b[i];
    bool used = true;
    for (size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      if (i != j) {
        a[i][j] = a[j][j] > 0.0 ? sum / a[j][j] : 0.0;
        rest -= a[i][j] * y[j];
        continue;
      }
      used = sum > singular * whole && sum > 0.0;
      a[i][i] = used ? std::sqrt(sum) : 0.0;
    }
    if (!used) {
      form.consistent = form.consistent && std::abs(rest) < vanishing;
      continue;
    }
    y[i] = rest / a[i][i];
    form.value += y[i] * y[i];
    ++form.rank;
  }
  return form;
}

struct Statistics {
  std::array<double, blocks> mean{};
  std::array<std::array<double, blocks>, blocks> covariance{};
};

Statistics statistics(const Means& means) {
  Statistics s;
  const auto n = static_cast<double>(means.size());
  for (const auto& m : means) {
    for (size_t b = 0; b < blocks; ++b) s.mean[b] += m[b] / n;
  }
  for (const auto& m : means) {
    for (size_t i = 0; i < blocks; ++i) {
      for (size_t j = 0; j < blocks; ++j) {
        s.covariance[i][j] += (m[i] - s.mean[i]) * (m[j] - s.mean[j]) / (n - 1.0);
      }
    }
  }
  return s;
}

// Hotelling's T^2 of the blocks against the truth: blocks of one render are not independent (all
// are scaled by b), which the chi-square of their z-scores would have to assume.
double p_value(const Statistics& s, const std::array<double, blocks>& expected, double n) {
  std::array<double, blocks> apart{};
  double largest = 0.0;
  for (size_t b = 0; b < blocks; ++b) {
    apart[b] = s.mean[b] - expected[b];
    largest = std::max(largest, std::abs(apart[b]) / expected[b]);
  }
  if (largest < rounding) return 1.0;
  const Form form = inverse_form(s.covariance, apart);
  if (!form.consistent) return 0.0;
  if (form.rank == 0) return 1.0;  // the same in all renders, and right
  const double p = form.rank, f = n * form.value * (n - p) / (p * (n - 1.0));
  return boost::math::cdf(
      boost::math::complement(boost::math::fisher_f_distribution<double>(p, n - p), f));
}

std::array<double, blocks> block_means(ToyRender& render) {
  std::array<double, blocks> means{};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      means[static_cast<size_t>(x / 2)] += render.pixel(y * width + x) / (2.0 * height);
    }
  }
  return means;
}

// One render of the target: its block means and what the sampler reports.
std::array<double, blocks> render_seed(const std::string& sampler, const ChainTarget& t,
                                       const RasterMap& map, int seed, nlohmann::json& report) {
  const auto function = [&t](PrimarySample& u, Splats& out) {
    const double x = u.raster().x;
    auto numbers = u.numbers(Stream::camera, 1);
    const float a = numbers.next();
    const float b = numbers.next();
    const float value = radiance(t, x, a, b);
    if (value > 0.f) out.camera(Rgb(value), {});
  };
  ToyRender render(sampler, parameters(t, sampler), function, map, static_cast<uint64_t>(seed));
  // Without a bootstrap its samples are made here.
  const double least = render.sampler().mutations(1) > 0.0 ? 0.0 : t.bootstrap;
  for (double made = 0.0; made < std::max(t.mutations * width * height, least);) {
    made += render.sampler().samples(render.rounds());
    render.rounds(1);
  }
  report = nlohmann::json::object();
  render.sampler().report(report);
  return block_means(render);
}

// Block means of all seeds, which share the threads; what the last one reports, and the longest
// stuck run of all, go to `o`.
Means render_seeds(const ProbeContext& context, const ChainTarget& t, Outcome& o) {
  const RasterMap map = box_map(width, height);
  const auto count = static_cast<size_t>(t.seeds);
  Means means(count);
  std::vector<nlohmann::json> reports(count);
  tbb::task_arena arena(context.threads > 0 ? context.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(size_t{0}, count, [&](size_t i) {
      means[i] = render_seed(context.pair.sampler, t, map, static_cast<int>(i) + 1, reports[i]);
    });
  });
  for (const nlohmann::json& report : reports) {
    if (report.contains("acceptance_rate")) o.acceptance = report["acceptance_rate"].get<double>();
    if (!report.contains("longest_stuck")) continue;
    o.longest_stuck =
        std::max(o.longest_stuck.value_or(0), report["longest_stuck"].get<uint64_t>());
  }
  return means;
}

}  // namespace

Outcome chains_on_target(const ProbeContext& context, const ChainTarget& t) {
  const LogCapture capture;
  Outcome o;
  const Statistics s = statistics(render_seeds(context, t, o));
  const std::array<double, blocks> expected = truth(t);
  const auto n = static_cast<double>(t.seeds);
  const double p = p_value(s, expected, n);
  o.deviation = o.tolerance = 0.0;
  for (size_t b = 0; b < blocks; ++b) {
    const double apart = std::abs(s.mean[b] / expected[b] - 1.0);
    if (apart < *o.deviation) continue;
    o.deviation = apart;
    o.tolerance =
        student_limit(least_p / blocks, n - 1.0) * std::sqrt(s.covariance[b][b] / n) / expected[b] +
        1e-5;
  }
  o.meaning = fmt::format("T^2 of {} blocks over {} seeds: p = {:.3g}, least {:.0e}", blocks,
                          t.seeds, p, least_p);
  o.verdict = p >= least_p ? Verdict::pass : Verdict::fail;
  if (o.verdict == Verdict::fail) o.reason = o.meaning;
  return o;
}

// Chains begin at candidates drawn in proportion to the target: a ratio of two means of N samples,
// whose bias is at most about the target's relative variance over N (Cochran 1977, Sampling
// Techniques, section 6.8); the chains forget it as they go.
Outcome bias_of_refined_b(const ProbeContext& context) {
  constexpr double relative_variance = .22;  // of the smooth target
  const LogCapture capture;
  Outcome o;
  if (!has_parameter("sampler", context.pair.sampler, "b")) {
    o.verdict = Verdict::cannot_see;
    o.reason = context.pair.sampler + " has no b";
    return o;
  }
  o.verdict = Verdict::pass;
  o.deviation = 0.0;
  for (const int count : {64, 256, 1024}) {
    const ChainTarget t{.kind = ChainTarget::smooth,
                        .seeds = 400,
                        .bootstrap = count,
                        .mutations = 16,
                        .keep_b = false};
    const Statistics s = statistics(render_seeds(context, t, o));
    const std::array<double, blocks> expected = truth(t);
    double worst = 0.0, tolerance = 0.0;
    for (size_t b = 0; b < blocks; ++b) {
      const double apart = std::abs(s.mean[b] / expected[b] - 1.0);
      const double error = std::sqrt(s.covariance[b][b] / t.seeds) / expected[b];
      if (apart < worst) continue;
      worst = apart;
      tolerance =
          2.0 * relative_variance / count + student_limit(least_p / blocks, t.seeds - 1) * error;
    }
    o.reason += fmt::format("{}N = {}: {:.2g} of {:.2g} allowed", o.reason.empty() ? "" : ", ",
                            count, worst, tolerance);
    o.deviation = worst;
    o.tolerance = tolerance;
    if (worst > tolerance) o.verdict = Verdict::fail;
  }
  o.meaning = "twice the target's relative variance over N, and a t-test's limit at 1e-4";
  return o;
}

}  // namespace pssmlt::stress
