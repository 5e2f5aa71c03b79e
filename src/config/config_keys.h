#pragma once
// Keys of a configuration as members of structs. A struct lists each key once, with its default, which is that of the
// schema:
//
//   struct StabilityRequest {
//     RECORD(StabilityRequest);
//     KEY(int, steps, 200);
//     END_RECORD;
//   };
//
// A key that may be null is a result::Nullable, a key without a default a std::optional. tests/config/config_keys_test
// compares names, values and defaults with the schema.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "config/limit_rules.h"
#include "cull/pre_cull_spec.h"
#include "depth/shadow_map.h"
#include "gpu/reading/walking.h"
#include "measure/lists/buffers.h"
#include "measure/samples/lookup_check.h"
#include "measure/samples/samples.h"
#include "result/fields.h"
#include "scene/rig.h"
#include "scene/scene.h"
#include "view/packing.h"

#define KEY_AS(name, Type, member, ...) \
  Type member = __VA_ARGS__;            \
  LIST_FIELD(name, member, {})
#define KEY(Type, member, ...) KEY_AS(#member, Type, member, __VA_ARGS__)

namespace clusterbench::config {

// Fills a struct from an object that the schema has checked and given its defaults.
template <class Record>
Record read_keys(const nlohmann::json& object) {
  return result::from_json<Record>(result::Json(object));
}

}  // namespace clusterbench::config

// Types of other layers: structs with their keys, enumerations by their names, and values with a form of their own.
#define KEY_TYPE(T) \
  template <>       \
  Type make_type<T>()

namespace clusterbench::result {

KEY_TYPE(Vec3d);
KEY_TYPE(Vec3i);
KEY_TYPE(std::filesystem::path);  // null for an empty path
KEY_TYPE(scene::CameraFit);
KEY_TYPE(scene::RangeRule);
KEY_TYPE(scene::RigSpec);
KEY_TYPE(view::Packing);
KEY_TYPE(depth::TexelBound);
KEY_TYPE(cull::DistanceStep);
KEY_TYPE(cull::VisibleSetStep);
KEY_TYPE(cull::MostStep);
KEY_TYPE(cull::MostStep::Keep);
KEY_TYPE(gpu::Walking);
KEY_TYPE(measure::SampleSet);
KEY_TYPE(measure::Logarithm);
KEY_TYPE(measure::DepthRead);
KEY_TYPE(measure::AllocationRule);
KEY_TYPE(config::LimitRule);  // as text

}  // namespace clusterbench::result
