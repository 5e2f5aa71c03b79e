#include "config/config_sections.h"

#include <algorithm>
#include <set>

#include "config/config_grids.h"
#include "config/config_scenes.h"
#include "core/error.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

// The record of one set of samples; `given` has only the set's own keys.
SampleSetRequest sample_set(measure::SampleSet set, const Json& given) {
  Json keys = result::to_json(SampleSetRequest());
  keys.update(given);
  auto request = read_keys<SampleSetRequest>(keys);
  request.set = set;
  return request;
}

}  // namespace

std::string PrecisionRequest::label() const {
  return std::string(view::packing_name(packing)) + (inflate ? "+inflate" : "");
}

double SampleSetRequest::most_samples(Vec2i viewport) const {
  if (needs_triangles()) return static_cast<double>(viewport.x) * viewport.y / divisor / divisor;
  if (set == measure::SampleSet::fog) return static_cast<double>(froxels.x) * froxels.y * froxels.z;
  return count;
}

std::vector<measure::LookupWay> LookupRequest::ways() const {
  std::vector<measure::LookupWay> all;
  for (const measure::Logarithm logarithm : logarithms)
    for (const measure::DepthRead depth : depths) all.push_back({logarithm, depth});
  return all;
}

Sections read_sections(const Json& document, const JsonText& text) {
  Json own = Json::object();
  for (const result::Field& field : result::type_of<Sections>().fields)
    if (document.contains(field.name)) own[field.name] = document[field.name];
  Sections sections;
  try {
    sections = read_keys<Sections>(own);
  } catch (const Error& error) {
    throw Error(text.file, text.where(error.where()), error.message());
  }
  if (std::filesystem::path& baseline = sections.limits.baseline; !baseline.empty())
    baseline = path_in(text, baseline.string(), text.where("/limits/baseline"));
  return sections;
}

std::vector<PrecisionRequest> precisions(const Json& document, const JsonText& text) {
  const Json& list = document["precision"];
  std::vector<PrecisionRequest> out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string pointer = child_pointer("/precision", i), where = text.where(pointer);
    for (const Json& object : expand_all_axes(list[i], text, pointer)) {
      const auto request = read_keys<PrecisionRequest>(object);
      if (request.inflate && !request.is_lossy())
        throw Error(text.file, where,
                    "float32 loses nothing that assigners do not pad for themselves; inflate what "
                    "half or unorm16 loses");
      if (std::find(out.begin(), out.end(), request) != out.end())
        throw Error(text.file, where, "'" + request.label() + "' stands here twice");
      out.push_back(request);
    }
  }
  return out;
}

std::vector<ShadowCullRequest> shadow_culls(const Json& document, const JsonText& text) {
  std::vector<ShadowCullRequest> out;
  if (!document.contains("shadow_cull")) return out;
  for (const Json& object : expand_all_axes(document["shadow_cull"], text, "/shadow_cull")) {
    const auto request = read_keys<ShadowCullRequest>(object);
    if (std::ranges::find(out, request) != out.end())
      throw Error(text.file, text.where("/shadow_cull"), "has a list with the same value twice");
    out.push_back(request);
  }
  return out;
}

std::vector<SampleSetRequest> sample_sets(const Json& document) {
  std::vector<SampleSetRequest> sets;
  if (const int count = read_keys<ShadingRequest>(document["shading"]).samples; count > 0)
    sets.push_back({.set = measure::SampleSet::volume, .count = count});
  for (std::size_t i = 0; i < measure::k_sample_set_count; ++i) {
    const auto set = static_cast<measure::SampleSet>(i);
    if (const auto found = document["samples"].find(measure::name_of(set)); found != document["samples"].end())
      sets.push_back(sample_set(set, *found));
  }
  return sets;
}

std::vector<SampleSetRequest> reading_sets(const ReadingRequest& reading, const std::vector<SampleSetRequest>& sets) {
  std::vector<SampleSetRequest> out;
  for (const measure::SampleSet set : reading.sets) {
    const auto given = std::ranges::find(sets, set, &SampleSetRequest::set);
    SampleSetRequest& request = out.emplace_back(given == sets.end() ? SampleSetRequest{.set = set} : *given);
    if (!request.needs_triangles()) continue;
    request.divisor = reading.divisor;
    if (set == measure::SampleSet::opaque && !request.ground) request.ground = GroundRequest{.is_lowest = true};
  }
  return out;
}

}  // namespace clusterbench::config

namespace clusterbench::result {

KEY_TYPE(config::GroundRequest) {
  using config::GroundRequest;
  Type type;
  type.to_json = [](const void* value, bool) {
    const auto& ground = *static_cast<const GroundRequest*>(value);
    return ground.is_lowest ? Json("lowest") : Json(ground.height_m);
  };
  type.from_json = [](const Json& json, void* value) {
    *static_cast<GroundRequest*>(value) =
        json.is_number() ? GroundRequest{false, json.get<double>()} : GroundRequest{true, 0.0};
  };
  return type;
}

KEY_TYPE(config::DetailsFrames) {
  using config::DetailsFrames;
  Type type;
  type.to_json = [](const void* value, bool) {
    const auto& frames = *static_cast<const DetailsFrames*>(value);
    if (frames.choice == DetailsFrames::Choice::listed) return Json(frames.list);
    return frames.choice == DetailsFrames::Choice::evenly ? Json(frames.count) : Json("worst");
  };
  type.from_json = [](const Json& json, void* value) {
    DetailsFrames frames;
    if (json.is_number()) {
      frames = {DetailsFrames::Choice::evenly, json.get<int>()};
    } else if (json.is_array()) {
      const auto once = json.get<std::set<int>>();
      frames = {DetailsFrames::Choice::listed, 0, {once.begin(), once.end()}};
    }
    *static_cast<DetailsFrames*>(value) = frames;
  };
  return type;
}

}  // namespace clusterbench::result
