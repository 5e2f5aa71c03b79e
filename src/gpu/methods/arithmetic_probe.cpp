#include "gpu/methods/arithmetic_probe.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "core/random.h"
#include "gpu/methods/frame_arguments.h"

namespace clusterbench::gpu {
namespace {

constexpr std::uint32_t k_probe_group = 64;

struct Triple {
  float a, b, c, unused = 0.0f;
};

float random_float(SplitMix64& random, int least_exponent, int most_exponent) {
  const double mantissa = 1.0 + static_cast<double>(random.below(1u << 23)) * 0x1p-23;
  const int exponent =
      least_exponent + static_cast<int>(random.below(static_cast<std::uint64_t>(most_exponent - least_exponent) + 1));
  return static_cast<float>((random.below(2) == 0 ? 1.0 : -1.0) * std::ldexp(mantissa, exponent));
}

// Of all kinds. c takes the rounded product away, so that what is left tells whether it was rounded.
std::vector<Triple> triples() {
  SplitMix64 random(38);
  std::vector<Triple> all;
  for (int i = 0; i < 2000; ++i) {
    const float a = random_float(random, -12, 12), b = random_float(random, -12, 12);
    all.push_back({a, b, -(a * b)});
    all.push_back({a, -a, random_float(random, -30, -20)});
    all.push_back({a, b, random_float(random, -12, 12)});
  }
  return all;
}

// Their sums and products are below the least normal number.
std::vector<Triple> tiny_triples() {
  return {{0x1p-140f, 0x1p-141f, 0.0f}, {0x1p-80f, 0x1p-60f, 0.0f}, {0x1.8p-126f, -0x1p-126f, 0.0f}};
}

std::vector<std::uint32_t> run(Device& device, const char* shader, std::uint32_t mode,
                               const std::vector<Triple>& inputs, std::uint32_t words_each) {
  const Kernel kernel = device.kernel(shader, k_probe_group, mode);
  Buffers buffers(device);
  const std::uint64_t bytes = inputs.size() * sizeof(Triple), words = inputs.size() * words_each;
  buffers.reserve(Binding::balls, bytes, "numbers of the probe");
  buffers.reserve(Binding::lists, words * sizeof(std::uint32_t), "results of the probe");
  FrameArguments arguments;
  arguments.cells = static_cast<std::uint32_t>(inputs.size());
  Commands commands(device, buffers);
  commands.upload(Binding::balls, inputs.data(), bytes);
  commands.barrier();
  commands.dispatch(kernel, arguments, (inputs.size() + k_probe_group - 1) / k_probe_group);
  commands.download(Binding::lists, words * sizeof(std::uint32_t));
  commands.run();
  const auto found = commands.downloaded(0);
  return {found.begin(), found.end()};
}

// Rounded to nearest, or to the next number on the other side of the exact one. The exact one fits a double.
Rounding rounding_of(float found, double exact) {
  const float nearest = static_cast<float>(exact);
  if (found == nearest) return Rounding::to_nearest;
  const double rest = exact - static_cast<double>(nearest);
  const float other = std::nextafter(nearest, rest > 0.0 ? INFINITY : -INFINITY);
  return rest != 0.0 && found == other ? Rounding::either_way : Rounding::wrong;
}

void take_worse(Rounding& of, Rounding found) {
  of = std::max(of, found);
}

// c is minus the nearest product, so that a sum of a rounded product and c is exact. Was there one?
bool is_product_rounded(float found, const Triple& of) {
  const double product = static_cast<double>(found) - static_cast<double>(of.c);
  const auto rounded = static_cast<float>(product);
  return static_cast<double>(rounded) == product &&
         rounding_of(rounded, static_cast<double>(of.a) * static_cast<double>(of.b)) != Rounding::wrong;
}

void judge_sums(const Triple& of, std::span<const std::uint32_t> words, Arithmetic& out) {
  const auto result = [&](std::size_t i) { return std::bit_cast<float>(words[i]); };
  const double a = static_cast<double>(of.a), b = static_cast<double>(of.b), c = static_cast<double>(of.c);
  take_worse(out.rounding, rounding_of(result(0), a + b));
  take_worse(out.rounding, rounding_of(result(1), a * b));
  if (of.c == -static_cast<float>(a * b) && a * b + c != 0.0) out.contracts |= !is_product_rounded(result(2), of);
  if (of.b == -of.a) out.reorders |= result(3) != of.c;
}

double ulp_of(double exact) {
  return std::ldexp(1.0, std::ilogb(exact) - 23);
}

void judge_functions(const Triple& of, std::span<const std::uint32_t> words, Arithmetic& out) {
  const auto off = [&](std::size_t i, double exact) {
    const double found = static_cast<double>(std::bit_cast<float>(words[i]));
    return std::isfinite(found) ? std::abs(found - exact) : INFINITY;
  };
  const double a = static_cast<double>(of.a), b = static_cast<double>(of.b), log = std::log2(a);
  out.division_ulp = std::max(out.division_ulp, off(0, a / b) / ulp_of(a / b));
  out.sqrt_ulp = std::max(out.sqrt_ulp, off(1, std::sqrt(a)) / ulp_of(std::sqrt(a)));
  if (a >= 0.5 && a <= 2.0)
    out.log2_error = std::max(out.log2_error, off(2, log));
  else
    out.log2_ulp = std::max(out.log2_ulp, off(2, log) / ulp_of(log));
}

// Of words of tiny_triples(): a sum, a product, and a sum.
bool flushes(std::span<const std::uint32_t> words) {
  return words[0] << 1 == 0 || words[4 + 1] << 1 == 0 || words[8] << 1 == 0;
}

}  // namespace

Arithmetic probed_arithmetic(Device& device, ProbeMode mode) {
  Arithmetic out;
  const std::vector<Triple> numbers = triples();
  const auto sums = run(device, "probe_sums", static_cast<std::uint32_t>(mode), numbers, 4);
  for (std::size_t i = 0; i < numbers.size(); ++i) judge_sums(numbers[i], std::span(sums).subspan(4 * i, 4), out);
  out.flushes_denormals = flushes(run(device, "probe_sums", static_cast<std::uint32_t>(mode), tiny_triples(), 4));
  std::vector<Triple> positive = numbers;
  for (Triple& triple : positive) triple.a = std::abs(triple.a);
  const auto functions = run(device, "probe_functions", 0, positive, 3);
  for (std::size_t i = 0; i < positive.size(); ++i)
    judge_functions(positive[i], std::span(functions).subspan(3 * i, 3), out);
  return out;
}

Arithmetic arithmetic_of_device() {
  static std::mutex busy;
  static std::map<std::string, Arithmetic> known;  // by device and driver
  Device& now = device();
  const std::string key = now.facts().uuid + now.facts().driver;
  const std::lock_guard lock(busy);
  const auto found = known.find(key);
  return found != known.end() ? found->second : known[key] = probed_arithmetic(now);
}

std::string contradiction(const Arithmetic& found, const DeviceFacts& facts) {
  const auto sentence = [&](const std::string& fault) {
    return facts.name + " " + fault +
           ", so that the lists of its methods could lose lights (a probe of its arithmetic)";
  };
  if (found.rounding == Rounding::wrong) return sentence("is off by more than the next number in sums or products");
  if (found.rounding == Rounding::either_way && facts.rounds_to_nearest)
    return sentence("was asked to round to nearest and does not");
  if (found.contracts) return sentence("rounds a product and a sum in one step, which shaders forbid");
  if (found.reorders) return sentence("changes the order of sums, which shaders forbid");
  return "";
}

}  // namespace clusterbench::gpu
