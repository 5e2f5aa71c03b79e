#include "cli/running/broken_cases.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/output/output.h"
#include "core/json_document.h"
#include "core/text.h"
#include "run/findings/broken_cases.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;
using Ids = std::vector<std::string>;

bool has(const Ids& ids, const std::string& id) {
  return std::ranges::find(ids, id) != ids.end();
}

const run::GroupPlan* group_with(const run::Plan& plan, const std::string& id) {
  const auto has_case = [&](const run::GroupPlan& group) {
    return std::ranges::find(group.cases, id, &run::CasePlan::id) != group.cases.end();
  };
  const auto found = std::ranges::find_if(plan.groups, has_case);
  return found == plan.groups.end() ? nullptr : &*found;
}

// The cases of the method that was called, which share its lists: those that are not finished, or all if they are.
std::vector<const run::CasePlan*> cases_of(const Casualty& casualty, const run::Plan& plan, const Ids& finished) {
  std::vector<const run::CasePlan*> all, open;
  const run::GroupPlan* group = group_with(plan, casualty.call.group);
  for (std::size_t i = 0; group != nullptr && i < group->cases.size(); ++i) {
    const run::CasePlan& one = group->cases[i];
    if (run::label_of(one.method()) != casualty.call.label) continue;
    all.push_back(&one);
    if (!has(finished, one.id)) open.push_back(&one);
  }
  return open.empty() ? all : open;
}

void add_casualty(const Casualty& casualty, const config::Config& config, const run::Plan& plan, const Ids& finished,
                  report::Journal* journal, std::vector<result::BrokenCase>& broken) {
  const std::vector<const run::CasePlan*> cases = cases_of(casualty, plan, finished);
  if (cases.empty()) throw Error("", "", casualty.reason + ", in no case of this run", ExitCode::internal);
  const std::string others = cases.size() > 1 ? " and " + number_of(cases.size() - 1, "more case") : std::string();
  print_broken(cases.front()->name + others, casualty.reason);
  for (const run::CasePlan* one : cases) {
    const run::Breakdown breakdown{casualty.kind,       casualty.reason,    casualty.call.step,
                                   casualty.call.frame, casualty.call.pass, casualty.signal};
    broken.push_back(run::broken_case(config, plan, *one, breakdown));
    if (journal != nullptr) journal->add_broken(broken.back());
  }
}

}  // namespace

std::vector<result::BrokenCase> broken_so_far(const RunFlags& flags, const config::Config& config,
                                              const run::Plan& plan, const RunJournal& journal) {
  std::vector<result::BrokenCase> broken = journal.earlier_broken();
  if (flags.part.casualty)
    add_casualty(*flags.part.casualty, config, plan, journal.earlier_ids(), journal.file(), broken);
  return broken;
}

void print_broken(const std::string& names, const std::string& reason) {
  print_message("warning: " + names + ": " + reason + "; the others are measured without it");
}

std::string timing_facts(const std::string& earlier, const run::Result& measured) {
  Json facts = json_or_discarded<Json>(earlier);
  if (!facts.is_object()) facts = Json::object();
  if (!facts.contains("date")) facts["date"] = measured.date;
  if (const auto& clock = measured.machine.clock; clock && !facts.contains("clock"))
    facts["clock"] = {clock->now_mhz, clock->most_mhz ? Json(*clock->most_mhz) : Json()};
  if (const auto& load = measured.machine.load) {
    if (!facts.contains("load")) facts["load"] = {load->begin, load->end};
    facts["load"][1] = load->end;
  }
  return facts.dump();
}

void set_timing_facts(const std::string& text, run::Result& result) {
  const Json facts = json_or_discarded<Json>(text);
  if (!facts.is_object() || result.date.empty()) return;
  if (facts.contains("date")) result.date = facts["date"];
  if (facts.contains("clock")) {
    result.machine.clock.emplace().now_mhz = facts["clock"][0];
    if (facts["clock"][1].is_number()) result.machine.clock->most_mhz = facts["clock"][1].get<double>();
  }
  if (facts.contains("load")) result.machine.load = run::LoadFacts{facts["load"][0], facts["load"][1]};
}

}  // namespace clusterbench::cli
