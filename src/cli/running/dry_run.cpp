#include "cli/running/dry_run.h"

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <map>
#include <set>
#include <string>

#include "cli/output/duration.h"
#include "cli/output/output.h"
#include "cli/running/run_journal.h"
#include "core/text.h"
#include "run/estimate.h"
#include "run/scene_facts.h"

namespace clusterbench::cli {
namespace {

// Methods on unsupported kinds of grids are many and expected: one line for all. Others get a line per reason.
void print_skipped(const std::vector<run::Skipped>& skipped) {
  struct Line {
    std::string reason, first;
    std::uint64_t others = 0;
  };
  std::vector<Line> lines;
  std::map<std::string, std::size_t> line_of_reason;
  std::uint64_t other_kinds = 0;
  for (const run::Skipped& skipped_case : skipped) {
    if (skipped_case.is_other_kind) {
      ++other_kinds;
      continue;
    }
    const auto [line, is_new] = line_of_reason.try_emplace(skipped_case.reason, lines.size());
    if (is_new)
      lines.push_back({skipped_case.reason, skipped_case.name});
    else
      ++lines[line->second].others;
  }
  for (const Line& line : lines)
    std::cout << "skipped  " << printable(line.first)
              << (line.others > 0 ? " and " + std::to_string(line.others) + " more" : "") << ": "
              << printable(line.reason) << "\n";
  if (other_kinds > 0)
    std::cout << "skipped  " << number_of(other_kinds, "combination")
              << " of a method with a kind of grid that it does not take (`clusterbench list` tells which it takes)\n";
}

// The plan without the cases that an interrupted run has finished.
run::Plan plan_left(run::Plan plan, const std::vector<std::string>& done) {
  const std::set<std::string> finished(done.begin(), done.end());
  for (run::GroupPlan& group : plan.groups)
    std::erase_if(group.cases, [&](const run::CasePlan& one) { return finished.contains(one.id); });
  std::erase_if(plan.groups, [](const run::GroupPlan& group) { return group.cases.empty(); });
  return plan;
}

}  // namespace

void print_plan(const RunFlags& flags, const config::Config& config, run::Plan plan) {
  const std::vector<std::string> done = finished_ids(flags, config, plan);
  const std::size_t total = plan.case_count();
  plan = plan_left(std::move(plan), done);
  for (const run::GroupPlan& group : plan.groups)
    for (const run::CasePlan& case_plan : group.cases)
      std::cout << case_plan.id << "  " << printable(case_plan.name) << "\n";
  print_skipped(plan.skipped);
  const std::size_t left = plan.case_count();
  const std::string duration = duration_text(run::estimated_s(config, plan));
  std::cerr << number_of(left, "case")
            << (flags.resume ? " left of " + std::to_string(total) + ", " + std::to_string(total - left) + " done"
                             : std::string())
            << ", " << plan.skipped.size() << " skipped; takes " << duration << "\n";
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    const run::SceneResult scene =
        run::scene_result(plan.scenes[i], config.scenes[i], config.viewports, config.threads);
    for (const std::string& warning : scene.warnings) print_message("warning: " + scene.name + ": " + warning);
  }
}

}  // namespace clusterbench::cli
