#include "run/timing/paired_rounds.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/error.h"

namespace clusterbench::run {
namespace {

// The cases of one method: the first one is measured for all.
using MethodCases = std::vector<std::string>;
using GroupMethods = std::vector<MethodCases>;

std::vector<GroupMethods> methods_in_common(const Plan& plan, const std::set<std::string>& ids) {
  std::vector<GroupMethods> groups;
  for (const GroupPlan& group : plan.groups) {
    GroupMethods methods;
    for (const Method& method : methods_of(group)) {
      MethodCases cases;
      for (const CasePlan& case_plan : group.cases)
        if (case_plan.method() == method && ids.contains(case_plan.id)) cases.push_back(case_plan.id);
      if (!cases.empty()) methods.push_back(cases);
    }
    if (!methods.empty()) groups.push_back(methods);
  }
  return groups;
}

std::set<std::string> ids_in_common(Program& base, Program& next) {
  const std::vector<std::string> of_base = base.case_ids(), of_next = next.case_ids();
  const std::set<std::string> known(of_base.begin(), of_base.end());
  std::set<std::string> ids;
  for (const std::string& id : of_next)
    if (known.contains(id)) ids.insert(id);
  if (ids.empty())
    throw Error("", "--baseline-binary", "has no case in common with this program", ExitCode::nothing_comparable);
  return ids;
}

struct Lone {
  std::uint32_t light;
  bool is_in_next;
};

// The smallest light that only one of two ascending lists has.
std::optional<Lone> first_lone(const std::vector<std::uint32_t>& base, const std::vector<std::uint32_t>& next) {
  const auto [a, b] = std::mismatch(base.begin(), base.end(), next.begin(), next.end());
  if (a == base.end() && b == next.end()) return std::nullopt;
  if (a == base.end()) return Lone{*b, true};
  if (b == next.end()) return Lone{*a, false};
  return *a < *b ? Lone{*a, false} : Lone{*b, true};
}

void locate(ListsDiffer& out, const FrameLists& base, const FrameLists& next) {
  const int nx = std::max(1, next.cells.x), ny = std::max(1, next.cells.y);
  for (std::size_t i = 0; i < std::max(base.lights.size(), next.lights.size()); ++i) {
    const std::vector<std::uint32_t> none;
    const std::optional<Lone> lone =
        first_lone(i < base.lights.size() ? base.lights[i] : none, i < next.lights.size() ? next.lights[i] : none);
    if (!lone) continue;
    const int cell = static_cast<int>(i);
    out.cell = {cell % nx, cell / nx % ny, cell / nx / ny};
    out.light = lone->light;
    out.is_only_in_new = lone->is_in_next;
    return;
  }
}

std::optional<ListsDiffer> lists_differ(Program& base, Program& next, const std::string& id) {
  const std::vector<ListDigest> of_base = base.list_digests(id), of_next = next.list_digests(id);
  if (of_base.size() != of_next.size())
    throw Error("", id,
                "has " + std::to_string(of_base.size()) + " frames in one program and " +
                    std::to_string(of_next.size()) + " in the other");
  ListsDiffer out;
  for (std::size_t frame = 0; frame < of_base.size(); ++frame) {
    out.base_pairs += of_base[frame].pairs;
    out.next_pairs += of_next[frame].pairs;
    if (of_base[frame] == of_next[frame]) continue;
    if (out.frames++ == 0) out.frame = static_cast<int>(frame);
  }
  if (out.frames == 0) return std::nullopt;
  locate(out, base.frame_lists(id, out.frame), next.frame_lists(id, out.frame));
  return out;
}

class PairedRun {
 public:
  PairedRun(const Plan& plan, const PairedRequest& request, const PairedStart& start, const OnPairedRound& on_round)
      : plan_(plan), request_(request), start_(start), on_round_(on_round) {}

  std::map<std::string, PairedCase> result() {
    start_both(false);
    compare_lists();
    for (const GroupMethods& methods : groups_) measure_group(methods, 0);
    for (int launch = 1; launch < std::max(request_.launches, request_.most_launches); ++launch) {
      const std::vector<GroupMethods> open = launch < request_.launches ? groups_ : open_methods();
      if (open.empty()) break;
      start_both(launch % 2 == 1);
      for (const GroupMethods& methods : open) measure_group(methods, launch);
    }
    for (const GroupMethods& methods : groups_)
      for (const MethodCases& ids : methods)
        for (const std::string& id : ids) cases_[id] = cases_[ids.front()];
    return cases_;
  }

 private:
  void start_both(bool is_new_first) {
    base_.reset();
    next_.reset();
    if (is_new_first) next_ = start_.next();
    base_ = start_.base();
    if (!is_new_first) next_ = start_.next();
  }

  void compare_lists() {
    groups_ = methods_in_common(plan_, ids_in_common(*base_, *next_));
    for (const GroupMethods& methods : groups_)
      for (const MethodCases& ids : methods)
        cases_[ids.front()].lists_differ = lists_differ(*base_, *next_, ids.front());
  }

  // The methods whose intervals are still too wide, in their groups.
  std::vector<GroupMethods> open_methods() const {
    std::vector<GroupMethods> open;
    for (const GroupMethods& methods : groups_) {
      GroupMethods wide;
      for (const MethodCases& ids : methods)
        if (measure::half_width(cases_.at(ids.front()).change()) > request_.enough) wide.push_back(ids);
      if (!wide.empty()) open.push_back(wide);
    }
    return open;
  }

  void measure_group(const GroupMethods& methods, int launch) {
    const double certain = static_cast<double>(groups_.size()) * request_.launches * request_.rounds;
    const double share = launch < request_.launches ? 1.0 / certain : 0.0;
    for (const MethodCases& ids : methods) cases_[ids.front()].launches.emplace_back();
    for (int round = 0; round < request_.rounds; ++round) {
      on_round_({launch, share});
      for (std::size_t i = 0; i < methods.size(); ++i)
        measure_round(methods[i].front(), (static_cast<std::size_t>(launch + round) + i) % 2 == 1);
    }
  }

  void measure_round(const std::string& id, bool is_new_first) {
    PairedLaunch& out = cases_[id].launches.back();
    if (is_new_first) out.next_ns.push_back(next_->assign_ns(id));
    out.base_ns.push_back(base_->assign_ns(id));
    if (!is_new_first) out.next_ns.push_back(next_->assign_ns(id));
  }

  const Plan& plan_;
  const PairedRequest& request_;
  const PairedStart& start_;
  const OnPairedRound& on_round_;
  std::unique_ptr<Program> base_, next_;
  std::vector<GroupMethods> groups_;
  std::map<std::string, PairedCase> cases_;  // by each method's first case, until the end
};

}  // namespace

measure::Change PairedCase::change() const {
  std::vector<double> log_ratios;
  for (const PairedLaunch& launch : launches)
    log_ratios.push_back(measure::launch_log_ratio(launch.base_ns, launch.next_ns));
  return measure::change_over_launches(log_ratios);
}

std::map<std::string, PairedCase> measure_paired(const Plan& plan, const PairedRequest& request,
                                                 const PairedStart& start, const OnPairedRound& on_round) {
  return PairedRun(plan, request, start, on_round).result();
}

}  // namespace clusterbench::run
