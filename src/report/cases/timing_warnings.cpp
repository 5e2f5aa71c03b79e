#include "report/cases/timing_warnings.h"

#include <cmath>
#include <optional>

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
  std::string cases(std::size_t timed) const { return std::to_string(count_) + " of " + number_of(timed, "time"); }

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

std::string more_launches(const Case& result_case) {
  return "--launches " + std::to_string(4 * result_case.timing->launches.value_or(1));
}

std::string unknown_warning(const Doubt& unknown, std::size_t timed) {
  return unknown.cases(timed) + " without an interval: " + what_intervals_take() + "; try --launches 5";
}

std::string wide_warning(const Doubt& wide, std::size_t timed) {
  std::string interval = frame_interval_text(wide.worst());
  if (!interval.starts_with('-')) interval.insert(0, "±");
  return wide.cases(timed) + " with intervals wider than ±10 %, the widest " + interval + ": " + wide.name() +
         "; stop other programs, or try " + more_launches(wide.worst());
}

std::string modes_warning(const Doubt& two, std::size_t timed) {
  const measure::TwoModes modes = *modes_of(two.worst());
  return two.cases(timed) + " in two groups, as at " + text("%.4g", modes.low / 1e3) +
         text(" and %.4g us: ", modes.high / 1e3) + two.name() +
         "; something switches while it is measured (clock speed, another program, where memory lies): try a fixed "
         "clock, or " +
         more_launches(two.worst());
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

}  // namespace

std::vector<std::string> timing_doubts(const std::vector<Case>& cases, const std::string& without_times) {
  Doubt unknown, wide, two, others, stolen, hot, moving;
  std::size_t timed = 0;
  for (const Case& result_case : cases) {
    const auto check = [&](Doubt& doubt, double badness, double most) {
      if (badness > most) doubt.add(result_case, badness);
    };
    check(moving, clock_spread(result_case), k_clock_spread);
    const double ns = frame_ns(result_case);
    if (ns <= 0.0) continue;
    ++timed;
    const Interval& ci95 = result_case.timing->frame_ns.ci95;
    if (is_known(ci95))
      check(wide, 0.5 * (ci95[1] - ci95[0]) / ns, k_wide);
    else
      unknown.add(result_case, 0.0);
    if (const auto modes = modes_of(result_case)) two.add(result_case, modes->high / modes->low);
    const Disturbed disturbed = result_case.timing->disturbed.value_or(Disturbed());
    check(others, disturbed.others_cores, k_others_cores);
    check(stolen, disturbed.stolen_cores, k_stolen_cores);
    check(hot, static_cast<double>(disturbed.throttled), 0.0);
  }
  std::vector<std::string> out;
  if (unknown.is_any()) out.push_back(unknown_warning(unknown, timed));
  if (wide.is_any()) out.push_back(wide_warning(wide, timed));
  if (two.is_any()) out.push_back(modes_warning(two, timed));
  if (moving.is_any()) out.push_back(clock_warning(moving));
  add_machine_warnings(out, others, stolen, hot, without_times);
  return out;
}

std::string timing_warnings(const std::vector<Case>& cases) {
  std::string out;
  for (const std::string& doubt : timing_doubts(cases)) out += "warning: " + doubt + "\n";
  return out;
}

}  // namespace clusterbench::report
