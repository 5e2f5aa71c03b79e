#include <set>
#include <utility>

#include "scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

bool moves_a_node(const std::string& path) {
  return path == "translation" || path == "rotation" || path == "scale";
}

json checked_sampler(const Place& root, const Place& sampler) {
  sampler.expect_object();
  const std::size_t accessors = count_of(root, "accessors");
  json out = {{"input", sampler.at("input").index(accessors, "accessor")},
              {"output", sampler.at("output").index(accessors, "accessor")},
              {"interpolation", "LINEAR"}};
  if (sampler.has("interpolation")) out["interpolation"] = sampler.at("interpolation").text();
  const std::string interpolation = out["interpolation"].get<std::string>();
  if (interpolation != "LINEAR" && interpolation != "STEP" && interpolation != "CUBICSPLINE") {
    sampler.at("interpolation").refuse("found '" + interpolation + "', LINEAR, STEP or CUBICSPLINE is needed");
  }
  return out;
}

// null for a channel that moves no node.
json checked_channel(const Place& root, const Place& channel, std::size_t samplers,
                     std::vector<std::string>& warnings) {
  const std::size_t sampler = channel.at("sampler").index(samplers, "sampler");
  const Place target = channel.at("target");
  const std::string path = target.at("path").text();
  if (target.has("node")) target.at("node").index(count_of(root, "nodes"), "node");
  if (!moves_a_node(path)) {
    warnings.push_back(warning_at(target.at("path"), "'" + path + "' moves no node and is ignored"));
    return json(nullptr);
  }
  if (!target.has("node")) {
    warnings.push_back(warning_at(target, "names no node and is ignored"));
    return json(nullptr);
  }
  const std::size_t node = target.at("node").whole();
  if (root.at("nodes").at(node).has("matrix")) {
    target.refuse("node " + std::to_string(node) +
                  " has a matrix; only translation, rotation and scale can be animated");
  }
  return {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
}

json checked_animation(const Place& root, const Place& animation, std::vector<std::string>& warnings) {
  const Place samplers = animation.at("samplers"), channels = animation.at("channels");
  samplers.expect_array();
  channels.expect_array();
  json out = {{"samplers", json::array()}, {"channels", json::array()}};
  for (std::size_t i = 0; i < samplers.size(); ++i) out["samplers"].push_back(checked_sampler(root, samplers.at(i)));
  std::set<std::pair<std::size_t, std::string>> targets;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    json channel = checked_channel(root, channels.at(i), samplers.size(), warnings);
    if (channel.is_null()) continue;
    const json& target = channel["target"];
    if (!targets.emplace(target["node"].get<std::size_t>(), target["path"].get<std::string>()).second) {
      channels.at(i).at("target").refuse("an earlier channel of this animation has the same node and path");
    }
    out["channels"].push_back(std::move(channel));
  }
  return out;
}

}  // namespace

json checked_animations(const Place& root, std::vector<std::string>& warnings) {
  json out = json::array();
  const std::size_t count = count_of(root, "animations");
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back(checked_animation(root, root.at("animations").at(i), warnings));
  }
  return out;
}

}  // namespace clusterbench::scene
