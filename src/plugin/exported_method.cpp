#include "plugin/exported_method.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>

#include "plugin/views.h"

namespace clusterbench::plugin {

struct ExportedMethod::Table : clusterbench_method {
  const assign::AssignerDescriptor* descriptor = nullptr;
  std::deque<clusterbench_parameter> specs;
  std::deque<std::vector<const char*>> choices;
  std::vector<const clusterbench_parameter*> pointers;
};

namespace {

// ---- From the interface's structs to the program's.

std::vector<float> boundaries(const float* first, std::uint32_t cells) {
  return {first, first + cells + 1};
}

Vec2i pair_of(const std::uint32_t* values) {
  return {static_cast<int>(values[0]), static_cast<int>(values[1])};
}

grid::ScreenGrid screen_of(const clusterbench_grid& from) {
  grid::ScreenGrid out;
  out.by_distance = from.kind == CLUSTERBENCH_DISTANCE;
  out.tiles.orthographic = from.orthographic != 0;
  out.tiles.count = pair_of(from.cells);
  out.tiles.pixels = pair_of(from.tile_pixels);
  out.tiles.viewport = pair_of(from.viewport);
  out.tiles.x = boundaries(from.x, from.cells[0]);
  out.tiles.y = boundaries(from.y, from.cells[1]);
  out.tiles.scale_x = from.tile_scale[0];
  out.tiles.scale_y = from.tile_scale[1];
  out.slices.boundaries = boundaries(from.z, from.cells[2]);
  using Form = grid::SliceLookup::Form;
  out.slices.lookup = {from.slice_form == 1   ? Form::linear
                       : from.slice_form == 2 ? Form::log2
                                              : Form::search,
                       from.slice_scale, from.slice_bias, static_cast<int>(from.first_slice), from.first};
  return out;
}

grid::Grid grid_of(const clusterbench_grid& from) {
  if (from.kind == CLUSTERBENCH_CASCADES) {
    const auto cells = [&](int axis) { return static_cast<int>(from.cells[axis]); };
    const auto levels = static_cast<int>(from.levels);
    return {grid::CascadesGrid{levels, {cells(0), cells(1), cells(2) / levels}, from.finest}};
  }
  if (from.kind == CLUSTERBENCH_WORLD)
    return {grid::WorldGrid{{from.origin[0], from.origin[1], from.origin[2]},
                            boundaries(from.x, from.cells[0]),
                            boundaries(from.y, from.cells[1]),
                            boundaries(from.z, from.cells[2])}};
  return {screen_of(from)};
}

void take_frame(const clusterbench_frame& from, view::Frame& out) {
  out.index = from.index;
  out.time_s = from.time;
  out.viewport = pair_of(from.viewport);
  out.projection = {from.orthographic != 0, from.left,     from.right, from.bottom, from.top,
                    from.near_plane,        from.far_plane};
  out.view_space.origin = {from.eye[0], from.eye[1], from.eye[2]};
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) out.view_space.rotation[column][row] = from.view_from_world[4 * column + row];
}

const double* of_light(const double* first, std::size_t stride, std::size_t light) {
  return reinterpret_cast<const double*>(reinterpret_cast<const std::byte*>(first) + light * stride);
}

Vec3d vector_at(const double* at) {
  return {at[0], at[1], at[2]};
}

void take_source(const clusterbench_lights& from, const view::LightRanges& ranges,
                 std::vector<scene::WorldLight>& out) {
  constexpr scene::LightType k_types[] = {scene::LightType::point, scene::LightType::spot, scene::LightType::box};
  out.resize(from.world_position == nullptr ? 0 : ranges.size());
  for (std::uint32_t i = 0; i < out.size(); ++i) {
    const auto at = [&](const double* first) { return of_light(first, from.world_stride, i); };
    out[i].type = k_types[ranges.type_of(i)];
    out[i].position = vector_at(at(from.world_position));
    out[i].range_m = *at(from.world_radius);
    out[i].direction = vector_at(at(from.world_axis));
    out[i].outer_cone_rad = *at(from.world_angle);
    for (int axis = 0; axis < 3; ++axis)
      out[i].half_axes_m[static_cast<std::size_t>(axis)] = vector_at(at(from.world_half_axes) + 3 * axis);
  }
}

void take_lights(const clusterbench_lights& from, view::Frame& frame, view::LightArrays& out) {
  static_cast<view::LightRanges&>(out) = view::LightRanges(from.point_count, from.spot_count, from.box_count);
  const auto take = [](const float* values, std::size_t count, std::vector<float>& to) {
    to.assign(values, values + count);
  };
  take(from.x, out.size(), out.x);
  take(from.y, out.size(), out.y);
  take(from.z, out.size(), out.z);
  take(from.radius, out.size(), out.radius);
  take(from.reach, out.size(), out.reach);
  take(from.axis_x, from.spot_count, out.axis_x);
  take(from.axis_y, from.spot_count, out.axis_y);
  take(from.axis_z, from.spot_count, out.axis_z);
  take(from.cos_angle, from.spot_count, out.cos_angle);
  take(from.sin_angle, from.spot_count, out.sin_angle);
  out.half_axes.resize(from.box_count);
  for (std::size_t i = 0; i < 9 * out.half_axes.size(); ++i)
    out.half_axes[i / 9][i / 3 % 3][static_cast<int>(i % 3)] = from.half_axes[i];
  take_source(from, out, frame.lights);
  frame.points = from.point_count;
  frame.boxes = from.box_count;
  out.source = frame.lights;
  out.space.origin = vector_at(from.space_origin);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) out.space.rotation[column][row] = from.space_rotation[3 * row + column];
}

// ---- An instance.

struct Instance {
  std::unique_ptr<assign::ListAssigner> assigner;
  grid::Grid grid;
  view::Frame frame;
  view::LightArrays lights;
  depth::DepthImage depth;
  assign::Lists lists;

  void assign(const clusterbench_frame& from, const clusterbench_lights& given) {
    take_frame(from, frame);
    take_lights(given, frame, lights);
    if (from.depth != nullptr) {
      depth.pixels = depth::PixelGrid(frame.viewport, 1);
      depth.nearest.assign(from.depth, from.depth + depth.pixels.count());
    }
    assigner->assign({frame, lights, from.depth == nullptr ? nullptr : &depth}, lists);
  }
};

clusterbench_status failed(clusterbench_error* error, const char* text) {
  if (error->capacity == 0) return CLUSTERBENCH_FAILED;
  const std::size_t length = std::min<std::size_t>(std::strlen(text), error->capacity - 1);
  std::memcpy(error->text, text, length);
  error->text[length] = '\0';
  return CLUSTERBENCH_FAILED;
}

template <class Work>
clusterbench_status caught(clusterbench_error* error, const Work& work) noexcept {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return CLUSTERBENCH_OUT_OF_MEMORY;
  } catch (const std::exception& thrown) {
    return failed(error, thrown.what());
  } catch (...) {
    return failed(error, "threw what is no std::exception");
  }
}

assign::ParamValue value_of(const assign::ParamSpec& spec, const clusterbench_value& value) {
  if (std::holds_alternative<std::string>(spec.default_value)) return std::string(value.text);
  if (std::holds_alternative<bool>(spec.default_value)) return value.number != 0.0;
  return value.number;
}

clusterbench_status build(void* instance, const clusterbench_grid* grid, std::uint32_t light_types,
                          clusterbench_error* error) {
  return caught(error, [&]() -> clusterbench_status {
    auto& own = *static_cast<Instance*>(instance);
    own.grid = grid_of(*grid);
    own.assigner->build(own.grid, {(light_types & CLUSTERBENCH_SPOTS) != 0, (light_types & CLUSTERBENCH_BOXES) != 0});
    return CLUSTERBENCH_OK;
  });
}

clusterbench_status assign_frame(void* instance, const clusterbench_frame* frame, const clusterbench_lights* lights,
                                 clusterbench_lists* out, clusterbench_error* error) {
  return caught(error, [&]() -> clusterbench_status {
    auto& own = *static_cast<Instance*>(instance);
    own.assign(*frame, *lights);
    out->count = own.lists.lights.size();
    out->tests_done = own.assigner->tests_done();
    out->fallbacks = own.assigner->fallbacks();
    out->scratch_bytes = own.assigner->scratch_bytes();
    if (out->count > out->capacity) return CLUSTERBENCH_MORE;
    std::ranges::copy(own.lists.begin, out->begin);
    std::ranges::copy(own.lists.lights, out->lights);
    return CLUSTERBENCH_OK;
  });
}

void destroy(void* instance) {
  delete static_cast<Instance*>(instance);
}

// ---- A descriptor as data of the interface.

std::uint32_t if_so(bool is_so, std::uint32_t bit) {
  return is_so ? bit : 0u;
}

clusterbench_parameter parameter_of(const assign::ParamSpec& spec, const std::vector<const char*>& choices) {
  clusterbench_parameter out{};
  out.struct_size = sizeof out;
  out.name = spec.name.c_str();
  out.summary = spec.summary.c_str();
  out.unit = spec.unit.c_str();
  out.min = spec.min;
  out.max = spec.max;
  out.choices = choices.data();
  out.choice_count = static_cast<std::uint32_t>(choices.size());
  out.flags = if_so(spec.whole, CLUSTERBENCH_PARAMETER_WHOLE) |
              if_so(spec.is_thread_count, CLUSTERBENCH_PARAMETER_THREADS) |
              if_so(std::isfinite(spec.conservative_from), CLUSTERBENCH_PARAMETER_CONSERVATIVE_FROM);
  if (std::isfinite(spec.conservative_from)) out.conservative_from = spec.conservative_from;
  out.type = CLUSTERBENCH_PARAMETER_TEXT;
  if (const auto* text = std::get_if<std::string>(&spec.default_value)) out.default_text = text->c_str();
  if (const auto* flag = std::get_if<bool>(&spec.default_value)) {
    out.type = CLUSTERBENCH_PARAMETER_FLAG;
    out.default_number = *flag ? 1.0 : 0.0;
  }
  if (const auto* number = std::get_if<double>(&spec.default_value)) {
    out.type = CLUSTERBENCH_PARAMETER_NUMBER;
    out.default_number = *number;
  }
  return out;
}

clusterbench_method method_of(const assign::AssignerDescriptor& descriptor) {
  clusterbench_method out{};
  out.struct_size = sizeof out;
  for (const grid::Kind kind : descriptor.kinds) out.grid_kinds |= bit_of(kind);
  out.light_types = if_so(descriptor.points, CLUSTERBENCH_POINTS) | if_so(descriptor.spots, CLUSTERBENCH_SPOTS) |
                    if_so(descriptor.boxes, CLUSTERBENCH_BOXES);
  out.needs = if_so(descriptor.needs.depth, CLUSTERBENCH_NEEDS_DEPTH);
  out.flags = if_so(descriptor.conservative, CLUSTERBENCH_CONSERVATIVE) | if_so(descriptor.exact, CLUSTERBENCH_EXACT) |
              if_so(descriptor.orthographic, CLUSTERBENCH_ORTHOGRAPHIC) |
              if_so(descriptor.all_pairs, CLUSTERBENCH_ALL_PAIRS) |
              if_so(descriptor.by_name || descriptor.naive, CLUSTERBENCH_BY_NAME);
  out.name = descriptor.name.c_str();
  out.summary = descriptor.summary.c_str();
  out.source = descriptor.source.c_str();
  out.build = build;
  out.assign = assign_frame;
  out.destroy = destroy;
  return out;
}

}  // namespace

ExportedMethod::ExportedMethod(const assign::AssignerDescriptor& descriptor) : table_(std::make_unique<Table>()) {
  static_cast<clusterbench_method&>(*table_) = method_of(descriptor);
  table_->descriptor = &descriptor;
  for (const assign::ParamSpec& spec : descriptor.params) {
    std::vector<const char*>& choices = table_->choices.emplace_back();
    for (const std::string& choice : spec.choices) choices.push_back(choice.c_str());
    table_->pointers.push_back(&table_->specs.emplace_back(parameter_of(spec, choices)));
  }
  table_->parameter_count = static_cast<std::uint32_t>(table_->pointers.size());
  table_->parameters = table_->pointers.data();
  table_->create = [](const clusterbench_method* method, const clusterbench_value* values, std::uint32_t count,
                      void** instance, clusterbench_error* error) -> clusterbench_status {
    if (const auto known = clusterbench_check_values(method, values, count, error); known != CLUSTERBENCH_OK)
      return known;
    return caught(error, [&]() -> clusterbench_status {
      const assign::AssignerDescriptor& own = *static_cast<const Table*>(method)->descriptor;
      std::map<std::string, assign::ParamValue> given;
      for (std::uint32_t i = 0; i < count; ++i) given[values[i].name] = value_of(own.params[i], values[i]);
      auto made = std::make_unique<Instance>();
      made->assigner = own.make(assign::Params(own.params, given));
      *instance = made.release();
      return CLUSTERBENCH_OK;
    });
  };
}

ExportedMethod::~ExportedMethod() = default;

const clusterbench_method* ExportedMethod::table() const {
  return table_.get();
}

}  // namespace clusterbench::plugin
