#include "cli/running/sharded_plan.h"

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/output/duration.h"
#include "cli/output/output.h"
#include "cli/running/run_journal.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/text.h"
#include "run/estimate.h"
#include "run/shards.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string shard_name(std::uint64_t index, std::uint64_t count) {
  return "shard " + std::to_string(index) + " of " + std::to_string(count);
}

// The digest of what all shards have in common: the same on all machines, wherever the scenes' files are.
std::string sweep_digest(const RunFlags& flags, const config::Config& config, const run::Plan& plan,
                         const std::string& baseline_sha256) {
  Json common = run_identity(flags, config, plan);
  if (!baseline_sha256.empty()) common["baseline"] = baseline_sha256;
  common["config"]["limits"] = config.resolved["limits"];  // the merge goes by them
  for (Json& scene : common["config"]["scenes"])
    if (scene.is_object()) scene.erase("path");
  const run::ToolFacts tool = run::tool_facts();
  common["build"] = {tool.compiler, tool.build_type};
  common["libraries"] = tool.libraries;
  Json ids = Json::array();
  for (const run::GroupPlan& group : plan.groups)
    for (const run::CasePlan& one : group.cases) ids.push_back(one.id);
  common["cases"] = ids;
  return sha256_hex(common.dump());
}

// "" where nothing is held against it: without one, and where nothing is measured.
std::string digest_of_baseline(const RunFlags& flags, const config::Config& config) {
  const fs::path& baseline = config.limits.baseline;
  if (baseline.empty() || flags.dry_run || !flags.dump_folder.empty()) return "";
  std::error_code none;
  if (fs::exists(baseline, none) && !fs::is_regular_file(baseline, none))
    throw Error(baseline.string(), "--baseline",
                "is no file that `clusterbench merge` could read, too; with --shard a baseline is a regular file");
  return sha256_hex(file_text(baseline));
}

// Results that cannot be read are replaced, as those of any run.
void refuse_other_shard(const std::string& output, const run::PlannedShard& shard) {
  std::error_code none;
  if (is_stream(output) || !fs::is_regular_file(output, none)) return;
  const Json earlier = json_or_discarded<Json>(file_text(output));
  if (!earlier.is_object() || !earlier.contains("shard") || !earlier["shard"].is_object()) return;
  const Json &index = earlier["shard"].value("index", Json()), &count = earlier["shard"].value("count", Json());
  const bool is_same = index == shard.index && count == shard.count;
  if (earlier["shard"].value("sweep", Json()) != shard.sweep || !index.is_number_unsigned() || is_same) return;
  throw Error(output, "/shard",
              "holds " + shard_name(index, count.is_number_unsigned() ? count.get<std::uint64_t>() : shard.count) +
                  " of this run, which " + shard_name(shard.index, shard.count) +
                  " would replace; give each shard a file of its own");
}

std::size_t cases_of(const run::Plan& plan, std::size_t begin, std::size_t end) {
  std::size_t cases = 0;
  for (std::size_t i = begin; i < end; ++i) cases += plan.groups[i].cases.size();
  return cases;
}

}  // namespace

run::Plan sharded_plan(const RunFlags& flags, const config::Config& config, run::Plan plan, const ShardChoice& choice) {
  const std::string baseline = digest_of_baseline(flags, config);
  const run::PlannedShard shard{choice.index,
                                choice.count,
                                sweep_digest(flags, config, plan, baseline),
                                flags.filter,
                                baseline.empty() ? "" : config.limits.baseline.string(),
                                baseline};
  refuse_other_shard(flags.output, shard);
  const std::vector<std::size_t> ends = run::shard_ends(run::predicted_work(config, plan), shard.count);
  run::Plan part = run::part_of(std::move(plan), shard.index == 1 ? 0 : ends[shard.index - 2], ends[shard.index - 1]);
  part.shard = shard;
  return part;
}

void print_shards(const config::Config& config, const run::Plan& plan, const ShardChoice& choice) {
  const std::vector<std::size_t> ends = run::shard_ends(run::predicted_work(config, plan), choice.count);
  const std::vector<run::GroupCost> costs = run::estimated_costs(config, plan);
  std::size_t begin = 0, shard = 0;
  double longest_s = 0.0;
  for (; shard < ends.size() && ends[shard] > begin; begin = ends[shard++]) {
    const double s = run::sum_s(std::span(costs).subspan(begin, ends[shard] - begin));
    longest_s = std::max(longest_s, s);
    std::cerr << (shard + 1 == choice.index ? "* " : "  ") << shard_name(shard + 1, choice.count) << ": "
              << number_of(cases_of(plan, begin, ends[shard]), "case") << ", takes " << duration_text(s) << "\n";
  }
  std::cerr << "  on " << number_of(choice.count, "machine") << " like this one: " << duration_text(longest_s)
            << ", the longest shard\n";
  if (shard < ends.size())
    std::cerr << "  " << number_of(ends.size() - shard, "shard") << " from " << shard + 1
              << " on: no case is left, since a scene on a grid is never divided\n";
}

std::string next_after_shard(const run::PlannedShard& shard) {
  return "next: " + shard_name(shard.index, shard.count) +
         " is done; fronts, ranks, budgets and the conclusion are those of all: clusterbench merge, with the results "
         "of all " +
         number_of(shard.count, "shard") + "\n";
}

}  // namespace clusterbench::cli
