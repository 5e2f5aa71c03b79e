#include "config/config_keys.h"

#include "core/error.h"

namespace clusterbench::result {
namespace {

// An enumeration by the names that the function gives its values.
template <class Enum, const char* (*name)(Enum), Enum... values>
Type named_values() {
  Type type{Kind::text};
  type.to_json = [](const void* value, bool) { return Json(name(*static_cast<const Enum*>(value))); };
  type.from_json = [](const Json& json, void* value) {
    const auto set_if_named = [&](Enum one) {
      if (json != name(one)) return false;
      *static_cast<Enum*>(value) = one;
      return true;
    };
    if (!(set_if_named(values) || ...)) throw Error("", "", "found " + json.dump() + ", which has no value");
  };
  return type;
}

// A vector as a list of its numbers.
template <class Vec>
Type vector_type() {
  Type type{Kind::list};
  type.element = &type_of<typename Vec::value_type>();
  type.fixed_size = static_cast<std::size_t>(Vec::length());
  type.size = [](const void*) { return static_cast<std::size_t>(Vec::length()); };
  type.at = [](const void* vector, std::size_t i) -> const void* {
    return &(*static_cast<const Vec*>(vector))[static_cast<int>(i)];
  };
  type.append = [](void* vector, std::size_t i, const std::string&) -> void* {
    return &(*static_cast<Vec*>(vector))[static_cast<int>(i)];
  };
  return type;
}

// The keys of a struct of another layer. Numbers that are no integers are written as 2.0.
template <class Record>
struct Keys {
  Type type{Kind::object};

  template <auto member>
  Keys& add(const char* name) {
    FieldCollector<Record>(type.fields).add(name, About().as_fraction(), member);
    return *this;
  }
  Keys& with_type(const Type& other) {  // for the last key, in place of its member's
    type.fields.back().type = &other;
    return *this;
  }
};

const char* fit_name(scene::CameraFit fit) {
  return fit == scene::CameraFit::vertical ? "vertical" : "contain";
}

const char* name_of_per(bool per_type) {
  return per_type ? "type" : "frame";
}

}  // namespace

KEY_TYPE(Vec3d) {
  return vector_type<Vec3d>();
}
KEY_TYPE(Vec3i) {
  return vector_type<Vec3i>();
}

KEY_TYPE(std::filesystem::path) {
  using std::filesystem::path;
  Type type;
  type.to_json = [](const void* value, bool) {
    const auto& given = *static_cast<const path*>(value);
    return given.empty() ? Json() : Json(given.generic_string());
  };
  type.from_json = [](const Json& json, void* value) {
    *static_cast<path*>(value) = json.is_null() ? path() : path(json.get<std::string>());
  };
  return type;
}

KEY_TYPE(scene::CameraFit) {
  using enum scene::CameraFit;
  return named_values<scene::CameraFit, fit_name, contain, vertical>();
}
KEY_TYPE(scene::RangeRule) {
  using Rule = scene::RangeRule;
  return Keys<Rule>().add<&Rule::cutoff_lux>("cutoff_lux").add<&Rule::max_range_m>("max_range").type;
}
KEY_TYPE(scene::RigSpec) {
  using Rig = scene::RigSpec;
  return Keys<Rig>()
      .add<&Rig::lights>("lights")
      .add<&Rig::spots>("spots")
      .add<&Rig::range_m>("range")
      .add<&Rig::size_m>("size")
      .add<&Rig::seed>("seed")
      .type;
}

KEY_TYPE(view::Packing) {
  using enum view::Packing;
  return named_values<view::Packing, view::packing_name, float32, half, unorm16>();
}
KEY_TYPE(depth::TexelBound) {
  using enum depth::TexelBound;
  return named_values<depth::TexelBound, depth::name_of, proven, sampled>();
}

KEY_TYPE(cull::DistanceStep) {
  return Keys<cull::DistanceStep>().add<&cull::DistanceStep::distance_m>("distance_m").type;
}
KEY_TYPE(cull::VisibleSetStep) {
  using Step = cull::VisibleSetStep;
  return Keys<Step>()
      .add<&Step::view_cell_m>("view_cell_m")
      .add<&Step::voxel_m>("voxel_m")
      .add<&Step::rays>("rays")
      .type;
}
KEY_TYPE(cull::MostStep) {
  using Step = cull::MostStep;
  static const Type per = named_values<bool, name_of_per, false, true>();
  return Keys<Step>()
      .add<&Step::lights>("lights")
      .add<&Step::keep>("keep")
      .add<&Step::per_type>("per")
      .with_type(per)
      .type;
}
KEY_TYPE(cull::MostStep::Keep) {
  using enum cull::MostStep::Keep;
  return named_values<cull::MostStep::Keep, cull::name_of, first, nearest, shallowest>();
}

KEY_TYPE(gpu::Walking) {
  using enum gpu::Walking;
  return named_values<gpu::Walking, gpu::name_of, by_lane, by_light, by_cell>();
}
KEY_TYPE(measure::SampleSet) {
  using enum measure::SampleSet;
  return named_values<measure::SampleSet, measure::name_of, volume, opaque, transparent, fog, mirror, anywhere>();
}

KEY_TYPE(measure::Logarithm) {
  using enum measure::Logarithm;
  return named_values<measure::Logarithm, measure::name_of, rounded, glsl, fast>();
}
KEY_TYPE(measure::DepthRead) {
  using enum measure::DepthRead;
  return named_values<measure::DepthRead, measure::name_of, given, d32f, d24>();
}
KEY_TYPE(measure::AllocationRule) {
  using Rule = measure::AllocationRule;
  return Keys<Rule>().add<&Rule::margin>("margin").add<&Rule::warn_at>("warn_at").type;
}

KEY_TYPE(config::LimitRule) {
  Type type{Kind::text};
  type.to_json = [](const void* value, bool) { return Json(static_cast<const config::LimitRule*>(value)->text()); };
  type.from_json = [](const Json& json, void* value) {
    *static_cast<config::LimitRule*>(value) = config::limit_rule(json.get<std::string>(), "", "");
  };
  return type;
}

}  // namespace clusterbench::result
