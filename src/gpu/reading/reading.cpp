#include "gpu/reading/reading.h"

#include <algorithm>

namespace clusterbench::gpu {
namespace {

constexpr std::uint32_t k_most_marks = 64;
constexpr std::uint64_t k_reading_group_size = 64;

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2.0;
}

// Records the readings of one task.
class Reader {
 public:
  Reader(const ReadingTask& task, ReadingSamples& samples, bool given)
      : structure_(task.structure),
        kernel_(structure_->kernel(task.output, task.walking, given)),
        arguments_(structure_->arguments(samples)),
        groups_((samples.invocations() + k_reading_group_size - 1) / k_reading_group_size) {}

  void record(Commands& commands) const {
    commands.use(structure_->buffers());
    commands.dispatch(kernel_, arguments_, groups_);
    commands.barrier();
  }

 private:
  ReadingStructure* structure_;
  Kernel kernel_;
  Arguments arguments_;
  std::uint64_t groups_;
};

// A span of a round: one cold reading, or repeated warm ones.
struct PlannedSpan {
  std::size_t task;
  bool is_cold;
};

class Turns {
 public:
  Turns(std::span<const ReadingTask> tasks, ReadingSamples& samples, const ReadingPlan& plan)
      : samples_(samples),
        plan_(plan),
        flushed_(samples.reserve_flushed(device().facts().is_software() ? plan.flushed_bytes_of_software
                                                                        : plan.flushed_bytes)) {
    for (const ReadingTask& task : tasks) {
      task.structure->bind(samples);
      readers_.emplace_back(task, samples, false);
    }
    const DeviceFacts& facts = device().facts();
    times_.resize(tasks.size());
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      times_[task].is_software = facts.is_software();
      times_[task].least_span_ns = least_span_ns(facts.timestamp_period_ns);
      estimated_ns_.push_back(estimate(task));
      times_[task].repeats = repeats_for(estimated_ns_[task], facts.timestamp_period_ns, plan.longest_submit_ns / 2.0);
    }
  }

  void run_round(std::size_t round) {
    std::vector<PlannedSpan> spans;
    double ns = 0.0;
    for (std::size_t i = 0; i < readers_.size(); ++i)
      for (const bool is_cold : {true, false}) {
        const PlannedSpan next{(round + i) % readers_.size(), is_cold};
        const double next_ns = estimate_of(next);
        if (!spans.empty() && (ns + next_ns > plan_.longest_submit_ns || 2 * (spans.size() + 1) > k_most_marks)) {
          submit(spans);
          spans.clear();
          ns = 0.0;
        }
        spans.push_back(next);
        ns += next_ns;
      }
    submit(spans);
  }

  std::vector<ReadingTimes> take_times() { return std::move(times_); }

 private:
  // Of a second reading, the first of which is slow in its own ways.
  double estimate(std::size_t task) {
    Commands commands(device(), samples_.buffers());
    readers_[task].record(commands);
    commands.mark();
    readers_[task].record(commands);
    commands.mark();
    commands.run();
    return commands.ns_between(0, 1);
  }

  double estimate_of(const PlannedSpan& span) const {
    return span.is_cold ? estimated_ns_[span.task] + static_cast<double>(flushed_) / k_flushed_bytes_per_ns
                        : estimated_ns_[span.task] * (times_[span.task].repeats + 1);
  }

  void submit(const std::vector<PlannedSpan>& spans) {
    Commands commands(device(), samples_.buffers());
    for (const PlannedSpan& span : spans) {
      const std::uint32_t repeats = span.is_cold ? 1 : times_[span.task].repeats;
      if (span.is_cold)
        commands.fill(ReadingBinding::flushed, 0, flushed_);
      else
        readers_[span.task].record(commands);
      commands.barrier();
      commands.mark();
      for (std::uint32_t i = 0; i < repeats; ++i) readers_[span.task].record(commands);
      commands.mark();
    }
    commands.run();
    for (std::uint32_t i = 0; i < spans.size(); ++i) {
      ReadingTimes& times = times_[spans[i].task];
      const double ns = commands.ns_between(2 * i, 2 * i + 1);
      if (spans[i].is_cold)
        times.cold_ns.push_back(ns);
      else
        times.warm_ns.push_back(ns / times.repeats);
    }
  }

  ReadingSamples& samples_;
  ReadingPlan plan_;
  std::uint64_t flushed_;
  std::vector<Reader> readers_;
  std::vector<double> estimated_ns_;
  std::vector<ReadingTimes> times_;
};

}  // namespace

double ReadingTimes::warm_median_ns() const {
  return median_of(warm_ns);
}
double ReadingTimes::cold_median_ns() const {
  return median_of(cold_ns);
}

std::string reading_obstacle() {
  if (std::string obstacle = device_obstacle(); !obstacle.empty()) return obstacle;
  const DeviceFacts& facts = device().facts();
  if (facts.timestamp_bits == 0) return facts.name + " has no clock";
  if (!facts.has_subgroup_arithmetic)
    return facts.name + " has no arithmetic over subgroups, which readings of whole waves need";
  return "";
}

std::vector<std::uint32_t> results_of(const ReadingTask& task, ReadingSamples& samples, bool given) {
  task.structure->bind(samples);
  const std::uint64_t words = std::uint64_t{samples.invocations()} * (task.output == ReadingOutput::check ? 2 : 1);
  const Reader reader(task, samples, given);
  Commands commands(device(), samples.buffers());
  commands.fill(ReadingBinding::results, 0xdeadbeefu, words * sizeof(std::uint32_t));
  commands.barrier();
  reader.record(commands);
  commands.download(ReadingBinding::results, words * sizeof(std::uint32_t));
  commands.run();
  const auto found = commands.downloaded(0);
  return {found.begin(), found.end()};
}

std::vector<ReadingTimes> read_in_turns(std::span<const ReadingTask> tasks, ReadingSamples& samples,
                                        const ReadingPlan& plan) {
  if (tasks.empty() || samples.invocations() == 0) return std::vector<ReadingTimes>(tasks.size());
  Turns turns(tasks, samples, plan);
  for (int round = 0; round < plan.rounds && !(plan.stop != nullptr && *plan.stop); ++round)
    turns.run_round(static_cast<std::size_t>(round));
  return turns.take_times();
}

}  // namespace clusterbench::gpu
