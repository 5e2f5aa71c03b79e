#include "report/timing_warnings.h"

#include <optional>

#include "core/text.h"
#include "measure/time_statistics.h"
#include "report/columns.h"
#include "report/contender.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr double k_wide = 0.1;           // half of an interval, of its time
constexpr double k_others_cores = 0.1;   // busy with other programs
constexpr double k_stolen_cores = 0.02;  // a guest sees little of its host's load

// 0 where it was not measured.
double timing_number(const Json& result_case, const std::string& name) {
  return number_at(result_case, "/timing/" + name).value_or(0.0);
}

// The cases that a doubt is about: how many, and the worst.
class Doubt {
 public:
  void add(const Json& result_case, double badness) {
    ++count_;
    if (worst_ != nullptr && badness <= badness_) return;
    worst_ = &result_case;
    badness_ = badness;
  }
  bool is_any() const { return count_ > 0; }
  double badness() const { return badness_; }
  const Json& worst() const { return *worst_; }
  std::string name() const { return shown((*worst_)["name"]); }
  std::string cases(std::size_t timed) const { return std::to_string(count_) + " of " + number_of(timed, "time"); }

 private:
  std::size_t count_ = 0;
  const Json* worst_ = nullptr;
  double badness_ = 0.0;
};

bool has_interval(const Json& result_case) {
  return result_case["timing"]["frame_ns"]["ci95"][0].is_number() &&
         result_case["timing"]["frame_ns"]["ci95"][1].is_number();
}

// Of a time above 0.
double half_of_interval(const Json& result_case) {
  return 0.5 * (timing_number(result_case, "frame_ns/ci95/1") - timing_number(result_case, "frame_ns/ci95/0")) /
         timing_number(result_case, "frame_ns/median");
}

std::optional<measure::TwoModes> modes_of(const Json& result_case) {
  return measure::two_modes(frame_rounds(result_case));
}

std::string more_launches(const Json& result_case) {
  return "--launches " + std::to_string(4 * result_case["timing"].value("launches", 1));
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

}  // namespace

std::vector<std::string> timing_doubts(const Json& cases, const std::string& without_times) {
  Doubt unknown, wide, two, others, stolen, hot;
  std::size_t timed = 0;
  for (const Json& result_case : cases) {
    if (timing_number(result_case, "frame_ns/median") <= 0.0) continue;
    ++timed;
    const auto check = [&](Doubt& doubt, double badness, double most) {
      if (badness > most) doubt.add(result_case, badness);
    };
    if (has_interval(result_case))
      check(wide, half_of_interval(result_case), k_wide);
    else
      unknown.add(result_case, 0.0);
    if (const auto modes = modes_of(result_case)) two.add(result_case, modes->high / modes->low);
    check(others, timing_number(result_case, "disturbed/others_cores"), k_others_cores);
    check(stolen, timing_number(result_case, "disturbed/stolen_cores"), k_stolen_cores);
    check(hot, timing_number(result_case, "disturbed/throttled"), 0.0);
  }
  std::vector<std::string> out;
  if (unknown.is_any()) out.push_back(unknown_warning(unknown, timed));
  if (wide.is_any()) out.push_back(wide_warning(wide, timed));
  if (two.is_any()) out.push_back(modes_warning(two, timed));
  add_machine_warnings(out, others, stolen, hot, without_times);
  return out;
}

std::string timing_warnings(const Json& cases) {
  std::string out;
  for (const std::string& doubt : timing_doubts(cases)) out += "warning: " + doubt + "\n";
  return out;
}

}  // namespace clusterbench::report
