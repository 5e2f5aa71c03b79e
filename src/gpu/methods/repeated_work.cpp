#include "gpu/methods/repeated_work.h"

namespace clusterbench::gpu {

using Caches = assign::DeviceRepeats::Caches;

void RepeatedWork::record(const Steps& upload, const Steps& run) {
  if (repeats_.caches == Caches::warm) return record_warm(upload, run);
  record_cold(upload, run, repeats_.caches == Caches::cold ? repeats_.run : 1);
}

void RepeatedWork::record_cold(const Steps& upload, const Steps& run, std::uint32_t repeats) {
  for (std::uint32_t i = 0; i < repeats; ++i) {
    if (repeats_.caches == Caches::cold) commands_.flush();
    const std::uint32_t first = commands_.mark();
    upload();
    const std::uint32_t between = commands_.mark();
    run_once(run);
    const std::uint32_t last = commands_.mark();
    uploads_.push_back({first, between});
    runs_.push_back({between, last});
  }
}

void RepeatedWork::record_warm(const Steps& upload, const Steps& run) {
  upload();
  const std::uint32_t first = commands_.mark();
  for (std::uint32_t i = 0; i < repeats_.upload; ++i) upload();
  uploads_.push_back({first, commands_.mark()});
  run_once(run);
  commands_.barrier();
  const std::uint32_t second = commands_.mark();
  for (std::uint32_t i = 0; i < repeats_.run; ++i) {
    if (i > 0) commands_.barrier();
    run_once(run);
  }
  runs_.push_back({second, commands_.mark()});
}

void RepeatedWork::run_once(const Steps& run) {
  const std::uint32_t before = commands_.steps();
  run();
  steps_ = commands_.steps() - before;
}

double RepeatedWork::mean_ns(const std::vector<Span>& spans, std::uint32_t repeats) const {
  double sum = 0.0;
  for (const Span& span : spans) sum += commands_.ns_between(span.first, span.last);
  return sum / static_cast<double>(spans.size()) / repeats;
}

assign::DeviceSpans RepeatedWork::spans() const {
  const bool is_warm = repeats_.caches == Caches::warm;
  const std::uint32_t end = runs_.back().last;
  return {.upload_ns = mean_ns(uploads_, is_warm ? repeats_.upload : 1),
          .run_ns = mean_ns(runs_, is_warm ? repeats_.run : 1),
          .readback_ns = commands_.ns_between(end, end + 1),  // run() makes the last mark
          .dispatches = steps_};
}

}  // namespace clusterbench::gpu
