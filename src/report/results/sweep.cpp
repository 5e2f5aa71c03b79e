#include "report/results/sweep.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "report/cases/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string shard_text(const result::Shard& shard) {
  return "shard " + std::to_string(shard.index) + " of " + std::to_string(shard.count);
}

// What two machines choose for themselves, and what says where files are.
Json without_places(Json config) {
  for (const char* key : {"threads", "device"}) config.erase(key);
  if (config.contains("scenes"))
    for (Json& scene : config["scenes"])
      if (scene.is_object()) scene.erase("path");
  return config;
}

[[noreturn]] void refuse(const NamedPart& part, const std::string& where, const std::string& message) {
  throw Error(part.file, where, message);
}

// Refuses documents of two shards that differ, at the first place where they do.
void check_same(const NamedPart& first, const NamedPart& next, const std::string& at, const Json& of_first,
                const Json& of_next) {
  if (of_first == of_next) return;
  const FirstDifference found = first_difference(of_first, of_next);
  refuse(next, at + found.pointer,
         "is " + found.of_other + ", and " + found.of_one + " in " + first.file +
             ": shards of different runs have no place in one result");
}

Json program_of(const result::Result& result) {
  Json tool = result::to_json(result.tool);
  tool.erase("simd_target");
  return tool;
}

void check_scenes(const NamedPart& first, const NamedPart& next) {
  const std::vector<result::Scene>&one = first.result.scenes, &other = next.result.scenes;
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i)
    if (one[i].name == other[i].name && one[i].sha256 != other[i].sha256)
      refuse(next, "/scenes/" + std::to_string(i) + "/sha256",
             "is of another " + shown(one[i].name) + " than that of " + first.file +
                 ": shards of different runs have no place in one result");
}

std::string digest_of_baseline(const result::Result& result) {
  return result.shard->baseline ? result.shard->baseline->sha256 : "";
}

void check_cases(const NamedPart& part) {
  const std::uint64_t wanted = part.result.shard->cases, found = part.result.cases.size();
  if (found == wanted) return;
  refuse(part, "/cases",
         "has " + number_of(found, "case") + ", and the shard was written with " + number_of(wanted, "case") +
             ": the file was changed");
}

// `first`: a shard.
void check_of_one_run(const NamedPart& first, const NamedPart& next) {
  const result::Result &one = first.result, &other = next.result;
  if (!other.shard)
    refuse(next, "/shard", "is missing: it is a whole result, and " + first.file + " is " + shard_text(*one.shard));
  check_same(first, next, "/tool", program_of(one), program_of(other));
  check_same(first, next, "/config", without_places(one.config), without_places(other.config));
  if (one.shard->count != other.shard->count)
    refuse(next, "/shard", "is " + shard_text(*other.shard) + ", and " + first.file + " is " + shard_text(*one.shard));
  check_same(first, next, "/shard/filter", one.shard->filter.value_or(""), other.shard->filter.value_or(""));
  check_same(first, next, "/shard/baseline", digest_of_baseline(one), digest_of_baseline(other));
  check_scenes(first, next);
  if (one.shard->sweep == other.shard->sweep) return;
  refuse(
      next, "/shard/sweep",
      "is of another run than " + first.file + ": scenes, their triangles, plug-ins, shaders, --count or cases differ");
}

std::vector<std::string> missing_numbers(const std::vector<NamedPart>& parts, std::size_t most) {
  std::vector<std::string> missing;
  auto part = parts.begin();
  for (std::uint64_t index = 1; index <= parts.front().result.shard->count && missing.size() < most; ++index) {
    if (part != parts.end() && part->result.shard->index == index)
      ++part;
    else
      missing.push_back(std::to_string(index));
  }
  return missing;
}

void check_complete(const std::vector<NamedPart>& parts) {
  constexpr std::size_t k_named = 8;
  const std::uint64_t count = parts.front().result.shard->count, missing = count - parts.size();
  if (missing == 0) return;
  std::vector<std::string> files;
  for (const NamedPart& part : parts)
    if (files.size() < k_named) files.push_back(part.file);
  throw Error(joined(files) + (parts.size() > k_named ? " ..." : ""), "",
              std::string(missing == 1 ? "shard " : "shards ") + joined(missing_numbers(parts, k_named)) +
                  (missing > k_named ? " ..." : "") + " of " + std::to_string(count) +
                  (missing == 1 ? " is missing" : " are missing") + "; wanted are the results of all shards");
}

}  // namespace

bool is_any_shard(const std::vector<NamedPart>& parts) {
  return std::ranges::any_of(parts, [](const NamedPart& part) { return part.result.shard.has_value(); });
}

void order_shards(std::vector<NamedPart>& parts) {
  const auto first = std::ranges::find_if(parts, [](const NamedPart& part) { return part.result.shard.has_value(); });
  for (const NamedPart& part : parts) {
    check_of_one_run(*first, part);
    if (const result::Shard& shard = *part.result.shard; shard.index > shard.count)
      refuse(part, "/shard", "is " + shard_text(shard) + ", which is none of them");
    check_cases(part);
  }
  std::ranges::stable_sort(parts, {}, [](const NamedPart& part) { return part.result.shard->index; });
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (parts[i].result.shard->index == parts[i - 1].result.shard->index)
      refuse(parts[i], "/shard",
             "is " + shard_text(*parts[i].result.shard) + ", and so is " + parts[i - 1].file + "; take one of them");
  check_complete(parts);
}

}  // namespace clusterbench::report
