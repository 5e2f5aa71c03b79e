#include "report/results/merge.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "report/cases/contender.h"
#include "report/cases/json_values.h"
#include "report/choosing/conclusion.h"
#include "report/documents/machine_name.h"
#include "report/results/merged_machines.h"
#include "report/results/result_record.h"
#include "report/results/sweep.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// Parts of a configuration that must be equal for all cases of a result.
constexpr const char* k_in_common[] = {"allocation", "cost", "rank_by", "reading"};

bool has_measured(const result::Result& result) {
  return std::ranges::any_of(result.cases, is_measured);
}

// What a machine chooses itself is not the program's.
result::Tool without_target(result::Tool tool) {
  tool.simd_target.clear();
  return tool;
}

bool has_swept_times(const result::Result& result) {
  return std::ranges::any_of(result.cases,
                             [](const result::Case& one) { return one.timing && one.timing->caches == "cold"; });
}

// Times after sweeps of the caches of two sizes do not compare. Null: by the caches of the machine.
void check_sweeps(const std::vector<NamedPart>& parts) {
  const NamedPart* first = nullptr;
  for (const NamedPart& part : parts) {
    if (!has_swept_times(part.result)) continue;
    if (first == nullptr) first = &part;
    const Json swept = setting_of_parts(first->result.config, "/timing/sweep_mib"),
               now = setting_of_parts(part.result.config, "/timing/sweep_mib");
    if (swept != now)
      throw Error(part.file, "/config/timing/sweep_mib",
                  "is " + now.dump() + ", and that of " + first->file + " is " + swept.dump() +
                      ": cold times of both have no place in one result");
  }
}

void check_origin(const NamedPart& first, const NamedPart& next) {
  for (const char* key : k_in_common)
    if (first.result.config.value(key, Json()) != next.result.config.value(key, Json()))
      throw Error(next.file, std::string("/config/") + key, "is not that of " + first.file);
  if (!has_measured(first.result) && !has_measured(next.result)) return;
  if (!are_same(without_target(first.result.tool), without_target(next.result.tool)))
    throw Error(next.file, "/tool",
                "is not that of " + first.file + ": times and instructions of both have no place in one result");
}

// Appends items to `all` that it does not contain yet. `key` identifies an item, `key_name` is its name in messages,
// and `where` that of the list.
template <class Item>
class Union {
 public:
  Union(std::vector<Item>& all, const char* where, std::string Item::*key, const char* key_name)
      : all_(all), where_(where), key_(key), key_name_(key_name) {}

  // `may_repeat`: an equal item is skipped.
  void add(const Item& item, const std::string& file, bool may_repeat) {
    const std::string& name = item.*key_;
    const auto [earlier, is_new] = seen_.try_emplace(name, Place{all_.size(), file});
    if (is_new) {
      all_.push_back(item);
    } else if (!may_repeat || !are_same(all_[earlier->second.index], item)) {
      throw Error(file, std::string("/") + where_,
                  std::string("has ") + key_name_ + " '" + name + "'" + title_of(item) + ", and " +
                      earlier->second.file + " has it, too" + (may_repeat ? ", but it is another" : k_advice));
    }
  }

 private:
  static std::string title_of(const Item& item) {
    if constexpr (std::is_same_v<Item, result::Case>) return " (" + item.name + ")";
    return "";
  }
  static constexpr const char* k_advice =
      std::is_same_v<Item, result::Case>
          ? "; a merged result has each case once: clusterbench report shows both results, compare compares them"
          : "";

  struct Place {
    std::size_t index;
    std::string file;
  };
  std::vector<Item>& all_;
  const char* where_;
  std::string Item::*key_;
  const char* key_name_;
  std::map<std::string, Place> seen_;
};

// Shards skip the same combinations, for the same reasons.
void add_skipped(std::vector<result::Skipped>& all, const std::vector<result::Skipped>& skipped) {
  for (const result::Skipped& skip : skipped)
    if (std::ranges::none_of(all, [&](const result::Skipped& other) { return are_same(other, skip); }))
      all.push_back(skip);
}

// A case that broke in one part and was measured in another is in the result by its figures, and fails.
void add_broken(result::Result& all, const result::Result& part) {
  if (!part.broken) return;
  if (!all.broken) all.broken.emplace();
  for (const result::BrokenCase& broken : *part.broken)
    if (std::ranges::find(*all.broken, broken.id, &result::BrokenCase::id) == all.broken->end())
      all.broken->push_back(broken);
}

Json merged_config(const std::vector<NamedPart>& parts) {
  const Json& first = parts.front().result.config;
  Json all = Json::array();
  bool is_same = true;
  for (const NamedPart& part : parts) {
    is_same = is_same && part.result.config == first;
    all.push_back(part.result.config);
  }
  if (is_same) return first;
  Json config{{"allocation", Json::object()}};
  for (const char* key : k_in_common)
    if (first.contains(key)) config[key] = first[key];
  config["merged"] = all;
  return config;
}

std::string merged_name(const std::vector<NamedPart>& parts) {
  std::string name = parts.front().result.name;
  std::string last = name;
  for (const NamedPart& part : parts) {
    const std::string& next = part.result.name;
    if (next != last) name += " + " + next;
    last = next;
  }
  return name;
}

// The device of all parts that have one. None where they have several: each case names that of its times.
std::optional<result::Device> common_device(const std::vector<NamedPart>& parts) {
  std::optional<result::Device> device;
  for (const NamedPart& part : parts) {
    if (!part.result.device) continue;
    if (device && !are_same(*device, *part.result.device)) return {};
    device = part.result.device;
  }
  return device;
}

}  // namespace

result::Result merged(std::vector<NamedPart> parts) {
  const bool is_sweep = is_any_shard(parts);
  if (is_sweep) order_shards(parts);
  check_sweeps(parts);
  const result::Result& first = parts.front().result;
  result::Result out;
  out.schema_version = first.schema_version;
  out.name = merged_name(parts);
  out.tool = first.tool;
  out.machine = machine_kind(first.machine);
  out.device = common_device(parts);
  out.config = is_sweep ? first.config : merged_config(parts);
  MachinesOfParts machines(parts);
  std::vector<std::string> failed;
  Union<result::Scene> scenes(out.scenes, "scenes", &result::Scene::name, "name");
  std::vector<result::Plugin> all_plugins;
  Union<result::Plugin> plugins(all_plugins, "plugins", &result::Plugin::id, "plug-in");
  Union<result::Case> cases(out.cases, "cases", &result::Case::id, "id");
  for (const NamedPart& part : parts) {
    check_origin(parts.front(), part);
    for (const result::Plugin& plugin : part.result.plugins.value_or(std::vector<result::Plugin>()))
      plugins.add(plugin, part.file, true);
    for (const result::Scene& scene : part.result.scenes) scenes.add(scene, part.file, true);
    for (result::Case result_case : part.result.cases) {
      machines.name_in(result_case, part.result);
      cases.add(result_case, part.file, false);
    }
    add_skipped(out.skipped, part.result.skipped);
    add_broken(out, part.result);
    if (part.result.failed) failed.insert(failed.end(), part.result.failed->begin(), part.result.failed->end());
  }
  if (!all_plugins.empty()) out.plugins = std::move(all_plugins);
  machines.add_to(out);
  out.pareto_front = fronts(out.scenes, out.cases, first);
  add_presets(out, first);
  out.conclusions = conclusions_of(out, first);
  conclude_failures(out, failed);
  return out;
}

}  // namespace clusterbench::report
