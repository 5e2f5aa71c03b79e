#include "report/cases/timing_warnings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "core/text.h"
#include "measure/statistics/time_statistics.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Disturbed;
using result::Interval;
using result::number;
using result::Result;
using result::Time;
using result::Timing;

constexpr double k_wide = 0.1;           // half-width of an interval / its time
constexpr double k_others_cores = 0.1;   // used by other programs
constexpr double k_clock_spread = 0.05;  // of a device
constexpr double k_stolen_cores = 0.02;  // lower, since a guest sees only a part of its host's load

// Of a device's clock: between its slowest and its fastest round / median; 0 where it is not told.
double clock_spread(const Case& result_case) {
  const auto* clock = result::part<&Case::device, &result::DeviceTimes::clock_mhz>(result_case);
  return clock == nullptr ? 0.0 : (clock->max - clock->min) / clock->median;
}

// 0 without timing.
double frame_ns(const Case& result_case) {
  return number<&Case::timing, &Timing::frame_ns, &Time::median>(result_case).value_or(0.0);
}

// The cases with one kind of problem: their number, and the worst.
class Doubt {
 public:
  void add(const Case& result_case, double badness) {
    ++count_;
    if (worst_ != nullptr && badness <= badness_) return;
    worst_ = &result_case;
    badness_ = badness;
  }
  bool is_any() const { return count_ > 0; }
  double badness() const { return badness_; }
  const Case& worst() const { return *worst_; }
  std::string name() const { return shown(worst_->name); }
  std::string count() const { return std::to_string(count_); }

 private:
  std::size_t count_ = 0;
  const Case* worst_ = nullptr;
  double badness_ = 0.0;
};

bool is_known(const Interval& interval) {
  return std::isfinite(interval[0]) && std::isfinite(interval[1]);
}

std::optional<measure::TwoModes> modes_of(const Case& result_case) {
  return measure::two_modes(frame_rounds(result_case));
}

std::string more_launches(std::uint64_t launches) {
  return "--launches " + std::to_string(4 * launches);
}

std::uint64_t launches_of(const Case& result_case) {
  return result_case.timing->launches.value_or(1);
}

// Why there are fewer samples than rounds: " (...)", or "" if there are not.
std::string few_cold_rounds(const Case& result_case) {
  const auto* warm = result::part<&Case::timing, &Timing::warm>(result_case);
  if (warm == nullptr) return "";
  const std::size_t cold = result_case.timing->frame_ns.samples.size(), rounds = warm->frame_ns.samples.size();
  return cold < rounds ? " (" + std::to_string(cold) + " of " + number_of(rounds, "round") +
                             " had cold caches, since sweeping them takes long)"
                       : "";
}

// Of times of the processor, or of those `where`, the ones whose 95 % interval is unknown or wide.
class IntervalDoubts {
 public:
  explicit IntervalDoubts(const char* where = "") : where_(where) {}

  void add(const Case& result_case, const Time& time, std::uint64_t launches) {
    ++timed_;
    const Interval& ci95 = time.ci95;
    if (!is_known(ci95)) return unknown_.add(result_case, 0.0);
    const double badness = 0.5 * (ci95[1] - ci95[0]) / time.median;
    if (!(badness > k_wide)) return;
    wide_.add(result_case, badness);
    if (&wide_.worst() != &result_case) return;
    widest_ = interval_text(time);
    launches_ = launches;
  }

  // `remedy`: what else than launches helps against wide intervals.
  void add_warnings(std::vector<std::string>& out, const std::string& remedy) const {
    if (unknown_.is_any())
      out.push_back(cases(unknown_) + " without an interval: " + what_intervals_take() +
                    few_cold_rounds(unknown_.worst()) + "; try --launches 5");
    if (wide_.is_any())
      out.push_back(cases(wide_) + " with intervals wider than ±10 %, the widest " +
                    (widest_.starts_with('-') ? "" : "±") + widest_ + ": " + wide_.name() + "; " + remedy +
                    ", or try " + more_launches(launches_));
  }

  std::string cases(const Doubt& of) const { return of.count() + " of " + number_of(timed_, "time") + where_; }

 private:
  const char* where_;
  std::size_t timed_ = 0;
  Doubt unknown_, wide_;
  std::string widest_;
  std::uint64_t launches_ = 1;
};

std::string modes_warning(const Doubt& two, const IntervalDoubts& times) {
  const measure::TwoModes modes = *modes_of(two.worst());
  return times.cases(two) + " in two groups, as at " + text("%.4g", modes.low / 1e3) +
         text(" and %.4g us: ", modes.high / 1e3) + two.name() +
         "; something switches while it is measured (clock speed, another program, where memory lies): try a fixed "
         "clock, or " +
         more_launches(launches_of(two.worst()));
}

void add_machine_warnings(std::vector<std::string>& out, const Doubt& others, const Doubt& stolen, const Doubt& hot,
                          const std::string& without_times) {
  if (others.is_any())
    out.push_back("other programs kept up to " + text("%.1f", others.badness()) +
                  " processors busy while times were measured; stop them, or " + without_times);
  if (stolen.is_any())
    out.push_back("other guests of this machine's host took up to " + text("%.2f", stolen.badness()) +
                  " processors while times were measured; measure at another time, or " + without_times);
  if (hot.is_any())
    out.push_back("processors slowed down because of heat " + text("%.0f", hot.badness()) +
                  " times while times were measured; let the machine cool, or fix a lower clock");
}

std::string clock_warning(const Doubt& moving) {
  const result::DeviceClock& clock = *moving.worst().device->clock_mhz;
  return "the device ran at " + text("%.0f", clock.min) + text(" to %.0f MHz while ", clock.max) + moving.name() +
         " was measured; fix its clock, or let it cool (docs/gpu.md)";
}

std::vector<std::string> device_doubts(const Result& result) {
  std::vector<std::string> out;
  IntervalDoubts times(" on the device");
  Doubt moving;
  std::set<std::string> software;
  for (const Case& result_case : result.cases) {
    if (!result_case.device) continue;
    const result::DeviceTimes& device = *result_case.device;
    if (is_on_software_device(result, result_case)) {
      software.insert(shown(result.device ? result.device->name : device.device));
      continue;
    }
    if (device.run_ns.median > 0.0) times.add(result_case, device.run_ns, device.launches.value_or(1));
    if (const double spread = clock_spread(result_case); spread > k_clock_spread) moving.add(result_case, spread);
  }
  if (!software.empty())
    out.push_back("times on " + joined(std::vector<std::string>(software.begin(), software.end())) +
                  " are a processor's and no GPU's: they rank nothing, and budgets of them say nothing of a GPU");
  times.add_warnings(out, "leave the device to this run");
  if (moving.is_any()) out.push_back(clock_warning(moving));
  return out;
}

}  // namespace

std::vector<std::string> timing_doubts(const std::vector<Case>& cases, const std::string& without_times) {
  IntervalDoubts times;
  Doubt two, others, stolen, hot;
  for (const Case& result_case : cases) {
    const auto check = [&](Doubt& doubt, double badness, double most) {
      if (badness > most) doubt.add(result_case, badness);
    };
    if (frame_ns(result_case) <= 0.0) continue;
    times.add(result_case, result_case.timing->frame_ns, launches_of(result_case));
    if (const auto modes = modes_of(result_case)) two.add(result_case, modes->high / modes->low);
    const Disturbed disturbed = result_case.timing->disturbed.value_or(Disturbed());
    check(others, disturbed.others_cores, k_others_cores);
    check(stolen, disturbed.stolen_cores, k_stolen_cores);
    check(hot, static_cast<double>(disturbed.throttled), 0.0);
  }
  std::vector<std::string> out;
  times.add_warnings(out, "stop other programs");
  if (two.is_any()) out.push_back(modes_warning(two, times));
  add_machine_warnings(out, others, stolen, hot, without_times);
  return out;
}

std::vector<std::string> timing_doubts(const Result& result) {
  std::vector<std::string> out = timing_doubts(result.cases);
  std::ranges::move(device_doubts(result), std::back_inserter(out));
  return out;
}

std::string timing_warnings(const Result& result) {
  std::string out;
  for (const std::string& doubt : timing_doubts(result)) out += "warning: " + doubt + "\n";
  return out;
}

}  // namespace clusterbench::report
