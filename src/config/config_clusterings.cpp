#include "config/config_clusterings.h"

#include <algorithm>
#include <map>

#include "assign/contract/storage.h"
#include "config/config_grids.h"
#include "config/grid_json.h"
#include "config/pre_cull_json.h"
#include "config/presets/preset_library.h"
#include "config/schema/documents.h"
#include "config/schema/schema_reader.h"
#include "core/error.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

std::string param_text(const assign::ParamSpec& spec, const assign::ParamValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  const double number = std::get<double>(value);
  return spec.whole ? Json(static_cast<std::int64_t>(number)).dump() : Json(number).dump();
}

assign::ParamValue param_value(const Json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>();
  return value.get<std::string>();
}

MethodRequest method(const Json& object, std::span<const assign::ParamSpec> specs) {
  std::map<std::string, assign::ParamValue> given;
  for (const auto& [key, value] : object.items())
    if (key != "name") given[key] = param_value(value);
  return {object["name"].get<std::string>(), assign::Params(specs, given)};
}

std::span<const assign::ParamSpec> assigner_params(const std::string& name) {
  return assign::find_assigner(name)->params;
}
std::span<const assign::ParamSpec> storage_params(const std::string& name) {
  return assign::find_storage(name)->params;
}

template <class SpecsOf>
std::vector<MethodRequest> methods(const Json& list, const char* key, const JsonText& text, SpecsOf specs_of) {
  std::vector<MethodRequest> out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string pointer = std::string("/") + key;
    for (const Json& object : expand_all_axes(list[i], text, child_pointer(pointer, i))) {
      MethodRequest request = method(object, specs_of(object["name"].get<std::string>()));
      const bool twice = std::any_of(out.begin(), out.end(), [&](const MethodRequest& earlier) {
        return earlier.name == request.name && earlier.params.values() == request.params.values();
      });
      const bool as_written = text.value.contains(key) && text.value[key].size() == list.size();  // not from a pattern
      if (twice)
        throw Error(text.file, text.where(as_written ? child_pointer(pointer, i) : pointer),
                    "'" + request.label() + "' stands here twice with the same parameters");
      out.push_back(std::move(request));
    }
  }
  return out;
}

// The index of the first element equal to `item`, which is appended if there is none.
template <class Item, class IsEqual>
std::size_t index_in(std::vector<Item>& list, const Item& item, IsEqual is_equal) {
  const auto found = std::ranges::find_if(list, [&](const Item& other) { return is_equal(other, item); });
  const auto index = static_cast<std::size_t>(found - list.begin());
  if (found == list.end()) list.push_back(item);
  return index;
}

bool is_same_grid(const grid::GridSpec& a, const grid::GridSpec& b) {
  return grid_identity(a) == grid_identity(b);
}
bool is_same_method(const MethodRequest& a, const MethodRequest& b) {
  return a.name == b.name && a.params.values() == b.params.values();
}

// Appends the engine's own steps to each pre-cull of the configuration.
void add_engine_steps(const Json& parts, const Json& document, Config& config, PresetChoice& choice) {
  if (!parts.contains("pre_cull")) return;
  const std::vector<cull::Step> own = pre_cull_spec(document["pre_cull"][0]).steps;
  for (std::size_t i = 0; i < config.own_pre_culls; ++i) {
    cull::PreCullSpec spec = config.pre_culls[i];
    for (const cull::Step& step : own)
      if (std::ranges::find(spec.steps, step) == spec.steps.end()) spec.steps.push_back(step);
    choice.pre_culls.push_back(index_in(config.pre_culls, spec, std::equal_to<>()));
  }
}

// Replaces members of a preset's grid; new tiles replace the old ones completely, so that there are never two sizes.
Json changed_grid(Json grid, const GridChange& change) {
  if (change.grid.contains("tiles")) grid.erase("tiles");
  grid.merge_patch(change.grid);
  return grid;
}

void add_preset(const Preset& preset, std::size_t viewport, const Json& schema, PresetForm form,
                const GridChange& preset_grid, Config& config) {
  Json parts = preset_parts(preset, config.viewports[viewport], form);
  parts["grid"] = changed_grid(parts["grid"], preset_grid);
  JsonText text;
  text.file = "preset " + preset.name;
  for (const auto& [pointer, flag] : preset_grid.flags) text.flags["/grids/0" + pointer] = flag.shown();
  text.value["scenes"] = Json::array({{{"path", "any.glb"}}});
  text.value["grids"] = Json::array({parts["grid"]});
  text.value["assigners"] = Json::array({parts["assigner"]});
  if (parts.contains("storage")) text.value["storages"] = Json::array({parts["storage"]});
  if (parts.contains("pre_cull")) text.value["pre_cull"] = Json::array({parts["pre_cull"]});
  const Json document = read_by_schema(schema, text.value, text);
  PresetChoice choice{preset.name, viewport, 0, 0, std::nullopt};
  choice.assigner = index_in(
      config.assigners, methods(document["assigners"], "assigners", text, assigner_params).front(), is_same_method);
  if (parts.contains("storage"))
    choice.storage = index_in(config.storages, methods(document["storages"], "storages", text, storage_params).front(),
                              is_same_method);
  add_engine_steps(parts, document, config, choice);
  for (const grid::GridSpec& spec : grid_specs(document["grids"], text)) {
    choice.grid = index_in(config.grids, spec, is_same_grid);
    config.presets.push_back(choice);
  }
}

}  // namespace

std::string MethodRequest::label() const {
  const assign::AssignerDescriptor* assigner = assign::find_assigner(name);
  const assign::StorageDescriptor* storage = assign::find_storage(name);
  std::span<const assign::ParamSpec> specs;
  if (assigner != nullptr) specs = assigner->params;
  if (assigner == nullptr && storage != nullptr) specs = storage->params;
  std::string inner;
  for (const assign::ParamSpec& spec : specs) {
    const auto value = params.values().find(spec.name);
    if (value == params.values().end() || value->second == spec.default_value) continue;
    inner += (inner.empty() ? "" : ",") + spec.name + "=" + param_text(spec, value->second);
  }
  return inner.empty() ? name : name + "(" + inner + ")";
}

std::vector<cull::PreCullSpec> pre_culls(const Json& document, const JsonText& text) {
  if (!document.contains("pre_cull")) return {{}};
  std::vector<cull::PreCullSpec> out;
  const Json& list = document["pre_cull"];
  for (std::size_t i = 0; i < list.size(); ++i) {
    cull::PreCullSpec spec = pre_cull_spec(list[i]);
    if (std::find(out.begin(), out.end(), spec) != out.end())
      throw Error(text.file, text.where(child_pointer("/pre_cull", i)), "'" + spec.label() + "' stands here twice");
    out.push_back(std::move(spec));
  }
  return out;
}

void read_clusterings(const Json& document, const JsonText& text, const GridChange& preset_grid, Config& config) {
  if (document.contains("grids")) {
    config.grids = grid_specs(document["grids"], text);
    config.assigners = methods(document["assigners"], "assigners", text, assigner_params);
    config.storages = methods(document["storages"], "storages", text, storage_params);
  }
  config.own_grids = config.grids.size();
  config.own_assigners = config.assigners.size();
  config.own_storages = config.storages.size();
  if (!document.contains("presets")) return;
  const std::shared_ptr<const Json> schema = shared_config_schema();
  // Only a device that is named: without one, results are the same on every machine.
  const PresetForm form{document.value("as_shipped", false), !document.value("device", "").empty()};
  for (std::size_t viewport = 0; viewport < config.viewports.size(); ++viewport)
    for (const Json& name : document["presets"])
      add_preset(*find_preset(name.get<std::string>()), viewport, *schema, form, preset_grid, config);
}

}  // namespace clusterbench::config
