#include "report/merge.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "report/conclusion.h"
#include "report/contender.h"
#include "report/machine.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// What cases in one result were judged by.
constexpr const char* k_in_common[] = {"allocation", "cost", "rank_by"};

bool is_measured(const Json& result) {
  for (const Json& result_case : result.at("cases"))
    if (result_case.contains("timing") || result_case.contains("count")) return true;
  return false;
}

void check_origin(const NamedPart& first, const NamedPart& next) {
  for (const char* key : k_in_common)
    if (first.result.at("config").value(key, Json()) != next.result.at("config").value(key, Json()))
      throw Error(next.file, std::string("/config/") + key, "is not that of " + first.file);
  if (!is_measured(first.result) && !is_measured(next.result)) return;
  for (const char* key : {"tool", "machine"})
    if (without_state(first.result.at(key)) != without_state(next.result.at(key)))
      throw Error(next.file, std::string("/") + key,
                  "is not that of " + first.file + ": times and instructions of both have no place in one result");
}

// Appends to `all` what it has not yet; `key` tells two things apart, `where` names their list.
class Union {
 public:
  Union(Json& all, const char* where, const char* key) : all_(all), where_(where), key_(key) {}

  // `may_repeat`: the same thing again is passed over.
  void add(const Json& item, const std::string& file, bool may_repeat) {
    const std::string name = item.at(key_).get<std::string>();
    const auto [earlier, is_new] = seen_.try_emplace(name, Place{all_.size(), file});
    if (is_new) {
      all_.push_back(item);
    } else if (!may_repeat || all_[earlier->second.index] != item) {
      throw Error(file, std::string("/") + where_,
                  std::string("has ") + key_ + " '" + name + "', and " + earlier->second.file + " has it, too" +
                      (may_repeat ? ", but it is another" : ""));
    }
  }

 private:
  struct Place {
    std::size_t index;
    std::string file;
  };
  Json& all_;
  const char *where_, *key_;
  std::map<std::string, Place> seen_;
};

// Shards skip the same combinations, for the same reasons.
void add_skipped(Json& all, const Json& skipped) {
  for (const Json& skip : skipped)
    if (std::find(all.begin(), all.end(), skip) == all.end()) all.push_back(skip);
}

Json merged_config(const std::vector<NamedPart>& parts) {
  const Json& first = parts.front().result.at("config");
  Json all = Json::array();
  bool is_same = true;
  for (const NamedPart& part : parts) {
    is_same = is_same && part.result.at("config") == first;
    all.push_back(part.result.at("config"));
  }
  if (is_same) return first;
  Json config{{"allocation", Json::object()}};
  for (const char* key : k_in_common)
    if (first.contains(key)) config[key] = first[key];
  config["merged"] = all;
  return config;
}

std::string merged_name(const std::vector<NamedPart>& parts) {
  std::string name = parts.front().result.at("name").get<std::string>();
  std::string last = name;
  for (const NamedPart& part : parts) {
    const std::string next = part.result.at("name").get<std::string>();
    if (next != last) name += " + " + next;
    last = next;
  }
  return name;
}

}  // namespace

Json merged(const std::vector<NamedPart>& parts) {
  const Json& first = parts.front().result;
  Json scenes = Json::array(), cases = Json::array(), skipped = Json::array();
  std::vector<std::string> failed;
  Union scene_union(scenes, "scenes", "name"), case_union(cases, "cases", "id");
  for (const NamedPart& part : parts) {
    check_origin(parts.front(), part);
    for (const Json& scene : part.result.at("scenes")) scene_union.add(scene, part.file, true);
    for (const Json& result_case : part.result.at("cases")) case_union.add(result_case, part.file, false);
    add_skipped(skipped, part.result.at("skipped"));
    for (const Json& failure : part.result.value("failed", Json::array())) failed.push_back(failure.get<std::string>());
  }
  Json out{{"schema_version", first.at("schema_version")},
           {"name", merged_name(parts)},
           {"tool", first.at("tool")},
           {"machine", without_state(first.at("machine"))},
           {"config", merged_config(parts)},
           {"scenes", scenes},
           {"cases", cases},
           {"pareto_front", fronts(scenes, cases, first)},
           {"skipped", skipped}};
  add_presets(out, first);
  out["conclusions"] = conclusions_of(out, first);
  conclude_failures(out, failed);
  return out;
}

}  // namespace clusterbench::report
