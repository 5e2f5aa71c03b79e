// LightLists: one frame's input through method and storage.

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "assign/contract/storage.h"
#include "core/arrays.h"
#include "core/error.h"
#include "core/float_environment.h"
#include "core/memory.h"
#include "core/text.h"
#include "library/engine_words.h"
#include "library/given.h"
#include "library/jobs.h"

namespace clusterbench::library {
namespace {

std::string known_names(std::string_view name, const std::vector<std::string>& names) {
  return "is '" + std::string(name) + "'" + did_you_mean(name, names) + "; there are: " + joined(names);
}

const assign::AssignerDescriptor& method_named(std::string_view name) {
  const assign::AssignerDescriptor* found = assign::find_assigner(std::string(name));
  if (found == nullptr) throw Error("", "method", known_names(name, assign::assigner_names()));
  return *found;
}

const assign::StorageDescriptor& storage_named(std::string_view name) {
  const assign::StorageDescriptor* found = assign::find_storage(std::string(name));
  if (found == nullptr) throw Error("", "storage", known_names(name, assign::storage_names()));
  return *found;
}

// The parameter of a method that is its number of threads; null: it has one thread.
const assign::ParamSpec* threads_param(const assign::AssignerDescriptor& method) {
  for (const assign::ParamSpec& spec : method.params)
    if (spec.is_thread_count) return &spec;
  return nullptr;
}

std::vector<std::string> threaded_methods() {
  std::vector<std::string> names;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors())
    if (threads_param(*method) != nullptr) names.push_back(method->name);
  return names;
}

// "frustum, distance"
std::string kinds_of(const assign::AssignerDescriptor& method) {
  std::vector<std::string> names;
  for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::distance, grid::Kind::cascades, grid::Kind::world})
    if (method.takes(kind)) names.push_back(grid::kind_name(kind));
  return joined(names);
}

assign::Params method_params(const assign::AssignerDescriptor& method, const Settings& settings) {
  const assign::ParamSpec* const threads = threads_param(method);
  if (settings.threads != 1 && threads == nullptr)
    throw Error("", "threads",
                "is " + std::to_string(settings.threads) + "; allowed: 1, since " + method.name +
                    " works on one thread; those that share a frame: " + joined(threaded_methods()));
  if (threads != nullptr)
    assign::Params(std::span(threads, 1), {{threads->name, static_cast<double>(settings.threads)}});
  std::vector<Parameter> given(settings.method_parameters.begin(), settings.method_parameters.end());
  for (const Parameter& parameter : given)
    if (threads != nullptr && parameter.name == threads->name)
      throw Error("", "method_parameters",
                  "have '" + threads->name + "', which Settings::threads gives; allowed: the other parameters of " +
                      method.name);
  if (threads != nullptr) given.emplace_back(threads->name, settings.threads);
  return params_of("method_parameters", method.params, given);
}

std::unique_ptr<assign::Storage> made_storage(const Settings& settings) {
  if (settings.storage.empty()) return nullptr;
  const assign::StorageDescriptor& row = storage_named(settings.storage);
  return row.make(params_of("storage_parameters", row.params, settings.storage_parameters));
}

// Whether a sample's lights depend on its cell of the grid, or on the tile of that cell.
bool has_lists_of_cells(const assign::AssignerDescriptor& method, const assign::LightStructure& structure) {
  const bool has_slices_of_its_own = method.name == "tile-slices";  // of each tile, where the grid's cells are others
  return structure.has_cells() && !has_slices_of_its_own;
}

void check_own(const assign::AssignerDescriptor& method, const assign::LightStructure& own, const Settings& settings) {
  if (!settings.storage.empty())
    throw Error("", "storage", "is given, and " + method.name + " leaves a structure of its own; allowed: none");
  if (settings.wants_lists_of_structures && !has_lists_of_cells(method, own))
    throw Error("", "wants_lists_of_structures",
                "is true, and " + method.name + " has no lists of the grid's cells; allowed: false");
}

// Lists of tiles become those of all slices of cells.
void repeat_in_slices(std::uint32_t cell_count, assign::Lists& lists) {
  const std::size_t tiles = lists.cell_count(), pairs = lists.lights.size();
  if (tiles == cell_count) return;
  const std::size_t slices = cell_count / tiles;
  check_memory("pairs of light lists", pairs * slices, sizeof(std::uint32_t));
  assign::check_pair_count(pairs * slices);
  lists.lights.resize(pairs * slices);
  for (std::size_t i = pairs; i < lists.lights.size(); ++i) lists.lights[i] = lists.lights[i - pairs];
  lists.begin.resize(std::size_t{cell_count} + 1);
  for (std::size_t cell = tiles + 1; cell < lists.begin.size(); ++cell)
    lists.begin[cell] = lists.begin[cell - tiles] + static_cast<std::uint32_t>(pairs);
}

// The methods on this kind of grid of which `takes` holds.
template <class Takes>
std::string methods_on(grid::Kind kind, Takes&& takes) {
  std::vector<std::string> names;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors())
    if (method->takes(kind) && takes(*method)) names.push_back(method->name);
  return names.empty() ? "none" : joined(names);
}

// `takes`: the member of a descriptor that tells whether a method takes lights of this type.
void check_lights(const assign::AssignerDescriptor& method, grid::Kind kind, const char* type, bool is_given,
                  bool assign::AssignerDescriptor::*takes) {
  if (!is_given || method.*takes) return;
  refuse(std::string("lights.") + type,
         "are given, and " + method.name + " takes none; methods on a " + grid::kind_name(kind) + " grid that do: " +
             methods_on(kind, [&](const assign::AssignerDescriptor& other) { return other.*takes; }));
}

void check_lights(const assign::AssignerDescriptor& method, grid::Kind kind, const Lights& lights) {
  using Row = assign::AssignerDescriptor;
  check_lights(method, kind, "points", !lights.points.empty(), &Row::points);
  check_lights(method, kind, "spots", !lights.spots.empty(), &Row::spots);
  check_lights(method, kind, "boxes", !lights.boxes.empty(), &Row::boxes);
}

bool are_equal(const view::LightRanges& a, const view::LightRanges& b) {
  return a.points.count == b.points.count && a.spots.count == b.spots.count && a.boxes.count == b.boxes.count;
}

std::size_t kept_by(const view::LightArrays& a) {
  return bytes_of(a.x, a.y, a.z, a.radius, a.reach, a.axis_x, a.axis_y, a.axis_z, a.cos_angle, a.sin_angle,
                  a.half_axes);
}

std::size_t kept_by(const grid::Grid& grid) {
  if (const auto* screen = std::get_if<grid::ScreenGrid>(&grid.shape))
    return bytes_of(screen->tiles.x, screen->tiles.y, screen->slices.boundaries);
  if (const auto* world = std::get_if<grid::WorldGrid>(&grid.shape)) return bytes_of(world->x, world->y, world->z);
  return 0;  // cascades are a few numbers
}

std::size_t kept_by(const assign::ShaderBuffers& shader) {
  std::size_t bytes = bytes_of(shader.words);
  for (const auto* buffers : {&shader.buffers, &shader.former})
    for (const assign::ShaderBuffers::Buffer& buffer : *buffers) bytes += bytes_of(buffer.bytes);
  return bytes;
}

// 0 if there is no memory for the answer.
assign::StructureUse use_of(const assign::LightStructure& structure) {
  try {
    return structure.use();
  } catch (...) {
    return {};
  }
}

template <class Row>
std::vector<std::string_view> names_of(std::span<const Row* const> rows) {
  std::vector<std::string_view> names;
  for (const Row* row : rows) names.push_back(row->name);
  return names;
}

}  // namespace

struct LightLists::State {
  const assign::AssignerDescriptor* method = nullptr;  // null: not started
  grid::GridSpec spec;
  bool wants_lists = false;  // of a structure
  std::optional<LentThreads> lent;
  std::unique_ptr<assign::ListAssigner> list_method;
  std::unique_ptr<assign::StructureAssigner> structure_method;  // or this one
  std::unique_ptr<assign::Storage> storage;                     // null: none
  std::unique_ptr<assign::LightStructure> own;                  // of structure_method

  // Of the last build; without a value the next frame builds.
  std::optional<grid::GridInputs> inputs;
  grid::Grid grid;
  assign::LightKinds kinds{false, false};
  view::LightRanges stored;  // lights that the storage was started for
  std::uint64_t builds = 0;

  view::Frame frame;
  view::LightArrays arrays;
  depth::DepthImage depths;
  assign::Lists lists;
  assign::ShaderBuffers shader;
  std::vector<Buffer> buffers;
  std::size_t unshown_bytes = 0;  // of a structure without buffers: of its fullest frame
  std::string problem;
  const char* short_problem = "";  // where there is no memory for a text

  SharedThreads* threads() { return lent ? &*lent : nullptr; }
  assign::Assigner& assigner() const {
    if (list_method) return *list_method;
    return *structure_method;
  }
  const assign::LightStructure* structure() const { return own ? own.get() : storage.get(); }

  void start(const Settings& settings);
  void make_method(const Settings& settings);
  void update(const View& view, const Lights& lights);
  void check_projection(const View& view) const;
  void prepare_grid();
  void build(const grid::GridInputs& now, const assign::LightKinds& wanted);
  void prepare_storage();
  void start_storage();
  void assign();
  void show_buffers();
  void forget_frame();
  std::size_t memory_bytes() const;

  // Whether `work` did not fail.
  template <class Work>
  bool tried(Work&& work) noexcept {
    problem.clear();
    short_problem = "";
    const NearestRoundingScope rounding;
    try {
      const SharedThreadsScope lend(threads());
      work();
      return true;
    } catch (const std::bad_alloc&) {
      short_problem = "there is not enough memory";
    } catch (const Error& error) {
      keep_problem(error);
    } catch (const std::exception& error) {
      keep_problem(error.what());
    }
    forget_frame();
    return false;
  }
  void keep_problem(const Error& error) noexcept {
    try {
      problem = text_for_engines(error);
    } catch (...) {
      short_problem = "there is not enough memory";
    }
  }
  void keep_problem(const char* text) noexcept {
    try {
      problem = text;
    } catch (...) {
      short_problem = "there is not enough memory";
    }
  }
};

void LightLists::State::start(const Settings& settings) {
  *this = State();
  const assign::AssignerDescriptor& wanted = method_named(settings.method);
  const grid::Kind kind = kind_of(settings.grid);
  if (!wanted.takes(kind))
    throw Error("", "grid.kind",
                std::string("is ") + grid::kind_name(kind) + ", on which " + wanted.name +
                    " does not work; allowed: " + kinds_of(wanted));
  spec = grid_spec_of(settings.grid, wanted.orthographic);
  if (settings.jobs.run != nullptr) lent.emplace(settings.jobs);
  wants_lists = settings.wants_lists_of_structures;
  const SharedThreadsScope lend(threads());
  method = &wanted;
  make_method(settings);
}

void LightLists::State::make_method(const Settings& settings) {
  const assign::Params params = method_params(*method, settings);
  if (const std::string reason = assign::unavailability(*method, params); !reason.empty())
    throw Error("", "method", method->name + " cannot run here: " + reason);
  if (settings.storage.empty() && !settings.storage_parameters.empty())
    throw Error("", "storage_parameters", "are given, and storage is not; allowed: none");
  if (method->make != nullptr) {
    list_method = method->make(params);
    storage = made_storage(settings);
    return;
  }
  structure_method = method->make_own(params);
  own = structure_method->make_structure();
  check_own(*method, *own, settings);
}

void LightLists::State::update(const View& view, const Lights& lights) {
  if (method == nullptr) throw Error("", "update", "was called before a start() that did not fail");
  check_lights(*method, spec.kind, lights);
  set_camera(view, frame);
  check_grid_in_view(spec, view);
  check_projection(view);
  set_lights(lights, frame);
  if (method->needs.depth) set_depths(view, depths);
  prepare_grid();
  prepare_storage();
  assign();
  show_buffers();
}

void LightLists::State::check_projection(const View& view) const {
  if (!view.is_orthographic || method->orthographic) return;
  refuse("view.is_orthographic",
         "is true, and " + method->name + " takes perspective cameras only; methods on a " +
             grid::kind_name(spec.kind) + " grid that take both: " +
             methods_on(spec.kind, [](const assign::AssignerDescriptor& other) { return other.orthographic; }));
}

// Builds if the projection changed, or if there is a light of a kind that the last build did not know.
void LightLists::State::prepare_grid() {
  const view::LightRanges now_there = frame.ranges();
  const grid::GridInputs now = grid::grid_inputs(spec, frame, 0.0, Vec3d(0.0), Vec3d(0.0));
  const assign::LightKinds wanted{kinds.spots || !now_there.spots.empty(), kinds.boxes || !now_there.boxes.empty()};
  if (inputs == now && wanted.spots == kinds.spots && wanted.boxes == kinds.boxes) return;
  build(now, wanted);
}

void LightLists::State::build(const grid::GridInputs& now, const assign::LightKinds& wanted) {
  inputs.reset();
  grid = made_grid(spec, now);
  kinds = wanted;
  assigner().build(grid, kinds);
  ++builds;
  stored = {};
  start_storage();
  inputs = now;
}

void LightLists::State::prepare_storage() {
  if (!are_equal(stored, frame.ranges())) start_storage();
}

// A storage's errors name its parameters.
void LightLists::State::start_storage() {
  try {
    if (storage) storage->start(grid, frame.ranges());
  } catch (const Error& error) {
    if (error.where() == "limits.memory_mib") throw;
    refuse("storage_parameters: " + error.where(), error.message());
  }
  stored = frame.ranges();
}

void LightLists::State::assign() {
  view::fill_lights_in(frame, grid::space_of(grid, frame), arrays);
  const assign::FrameInput input{frame, arrays, method->needs.depth ? &depths : nullptr};
  if (list_method) {
    list_method->assign(input, lists);
    if (storage) storage->store(lists);
    return;
  }
  structure_method->assign(input, *own);
  if (!wants_lists) return;
  own->expand(lists);
  repeat_in_slices(grid.cell_count(), lists);
}

void LightLists::State::show_buffers() {
  if (structure() == nullptr) return;
  if (!structure()->fill_shader_buffers(shader)) {
    unshown_bytes = std::max<std::size_t>(unshown_bytes, use_of(*structure()).upload_bytes);
    return;
  }
  buffers.clear();
  for (const assign::ShaderBuffers::Buffer& buffer : shader.buffers)
    buffers.push_back({buffer.name, buffer.element_bytes, buffer.bytes});
}

// After a failure in any step; the next frame builds.
void LightLists::State::forget_frame() {
  lists.begin.clear();
  lists.lights.clear();
  buffers.clear();
  inputs.reset();
}

LightLists::LightLists() noexcept = default;
LightLists::~LightLists() = default;
LightLists::LightLists(LightLists&&) noexcept = default;
LightLists& LightLists::operator=(LightLists&&) noexcept = default;

std::size_t LightLists::State::memory_bytes() const {
  std::size_t bytes = kept_by(arrays) + kept_by(grid) + 2 * kept_by(shader) + unshown_bytes;
  bytes += bytes_of(frame.lights, depths.nearest, lists.begin, lists.lights, buffers);
  if (builds > 0) bytes += assigner().scratch_bytes();
  return bytes;
}

bool LightLists::make_state() noexcept {
  if (!state_) state_.reset(new (std::nothrow) State);
  has_no_memory_ = !state_;
  return !has_no_memory_;
}

bool LightLists::start(const Settings& settings) noexcept {
  if (!make_state()) return false;
  const bool is_started = state_->tried([&] { state_->start(settings); });
  if (!is_started) state_->method = nullptr;
  return is_started;
}

bool LightLists::update(const View& view, const Lights& lights) noexcept {
  return make_state() && state_->tried([&] { state_->update(view, lights); });
}

std::string_view LightLists::error() const noexcept {
  if (!state_) return has_no_memory_ ? "there is not enough memory" : "";
  return *state_->short_problem != '\0' ? std::string_view(state_->short_problem) : std::string_view(state_->problem);
}

Cells LightLists::cells() const noexcept {
  if (!state_ || !state_->inputs) return {};
  const Vec3i cells = state_->grid.cells();
  return {cells.x, cells.y, cells.z};
}

std::span<const std::uint32_t> LightLists::begins() const noexcept {
  return state_ ? std::span<const std::uint32_t>(state_->lists.begin) : std::span<const std::uint32_t>();
}

std::span<const std::uint32_t> LightLists::light_indices() const noexcept {
  return state_ ? std::span<const std::uint32_t>(state_->lists.lights) : std::span<const std::uint32_t>();
}

std::span<const std::uint32_t> LightLists::of(std::uint32_t cell) const noexcept {
  if (!state_ || std::size_t{cell} + 1 >= state_->lists.begin.size()) return {};
  return state_->lists.of(cell);
}

std::int64_t LightLists::cell_at(float pixel_x, float pixel_y, float depth) const noexcept {
  const bool is_point = std::isfinite(pixel_x) && std::isfinite(pixel_y) && std::isfinite(depth);
  if (!is_point || !state_ || !state_->inputs) return -1;
  const view::Frame& frame = state_->frame;
  if (!frame.projection.orthographic && !(depth > 0.0f)) return -1;  // behind the eye
  const view::PictureRay ray = view::picture_ray(frame, {static_cast<double>(pixel_x), static_cast<double>(pixel_y)});
  const Vec3d at = ray.at(static_cast<double>(depth));
  const Mat3d& rotation = frame.view_space.rotation;
  const Vec3d from_eye{dot(rotation[0], at), dot(rotation[1], at), dot(rotation[2], at)};
  return grid::lookup(state_->grid, {pixel_x, pixel_y, Vec3f(at), from_eye, frame.view_space.origin});
}

Lookup LightLists::lookup() const noexcept {
  if (!state_ || !state_->inputs || !state_->grid.has_tiles()) return {};
  const grid::ScreenGrid& screen = state_->grid.screen();
  const grid::SliceLookup& slices = screen.slices.lookup;
  return {screen.tiles.scale_x,
          screen.tiles.scale_y,
          static_cast<Lookup::Form>(slices.form),
          slices.scale,
          slices.bias,
          slices.first_m,
          slices.first_slice,
          screen.slices.boundaries};
}

std::span<const Buffer> LightLists::buffers() const noexcept {
  return state_ ? std::span<const Buffer>(state_->buffers) : std::span<const Buffer>();
}

std::uint64_t LightLists::dropped_pairs() const noexcept {
  return state_ && state_->inputs && state_->storage ? use_of(*state_->storage).dropped_pairs : 0;
}

std::size_t LightLists::memory_bytes() const noexcept {
  return state_ ? state_->memory_bytes() : 0;
}

std::uint64_t LightLists::builds() const noexcept {
  return state_ ? state_->builds : 0;
}

std::span<const std::string_view> methods() noexcept {
  static const std::vector<std::string_view> names = names_of(assign::assigner_descriptors());
  return names;
}

std::span<const std::string_view> storages() noexcept {
  static const std::vector<std::string_view> names = names_of(assign::storage_descriptors());
  return names;
}

void set_memory_limit(std::uint64_t bytes) noexcept {
  clusterbench::set_memory_limit(bytes);
}

const char* version() noexcept {
  return CLUSTERBENCH_LIBRARY_VERSION;
}

}  // namespace clusterbench::library
