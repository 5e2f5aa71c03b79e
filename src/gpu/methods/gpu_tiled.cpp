// On the device: a group per tile finds the range of its pixels' depths and a mask of the parts with pixels, another
// one tests all lights against the tile between these depths; a bit for each, from which lists are made.
#include <bit>

#include "assign/bounds/tile_planes.h"
#include "assign/occupied/occupied_method.h"
#include "gpu/methods/descriptors.h"
#include "gpu/methods/device_lists.h"

namespace clusterbench::gpu {
namespace {

// Bits of the modes of tile_depths and tile_lights. Masks are widened where the device may round either way: the host
// says which depths are in a part.
enum DepthMode : std::uint32_t { with_mask = 1, widened_mask = 2, appends = 4 };
enum TileMode : std::uint32_t { planes = 1, boxes = 2, depth_mask = 4, widened = 8, occupied = 16 };

bool takes_occupied_tiles(const assign::Params& params) {
  return params.text("tiles") == "occupied";
}

std::uint32_t depth_mode_of(const assign::Params& params, const DeviceFacts& facts) {
  const std::uint32_t queue = takes_occupied_tiles(params) ? DepthMode::appends : 0u;
  if (!params.flag("depth_mask")) return queue;
  return queue | DepthMode::with_mask | (facts.rounds_to_nearest ? 0u : DepthMode::widened_mask);
}

std::uint32_t mode_of(const assign::Params& params, const DeviceFacts& facts) {
  const std::string& test = params.text("test");
  return (test != "aabb" ? TileMode::planes : 0u) | (test != "planes" ? TileMode::boxes : 0u) |
         (params.flag("depth_mask") ? TileMode::depth_mask : 0u) | (facts.rounds_to_nearest ? 0u : TileMode::widened) |
         (takes_occupied_tiles(params) ? TileMode::occupied : 0u);
}

// The lists of the tiles of a frame, with the depths on the device.
class TileLists final : public MaskLists {
 public:
  explicit TileLists(const assign::Params& params)
      : MaskLists(params),
        takes_occupied_tiles_(takes_occupied_tiles(params)),
        depths_(kernel("tile_depths", k_pixel_group, depth_mode_of(params, device().facts()))),
        lights_(kernel("tile_lights", k_light_group, mode_of(params, device().facts()))) {
    frame().take_boxes();
  }

  // After build(), which gets `tiles_only`: the tiles of this grid with one slice.
  void start(const grid::ScreenGrid& grid, const grid::ScreenGrid& tiles_only) {
    const grid::Tiles& tiles = grid.tiles;
    frame().cull(tiles_only);
    picture_ = tiles.viewport;
    assign::PixelDepths pixels;
    pixels.build(grid);
    std::vector<Side> sides;
    add_sides(tiles.x, tiles.orthographic, pixels.column_begins(), sides);
    add_sides(tiles.y, tiles.orthographic, pixels.row_begins(), sides);
    buffers().reserve(Binding::depths, picture_bytes(), "depths of pixels");
    buffers().reserve(Binding::tile_sides, bytes_of(sides), "sides of tiles");
    buffers().reserve(Binding::tiles, std::uint64_t{tile_count()} * 4 * k_record, "tiles");
    if (takes_occupied_tiles_)
      buffers().reserve(Binding::tile_queue, k_queue_head + std::uint64_t{tile_count()} * sizeof(std::uint32_t),
                        "tiles with a surface");
    Commands commands(device(), buffers());
    commands.upload(Binding::tile_sides, sides.data(), bytes_of(sides));
    record_empty_queue(commands);
    commands.run();
  }

  // Not timed: a GPU has them of its depth prepass.
  void upload(const depth::DepthImage& image) {
    Commands commands(device(), buffers());
    commands.upload(Binding::depths, image.nearest.data(), picture_bytes());
    commands.run();
  }

  // For frames without lights, which assign() leaves out.
  void find_tiles() {
    Commands commands(device(), buffers());
    commands.barrier();  // behind upload()
    record_depths(commands, frame().arguments());
    commands.barrier();
    record_empty_queue(commands);
    commands.run();
  }

  // Of the last assign() or find_tiles(). Returns the time of the readback.
  double read_tiles(assign::FrameCells& out) {
    Commands commands(device(), buffers());
    commands.mark();
    commands.download(Binding::tiles, std::uint64_t{tile_count()} * k_record);
    commands.run();
    const auto words = commands.downloaded(0);
    out.depths.clear(tile_count());
    out.masks.assign(tile_count(), 0);
    for (std::size_t tile = 0; tile < tile_count(); ++tile) {
      out.depths.lo[tile] = std::bit_cast<float>(words[4 * tile]);
      out.depths.hi[tile] = std::bit_cast<float>(words[4 * tile + 1]);
      out.masks[tile] = words[4 * tile + 2];
    }
    return commands.ns_between(0, 1);
  }

  std::uint64_t lights_in_view() { return frame().lights_in_view(); }

 private:
  static constexpr std::uint32_t k_pixel_group = 256, k_light_group = 64;
  static constexpr std::uint64_t k_record = 16, k_queue_head = 16;  // bytes

  // As in tile.glsl.
  struct Side {
    float boundary, across, along;
    std::uint32_t pixel;
  };

  static void add_sides(const std::vector<float>& boundaries, bool is_orthographic,
                        const std::vector<std::uint32_t>& pixels, std::vector<Side>& out) {
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
      const assign::TilePlane plane = assign::tile_plane(boundaries[i], is_orthographic);
      out.push_back({boundaries[i], plane.across, plane.along, pixels[i]});
    }
  }

  Device& device() { return frame().device(); }
  std::uint32_t tile_count() { return frame().arguments().cells; }
  std::uint64_t picture_bytes() const { return std::uint64_t(picture_.x) * std::uint64_t(picture_.y) * sizeof(float); }

  FrameArguments of_tiles(FrameArguments arguments) const {
    arguments.picture_width = static_cast<std::uint32_t>(picture_.x);
    return arguments;
  }
  void record_depths(Commands& commands, const FrameArguments& arguments) {
    commands.dispatch(depths_, of_tiles(arguments), arguments.cells);
  }
  void record_masks(Commands& commands, const FrameArguments& arguments) override {
    commands.fill(Binding::masks, 0, mask_bytes(arguments));
    record_depths(commands, arguments);
    if (takes_occupied_tiles_) {
      commands.barrier(Commands::Barrier::before_indirect);
      commands.dispatch_indirect(lights_, of_tiles(arguments), Binding::tile_queue);
    } else {
      commands.barrier();
      commands.dispatch(lights_, of_tiles(arguments), arguments.cells);
    }
  }
  // For the next run: before the tiles' depths this would be a step of its own.
  void record_beside_counts(Commands& commands) override { record_empty_queue(commands); }
  void record_empty_queue(Commands& commands) const {
    if (takes_occupied_tiles_) commands.fill(Binding::tile_queue, 0, k_queue_head);
  }
  std::uint64_t tests_of(const FrameArguments&) const override { return 0; }  // Tiled knows how many tiles are tested

  bool takes_occupied_tiles_;
  Kernel depths_, lights_;
  Vec2i picture_{0, 0};
};

class Tiled final : public assign::AssignerOf<assign::OccupiedLists> {
 public:
  explicit Tiled(const assign::Params& params)
      : bounds_(params.flag("depth_mask") ? assign::CellBounds::masked_tile : assign::CellBounds::tile),
        tile_lists_(params) {}

  void build(const grid::Grid& grid, const assign::LightKinds& kinds) override {
    grid_ = &grid;
    tiles_ = assign::tiles_of(grid);
    tile_lists_.build(tiles_, kinds);
    tile_lists_.start(grid.screen(), tiles_.screen());
  }
  std::uint64_t tests_done() const override { return tests_; }
  std::vector<assign::ShaderStatistic> shader_statistics() const override { return tile_lists_.shader_statistics(); }
  const assign::DeviceSpans* device_spans() const override { return &spans_; }
  void repeat_on_device(const assign::DeviceRepeats& repeats) override { tile_lists_.repeat_on_device(repeats); }
  double device_floor_ns() override { return tile_lists_.device_floor_ns(); }
  std::size_t scratch_bytes() const override {
    return tile_lists_.scratch_bytes() + frame_cells_.capacity_bytes() + bytes_of(lists_.begin, lists_.lights);
  }

 protected:
  void fill(const assign::FrameInput& input, assign::OccupiedLists& out) override {
    tile_lists_.upload(assign::checked(input.depth, grid_->screen().tiles));
    tile_lists_.assign(input, lists_);
    const bool has_lights = input.lights.size() > 0;
    if (!has_lights) tile_lists_.find_tiles();
    spans_ = *tile_lists_.device_spans();
    spans_.readback_ns += tile_lists_.read_tiles(frame_cells_);
    tests_ = has_lights ? occupied_tiles() * tile_lists_.lights_in_view() : 0;
    out.store(*grid_, bounds_, frame_cells_, lists_, input.lights);
  }

 private:
  std::uint64_t occupied_tiles() const {
    std::uint64_t count = 0;
    for (std::size_t tile = 0; tile < frame_cells_.depths.size(); ++tile)
      count += frame_cells_.depths.empty(tile) ? 0 : 1;
    return count;
  }

  assign::CellBounds bounds_;
  TileLists tile_lists_;
  const grid::Grid* grid_ = nullptr;
  grid::Grid tiles_;
  assign::FrameCells frame_cells_;
  assign::Lists lists_;
  std::uint64_t tests_ = 0;
  assign::DeviceSpans spans_;
};

std::vector<assign::ParamSpec> params_of_tiles() {
  std::vector<assign::ParamSpec> params{
      {.name = "test",
       .summary =
           "the four planes at the sides of the tile, the box around it between its depths, or both; depth in any case",
       .default_value = std::string("both"),
       .unit = "",
       .choices = {"planes", "aabb", "both"}},
      {.name = "depth_mask",
       .summary =
           "also a mask of 32 parts of each tile's range of depth: a light is listed where it reaches a part with "
           "pixels (2.5D)",
       .default_value = true,
       .unit = "",
       .choices = {}},
      {.name = "tiles",
       .summary = "a group of the lights' tests for each tile, or, by an indirect dispatch, for each tile with a "
                  "surface alone; "
                  "the same lists",
       .default_value = std::string("all"),
       .unit = "",
       .choices = {"all", "occupied"}}};
  for (assign::ParamSpec& param : assign::light_params()) params.push_back(std::move(param));
  return params;
}

}  // namespace

assign::AssignerDescriptor gpu_tiled_descriptor() {
  return {
      .name = "gpu-tiled",
      .summary =
          "on the GPU, a group per tile: the range of its pixels' depths, then all lights against the tile between "
          "them; takes a grid's tiles, its slices do not matter",
      .source =
          "Andersson 2009, Parallel Graphics in Frostbite; Harada 2012, A 2.5D Culling for Forward+; planes and boxes: "
          "Wicked Engine",
      .kinds = {grid::Kind::frustum},
      .boxes = true,
      .needs = {.depth = true},
      .at_surfaces = true,
      .own_lists = true,
      .by_name = true,
      .on_device = true,
      .params = params_of_tiles(),
      .make_own = assign::make_structure_assigner<Tiled>,
      .unavailable = no_device,
  };
}

}  // namespace clusterbench::gpu
