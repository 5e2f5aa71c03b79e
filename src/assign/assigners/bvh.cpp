// A hierarchy over the lights, rebuilt in every frame: sorted along a Morton curve, eight neighbours to a group, eight
// groups to a group of the next level. As a list method, runs of cells query it; as a structure, samples query it.
//
// Roundoffs: a ball's box is off by one roundoff in each of its sides, a sample's position by one. The test of a ball
// against a cell's box has the same error as that of `aabb`, and is the larger one.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "assign/bounds/ball_boxes.h"
#include "assign/bounds/bounds_method.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/lists/radix_sort.h"
#include "core/aligned_vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "geom/single_precision/bounding_volumes.h"

namespace clusterbench::assign {
namespace {

constexpr float k_inf = std::numeric_limits<float>::infinity();
constexpr float k_node_roundoffs = CellAabbs::k_roundoffs;
constexpr std::uint32_t k_width = 8;

// Boxes of neighbours; unused ones are empty.
struct alignas(k_cache_line) Group {
  float lo_x[k_width], lo_y[k_width], lo_z[k_width], hi_x[k_width], hi_y[k_width], hi_z[k_width];

  void set(std::uint32_t at, const geom::Box& box) {
    lo_x[at] = box.lo.x;
    lo_y[at] = box.lo.y;
    lo_z[at] = box.lo.z;
    hi_x[at] = box.hi.x;
    hi_y[at] = box.hi.y;
    hi_z[at] = box.hi.z;
  }
  geom::Box around() const {
    geom::Box box{{lo_x[0], lo_y[0], lo_z[0]}, {hi_x[0], hi_y[0], hi_z[0]}};
    for (std::uint32_t i = 1; i < k_width; ++i) {
      box.lo = glm::min(box.lo, Vec3f(lo_x[i], lo_y[i], lo_z[i]));
      box.hi = glm::max(box.hi, Vec3f(hi_x[i], hi_y[i], hi_z[i]));
    }
    return box;
  }
  // One bit for each box that touches this one.
  std::uint32_t touched(const geom::Box& box) const {
    std::uint32_t touches[k_width];
    for (std::uint32_t i = 0; i < k_width; ++i)
      touches[i] =
          static_cast<std::uint32_t>(static_cast<int>(lo_x[i] <= box.hi.x) & static_cast<int>(hi_x[i] >= box.lo.x) &
                                     static_cast<int>(lo_y[i] <= box.hi.y) & static_cast<int>(hi_y[i] >= box.lo.y) &
                                     static_cast<int>(lo_z[i] <= box.hi.z) & static_cast<int>(hi_z[i] >= box.lo.z));
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < k_width; ++i) bits |= touches[i] << i;
    return bits;
  }
};

constexpr geom::Box k_empty_box{Vec3f(k_inf), Vec3f(-k_inf)};

// The balls of lights of one type.
class Tree {
 public:
  // Level 0 has one box per ball, in the order of their codes; box i of the next level is around group i.
  void build(const RadixSort<std::uint64_t>& by_code, const std::vector<geom::Ball>& balls) {
    const auto count = static_cast<std::uint32_t>(by_code.entries.size());
    order_.resize(count);
    start_levels(count);
    for (std::uint32_t i = 0; i < count; ++i) order_[i] = by_code.entries[i].value;
    for (std::uint32_t i = 0; i < group_count(count) * k_width; ++i)
      groups_[i / k_width].set(i % k_width, i < count ? box_of(balls[order_[i]]) : k_empty_box);
    for (std::size_t level = 1; level < levels_; ++level) {
      const std::uint32_t below = begin_[level] - begin_[level - 1];
      for (std::uint32_t i = 0; i < group_count(below) * k_width; ++i)
        groups_[begin_[level] + i / k_width].set(i % k_width,
                                                 i < below ? groups_[begin_[level - 1] + i].around() : k_empty_box);
    }
  }

  // Calls found(light) for each light whose ball's box touches this one. Returns the number of boxes tested.
  template <class Found>
  std::uint64_t each_touched(const geom::Box& box, Found&& found) const {
    if (order_.empty()) return 0;
    std::uint64_t groups = 0;
    struct ToVisit {
      std::uint32_t level, group;
    };
    std::array<ToVisit, k_most_levels * k_width> to_visit;
    std::size_t count = 0;
    to_visit[count++] = {static_cast<std::uint32_t>(levels_ - 1), 0};
    while (count > 0) {
      const ToVisit at = to_visit[--count];
      ++groups;
      for (std::uint32_t left = groups_[begin_[at.level] + at.group].touched(box); left != 0; left &= left - 1) {
        const std::uint32_t child = at.group * k_width + static_cast<std::uint32_t>(std::countr_zero(left));
        if (at.level == 0)
          found(order_[child]);
        else
          to_visit[count++] = {at.level - 1, child};
      }
    }
    return groups * k_width;
  }

  // The number of stored boxes, including empty ones.
  std::uint64_t boxes() const { return std::uint64_t{order_.empty() ? 0 : begin_[levels_]} * k_width; }
  static std::uint64_t boxes_for(std::uint32_t balls) {
    std::uint64_t groups = 0;
    for (std::uint32_t count = balls; count > 0; count = count > k_width ? group_count(count) : 0)
      groups += group_count(count);
    return groups * k_width;
  }
  std::size_t size() const { return order_.size(); }
  std::span<const Group> groups() const { return {groups_.data(), order_.empty() ? 0 : begin_[levels_]}; }
  std::span<const std::uint32_t> level_begins() const { return {begin_.data(), order_.empty() ? 0 : levels_ + 1}; }
  std::span<const std::uint32_t> order() const { return order_; }
  std::size_t capacity_bytes() const {
    return groups_.capacity() * sizeof(Group) + order_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::size_t k_most_levels = 11;  // 8^11 > 2^32

  static std::uint32_t group_count(std::uint32_t boxes) { return boxes / k_width + (boxes % k_width != 0 ? 1 : 0); }
  static geom::Box box_of(const geom::Ball& ball) { return {ball.center - ball.radius, ball.center + ball.radius}; }

  void start_levels(std::uint32_t count) {
    levels_ = 0;
    begin_[0] = 0;
    for (std::uint32_t boxes = count; boxes > 0; boxes = boxes > k_width ? group_count(boxes) : 0, ++levels_)
      begin_[levels_ + 1] = begin_[levels_] + group_count(boxes);
    check_memory("boxes of a light hierarchy", begin_[levels_], sizeof(Group));
    if (groups_.size() < begin_[levels_]) groups_.resize(begin_[levels_]);
  }

  AlignedVector<Group> groups_;                           // level by level, starting with the balls' own boxes
  std::array<std::uint32_t, k_most_levels + 1> begin_{};  // where each level begins
  std::size_t levels_ = 0;
  std::vector<std::uint32_t> order_;  // the light of each box of level 0
};

struct Trees {
  std::array<Tree, view::k_punctual_types> of_type;

  // Type by type.
  template <class Found>
  std::uint64_t each_touched(const geom::Box& box, Found&& found) const {
    std::uint64_t tests = 0;
    for (const Tree& tree : of_type) tests += tree.each_touched(box, found);
    return tests;
  }
  std::size_t capacity_bytes() const {
    std::size_t bytes = 0;
    for (const Tree& tree : of_type) bytes += tree.capacity_bytes();
    return bytes;
  }
};

// Moves each of these 21 bits to every third bit of the result.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

// Keeps its memory between frames.
class TreeBuilder {
 public:
  explicit TreeBuilder(const Params& params) : test(params, k_node_roundoffs) {}

  // Builds the trees of the lights with volume for which keeps(ball) is true.
  template <class Keeps>
  void build(const view::LightArrays& lights, Keeps&& keeps, Trees& out) {
    balls.resize(lights.size());
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      balls[light] = lights.is_empty(light) ? geom::Ball{} : test.ball(lights, light, k_node_roundoffs);
    const auto types = lights.types();
    for (std::size_t type = 0; type < out.of_type.size(); ++type)
      build_tree(lights, types[type], keeps, out.of_type[type]);
  }

  std::size_t capacity_bytes() const {
    return balls.capacity() * sizeof(geom::Ball) + by_code_.capacity_bytes() + test.capacity_bytes();
  }

  LightTest test;
  std::vector<geom::Ball> balls;  // of the lights

 private:
  template <class Keeps>
  void build_tree(const view::LightArrays& lights, const view::LightRange& range, Keeps&& keeps, Tree& out) {
    by_code_.entries.clear();
    Vec3f lo(k_inf), hi(-k_inf);
    for (std::uint32_t light = range.first; light < range.end(); ++light) {
      if (lights.is_empty(light) || !keeps(balls[light])) continue;
      by_code_.entries.push_back({0, light});
      lo = glm::min(lo, balls[light].center);
      hi = glm::max(hi, balls[light].center);
    }
    const Vec3d origin(lo), extent = Vec3d(hi) - origin;
    const double longest = std::max({extent.x, extent.y, extent.z, 1e-30});
    for (auto& [code, light] : by_code_.entries) {
      constexpr double k_steps = (1 << 21) - 1;
      const Vec3d at = (Vec3d(balls[light].center) - origin) * (k_steps / longest);
      code = spread(static_cast<std::uint64_t>(at.x)) | spread(static_cast<std::uint64_t>(at.y)) << 1 |
             spread(static_cast<std::uint64_t>(at.z)) << 2;
    }
    by_code_.sort();
    out.build(by_code_, balls);
  }

  RadixSort<std::uint64_t> by_code_;
};

// A run of neighbouring cells in a row queries the hierarchy; each cell is then tested against the run's result.
class BvhLists final : public ListAssigner {
 public:
  explicit BvhLists(const Params& params) : builder_(params) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    builder_.test.start_grid(grid, kinds);
    check_memory("boxes around cells", grid.cell_count(), sizeof(geom::Box));
    columns_ = static_cast<std::uint32_t>(grid.cells().x);
    cells_.clear();
    all_ = k_empty_box;
    for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
      cells_.push_back(grid.is_hole(cell) ? k_empty_box : geom::box_around(grid.cell(cell)));
      extend(all_, cells_.back());
    }
    view_.reset();
    if (grid.has_tiles()) view_ = ViewCull(grid.screen());
  }

  void assign(const FrameInput& input, Lists& out) override {
    const view::LightArrays& lights = input.lights;
    builder_.test.start_frame(lights);
    tests_ = lights.size();
    builder_.build(
        lights,
        [&](const geom::Ball& ball) { return geom::ball_touches_box(ball, all_) && !(view_ && view_->misses(ball)); },
        trees_);
    set_cones(lights);
    most_pairs_ = memory_limit() / sizeof(std::uint32_t);
    out.lights.clear();
    out.begin.resize(cells_.size() + 1);
    out.begin[0] = 0;
    for (std::uint32_t cell = 0; cell < cells_.size();) {
      const std::uint32_t end = cell + std::min(k_run, columns_ - cell % columns_);
      find_candidates(cell, end);
      for (; cell < end; ++cell) add_cell(lights, cell, out);
    }
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override {
    return builder_.capacity_bytes() + trees_.capacity_bytes() + candidates_.capacity_bytes() +
           found_.capacity() * sizeof(std::uint32_t) + cells_.capacity() * sizeof(geom::Box) +
           cones_.capacity() * sizeof(geom::SphericalCone);
  }

 private:
  static constexpr std::uint32_t k_run = 8;  // cells

  static void extend(geom::Box& box, const geom::Box& by) {
    box.lo = glm::min(box.lo, by.lo);
    box.hi = glm::max(box.hi, by.hi);
  }

  void set_cones(const view::LightArrays& lights) {
    if (!builder_.test.tests_cones()) return;
    cones_.resize(lights.spots.count);
    for (std::uint32_t spot = 0; spot < lights.spots.count; ++spot)
      cones_[spot] = builder_.test.cone(lights, lights.spots.first + spot);
  }

  void find_candidates(std::uint32_t begin, std::uint32_t end) {
    geom::Box run = k_empty_box;
    for (std::uint32_t cell = begin; cell < end; ++cell) extend(run, cells_[cell]);
    candidates_.clear();
    if (run.lo.x <= run.hi.x)
      tests_ += trees_.each_touched(run, [&](std::uint32_t light) { candidates_.add(light, builder_.balls[light]); });
    if (found_.size() < candidates_.count() + k_most_lanes) found_.resize(candidates_.count() + k_most_lanes);
  }

  void add_cell(const view::LightArrays& lights, std::uint32_t cell, Lists& out) {
    const LightTest& test = builder_.test;
    std::uint32_t count = 0;
    if (cells_[cell].lo.x <= cells_[cell].hi.x) {
      count = candidates_.touching(cells_[cell], found_.data());
      tests_ += candidates_.count();
    }
    if (test.tests_cones() && count > 0 && lights.is_spot(found_[count - 1])) {
      const auto is_missed = [&](std::uint32_t light) {
        return lights.is_spot(light) &&
               !geom::cone_touches_ball(cones_[light - lights.spots.first], test.cell_balls()[cell]);
      };
      count = static_cast<std::uint32_t>(std::remove_if(found_.begin(), found_.begin() + count, is_missed) -
                                         found_.begin());
    }
    const std::uint64_t pairs = out.lights.size() + std::uint64_t{count};
    if (pairs > most_pairs_) check_memory("pairs of light lists", pairs, sizeof(std::uint32_t));
    check_pair_count(pairs);
    if (pairs > out.lights.capacity()) out.lights.reserve(std::min(2 * pairs, most_pairs_));
    out.lights.insert(out.lights.end(), found_.begin(), found_.begin() + count);
    out.begin[cell + 1] = static_cast<std::uint32_t>(pairs);
  }

  TreeBuilder builder_;
  Trees trees_;
  std::uint32_t columns_ = 1;
  std::vector<geom::Box> cells_;
  geom::Box all_{};
  std::optional<ViewCull> view_;
  std::vector<geom::SphericalCone> cones_;  // of the spots
  BallLanes candidates_;                    // of the current run
  std::vector<std::uint32_t> found_;        // of the current cell
  std::uint64_t tests_ = 0, most_pairs_ = 0;
};

// The hierarchy as samples query it: lights whose ball's box contains the sample. Also beyond the grid.
class LightHierarchy final : public LightStructure {
 public:
  Trees trees;
  view::LightRanges ranges;
  std::optional<Vec3d> world_origin;  // of the space of the lights, if it is not view space

  bool lights_at(const grid::Sample& sample, grid::Log2, std::vector<std::uint32_t>& out) const override {
    out.clear();
    trees.each_touched(box_at(sample), [&](std::uint32_t light) { out.push_back(light); });
    return true;
  }
  // Counts all boxes of each visited group, and the light of each box that contains the sample.
  Reads reads_at(const grid::Sample& sample, grid::Log2) const override {
    std::uint64_t lights = 0;
    const std::uint64_t boxes = trees.each_touched(box_at(sample), [&](std::uint32_t) { ++lights; });
    return Reads::of(boxes, k_box_bytes) + Reads::of(lights, sizeof(std::uint32_t));
  }

  StructureUse use() const override {
    const std::vector<BufferNeed> all = buffers();
    StructureUse use;
    use.index_entries = all[0].elements;
    use.index_bytes = use.index_entries * k_box_bytes;
    use.header_bytes = all[1].elements * sizeof(std::uint32_t);
    use.upload_bytes = use.index_bytes + use.header_bytes;
    return use;
  }
  StructureLimit limit() const override {
    std::uint64_t entries = 0;
    for (const view::LightRange& type : ranges.types()) entries += Tree::boxes_for(type.count);
    return {entries, entries * k_box_bytes + std::uint64_t{ranges.size()} * sizeof(std::uint32_t)};
  }
  std::vector<BufferNeed> buffers() const override {
    std::uint64_t boxes = 0, lights = 0;
    for (const Tree& tree : trees.of_type) {
      boxes += tree.boxes();
      lights += tree.size();
    }
    return {{"boxes", k_box_bytes, boxes, limit().index_entries, k_width},
            {"order", sizeof(std::uint32_t), lights, ranges.size()}};
  }
  bool fill_shader_buffers(ShaderBuffers& shader) const override {
    shader.begin_again({.walk = Walk::hierarchy, .looked_up = LookedUp::position});
    std::vector<Group> groups;
    std::vector<std::uint32_t> order;
    for (const Tree& tree : trees.of_type) {
      ShaderBuffers::Tree& levels = shader.trees.emplace_back();
      levels.first_in_order = static_cast<std::uint32_t>(order.size());
      for (const std::uint32_t begin : tree.level_begins())
        levels.level_begins.push_back(begin + static_cast<std::uint32_t>(groups.size()));
      groups.insert(groups.end(), tree.groups().begin(), tree.groups().end());
      order.insert(order.end(), tree.order().begin(), tree.order().end());
    }
    shader.add("boxes", std::span<const Group>(groups), k_box_bytes);
    shader.add("order", std::span<const std::uint32_t>(order));
    return true;
  }
  std::uint32_t index_bits() const override { return 8 * k_box_bytes; }
  bool has_cells() const override { return false; }
  void expand(Lists&) const override {
    throw Error("", "bvh", "has no cells where samples ask the hierarchy", ExitCode::internal);
  }

 private:
  static constexpr std::uint32_t k_box_bytes = sizeof(Group) / k_width;

  geom::Box box_at(const grid::Sample& sample) const {
    const Vec3f at = world_origin ? Vec3f(sample.from(*world_origin)) : sample.view;
    return {at, at};
  }
};

class BvhQueries final : public AssignerOf<LightHierarchy> {
 public:
  explicit BvhQueries(const Params& params) : builder_(params) {}

  void build(const grid::Grid& grid, const LightKinds&) override { world_origin_ = grid.world_origin(); }

  void fill(const FrameInput& input, LightHierarchy& out) override {
    out.ranges = input.lights;
    out.world_origin = world_origin_;
    builder_.build(
        input.lights, [](const geom::Ball&) { return true; }, out.trees);
    tests_ = input.lights.size();
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override { return builder_.capacity_bytes(); }

 private:
  TreeBuilder builder_;
  std::optional<Vec3d> world_origin_;
  std::uint64_t tests_ = 0;
};

}  // namespace

extern const AssignerDescriptor bvh_descriptor;
const AssignerDescriptor bvh_descriptor{
    .name = "bvh",
    .summary =
        "a hierarchy of boxes over Morton-sorted lights, built every frame; asked by each cell's box for lists, or "
        "left for samples to ask",
    .source = "Olsson, Billeter and Assarsson 2012, Clustered Deferred and Forward Shading; van Oosten 2015",
    .kinds = {grid::Kind::frustum, grid::Kind::distance, grid::Kind::cascades, grid::Kind::world},
    .own_without_grid = true,
    .params = light_params(),
    .make = make_list_assigner<BvhLists>,
    .make_own = make_structure_assigner<BvhQueries>,
};

}  // namespace clusterbench::assign
