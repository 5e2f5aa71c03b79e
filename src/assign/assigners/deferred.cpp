// Classic deferred shading: no lists. Each light's ball is drawn over the picture and shades the pixels that pass its
// depth test; each shaded pixel reads the G-buffer and blends into the target. The method counts the cost: pixels drawn
// (tests), pixels shaded (entries), bytes read and written (traffic). A sample's lights are those that shade its pixel.
//
// A pixel whose surface lies in the light is always shaded: that test is padded, the test of the ray against the ball
// is not. Roundoffs: a surface's point, a slope times a depth, is off by 2 of each coordinate, the difference to the
// centre by one; the squared distance and the squared radius by 5 of themselves, so their roots by 2.5.

#include <algorithm>
#include <cmath>
#include <limits>

#include "assign/bounds/cell_bounds.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/occupied/pixel_depths.h"
#include "core/arrays.h"
#include "core/error.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench::assign {
namespace {

constexpr float k_rectangle_roundoffs = 6.0f;

enum class DepthTest { none, back, both };

// Per pixel that is drawn or shaded.
struct PixelBytes {
  std::uint64_t drawn = 0, shaded = 0;
};

struct DrawnLight {
  TestedLight of;
  Vec2i first{0}, last{-1};  // in pixels
  float apex_reach = 0.0f;   // |x| + |y| + |z|
};

// The picture's pixels: the slopes of the rays through their centres, or (orthographic) the positions of these rays.
struct Picture {
  bool orthographic = false;
  float near = 0.0f;
  std::vector<float> x, y;
  std::vector<float> depths;

  Vec2i size() const { return {static_cast<int>(x.size()), static_cast<int>(y.size())}; }
  float depth(int column, int row) const {
    return depths[static_cast<std::size_t>(row) * x.size() + static_cast<std::size_t>(column)];
  }

  void start(const view::Frame& frame, const depth::DepthImage& image) {
    orthographic = frame.projection.orthographic;
    near = static_cast<float>(frame.projection.near_m);
    x.clear();
    y.clear();
    const auto at = [&](double column, double row) {
      const view::PictureRay ray = view::picture_ray(frame, {column, row});
      return orthographic ? ray.from : ray.along;
    };
    for (int column = 0; column < frame.viewport.x; ++column) x.push_back(static_cast<float>(at(column + 0.5, 0.5).x));
    for (int row = 0; row < frame.viewport.y; ++row) y.push_back(static_cast<float>(at(0.5, row + 0.5).y));
    depths = image.nearest;
  }
};

// Tests whether a light shades a pixel.
class PixelTest {
 public:
  // `slack`: the error of a surface's point, relative to the sizes of all coordinates that it is compared with.
  PixelTest(const Picture& picture, const DrawnLight& light, DepthTest test, float slack)
      : picture_(picture),
        light_(light),
        test_(test),
        slack_(slack),
        center_(light.of.ball.center),
        square_(light.of.ball.radius * light.of.ball.radius) {}

  // The depth at which the pixel's ray leaves the ball; less than the near plane's depth if the ray meets no part of
  // the ball beyond the near plane.
  float far_side(float x, float y) const {
    const float missed = -std::numeric_limits<float>::infinity();
    if (picture_.orthographic) {
      const float dx = x - center_.x, dy = y - center_.y, square = square_ - (dx * dx + dy * dy);
      return square >= 0.0f ? std::sqrt(square) - center_.z : missed;
    }
    const Vec3f moment{-center_.y - center_.z * y, center_.z * x + center_.x, center_.x * y - center_.y * x};
    const float length = x * x + y * y + 1.0f, square = square_ * length - dot(moment, moment);
    return square >= 0.0f ? (center_.x * x + center_.y * y - center_.z + std::sqrt(square)) / length : missed;
  }
  // Does the ball, clipped at the near plane, cover the pixel?
  bool is_drawn(float far_side) const { return far_side >= picture_.near; }

  bool is_shaded(float x, float y, float depth, float far_side) const {
    if (!(depth < std::numeric_limits<float>::infinity())) return false;
    if (reaches(picture_.orthographic ? Vec3f{x, y, -depth} : Vec3f{x * depth, y * depth, -depth})) return true;
    if (!is_drawn(far_side) || test_ == DepthTest::both) return false;
    return test_ == DepthTest::none || depth <= far_side;
  }

 private:
  static float dot(const Vec3f& a, const Vec3f& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  bool reaches(const Vec3f& point) const {
    const Vec3f apart = point - center_;
    if (!(dot(apart, apart) <= square_)) return false;
    if (!light_.of.has_cone) return true;
    const float reach = light_.apex_reach + std::abs(point.x) + std::abs(point.y) + std::abs(point.z);
    return geom::cone_touches_ball(light_.of.cone, {point, slack_ * reach});
  }

  const Picture& picture_;
  const DrawnLight& light_;
  DepthTest test_;
  float slack_;
  Vec3f center_;
  float square_;
};

class DrawnLights final : public LightStructure {
 public:
  // A sample has the lights of its pixel, whatever its own depth.
  bool lights_at(const grid::Sample& sample, grid::Log2, std::vector<std::uint32_t>& out) const override {
    out.clear();
    return each_drawn(sample, [&](const DrawnLight& light, bool is_shaded) {
      if (is_shaded) out.push_back(light.of.index);
    });
  }
  // The bytes moved for the pixel, which belong to no buffer of the method: its depth for each light drawn over it, and
  // G-buffer and target for each light that shades it.
  Reads reads_at(const grid::Sample& sample, grid::Log2) const override {
    Reads reads;
    each_drawn(sample, [&](const DrawnLight&, bool is_shaded) {
      reads += Reads::of(1, bytes.drawn) + Reads::of(is_shaded ? 1 : 0, bytes.shaded);
    });
    return reads;
  }

  StructureUse use() const override {
    StructureUse use;
    use.index_entries = shaded;
    use.traffic_bytes = drawn * bytes.drawn + shaded * bytes.shaded;
    return use;
  }
  StructureLimit limit() const override {
    return {std::uint64_t{light_count} * picture.x.size() * picture.y.size(), 0};
  }
  std::vector<BufferNeed> buffers() const override { return {}; }  // drawing needs no buffer
  std::uint32_t index_bits() const override { return 32; }
  bool has_cells() const override { return false; }
  void expand(Lists&) const override { throw Error("", "deferred", "has no cells", ExitCode::internal); }

  DepthTest test = DepthTest::both;
  float slack = 0.0f;
  PixelBytes bytes;
  std::uint32_t light_count = 0;
  std::uint64_t drawn = 0, shaded = 0;  // pixels, summed over all lights
  Picture picture;
  std::vector<DrawnLight> lights;
  Lists rows;  // for each row of pixels its lights, as indices in `lights`

 private:
  // Calls visit(light, is it shading the pixel?) for the lights drawn over the sample's pixel. False if the sample is
  // in no pixel.
  template <class Visit>
  bool each_drawn(const grid::Sample& sample, Visit&& visit) const {
    const Vec2i size = picture.size();
    const auto is_within = [](float at, int pixels) { return at >= 0.0f && at <= static_cast<float>(pixels); };
    if (!is_within(sample.pixel_x, size.x) || !is_within(sample.pixel_y, size.y)) return false;
    if (!picture.orthographic && !(sample.view.z < 0.0f)) return false;
    const int column = std::min(static_cast<int>(sample.pixel_x), size.x - 1),
              row = std::min(static_cast<int>(sample.pixel_y), size.y - 1);
    const float x = picture.x[static_cast<std::size_t>(column)], y = picture.y[static_cast<std::size_t>(row)];
    for (const std::uint32_t at : rows.of(static_cast<std::uint32_t>(row))) {
      const DrawnLight& light = lights[at];
      if (column < light.first.x || column > light.last.x) continue;
      const PixelTest pixel(picture, light, test, slack);
      const float far_side = pixel.far_side(x, y);
      const bool is_shaded = pixel.is_shaded(x, y, picture.depth(column, row), far_side);
      if (is_shaded || pixel.is_drawn(far_side)) visit(light, is_shaded);
    }
    return true;
  }
};

class Deferred final : public AssignerOf<DrawnLights> {
 public:
  explicit Deferred(const Params& params) : light_test_(params, k_rectangle_roundoffs) {
    const std::string& name = params.text("depth_test");
    test_ = name == "none" ? DepthTest::none : name == "back" ? DepthTest::back : DepthTest::both;
    constexpr std::uint64_t k_depth_bytes = 4;
    bytes_.drawn = k_depth_bytes;
    bytes_.shaded = static_cast<std::uint64_t>(params.number("gbuffer_bytes")) +
                    2 * static_cast<std::uint64_t>(params.number("target_bytes"));
  }

  void build(const grid::Grid& grid, const LightKinds&) override {
    grid::ScreenGrid one_slice = grid.screen();
    one_slice.slices.boundaries = {grid.screen().slices.boundaries.front(), std::numeric_limits<float>::max()};
    tiles_ = {one_slice};
    view_ = ViewCull(one_slice);
    pixels_.build(grid.screen());
  }
  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override { return pixels_.capacity_bytes() + pairs_.capacity_bytes(); }

 protected:
  void fill(const FrameInput& input, DrawnLights& out) override {
    const view::LightArrays& lights = input.lights;
    out.test = test_;
    out.slack = light_test_.padding(k_rectangle_roundoffs) * 0x1p-24f;
    out.bytes = bytes_;
    out.light_count = lights.size();
    out.drawn = out.shaded = 0;
    out.picture.start(input.frame, checked(input.depth, tiles_.screen().tiles));
    out.lights.clear();
    pairs_.start(static_cast<std::uint32_t>(input.frame.viewport.y));
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      if (!lights.is_empty(light)) add_light(lights, light, out);
    pairs_.finish(out.rows);
    tests_ = out.drawn;
  }

 private:
  void add_light(const view::LightArrays& lights, std::uint32_t light, DrawnLights& out) {
    const geom::Ball ball = light_test_.ball(lights, light, k_cell_box_roundoffs);
    if (view_.misses(ball)) return;
    const CellBox box = cell_box(tiles_, ball);
    if (box.empty()) return;
    const auto pixel = [](const std::vector<std::uint32_t>& begins, int tile) {
      return static_cast<int>(begins[static_cast<std::size_t>(tile)]);
    };
    DrawnLight drawn;
    drawn.of = light_test_.tested(lights, light);
    drawn.first = {pixel(pixels_.column_begins(), box.first.x), pixel(pixels_.row_begins(), box.first.y)};
    drawn.last = {pixel(pixels_.column_begins(), box.last.x + 1) - 1, pixel(pixels_.row_begins(), box.last.y + 1) - 1};
    drawn.apex_reach = std::abs(lights.x[light]) + std::abs(lights.y[light]) + std::abs(lights.z[light]);
    const auto rank = static_cast<std::uint32_t>(out.lights.size());
    out.lights.push_back(drawn);
    pairs_.add_row(static_cast<std::uint32_t>(drawn.first.y),
                   static_cast<std::uint32_t>(drawn.last.y - drawn.first.y + 1), rank);
    draw(drawn, out);
  }

  void draw(const DrawnLight& light, DrawnLights& out) const {
    const PixelTest test(out.picture, light, test_, out.slack);
    for (int row = light.first.y; row <= light.last.y; ++row) {
      const float y = out.picture.y[static_cast<std::size_t>(row)];
      for (int column = light.first.x; column <= light.last.x; ++column) {
        const float x = out.picture.x[static_cast<std::size_t>(column)];
        const float far_side = test.far_side(x, y);
        const bool is_shaded = test.is_shaded(x, y, out.picture.depth(column, row), far_side);
        out.drawn += test.is_drawn(far_side) || is_shaded ? 1 : 0;
        out.shaded += is_shaded ? 1 : 0;
      }
    }
  }

  LightTest light_test_;
  DepthTest test_ = DepthTest::both;
  PixelBytes bytes_;
  grid::Grid tiles_;  // with a single slice
  ViewCull view_;
  PixelDepths pixels_;
  PairBuffer pairs_;
  std::uint64_t tests_ = 0;
};

std::vector<ParamSpec> deferred_params() {
  std::vector<ParamSpec> params{
      {.name = "depth_test",
       .summary = "which drawn pixels are shaded: all (none), those in front of the sphere's far side (back), or those "
                  "in it, as "
                  "a stencil of both sides finds them, and of a spot those in its cone (both)",
       .default_value = std::string("both"),
       .unit = "",
       .choices = {"none", "back", "both"}},
      {.name = "gbuffer_bytes",
       .summary = "read for each shaded pixel of each light; four targets of RGBA8",
       .default_value = 16.0,
       .unit = "B",
       .min = 0.0,
       .max = 1024.0,
       .choices = {},
       .whole = true},
      {.name = "target_bytes",
       .summary = "read and written for each shaded pixel of each light; RGBA16F",
       .default_value = 8.0,
       .unit = "B",
       .min = 0.0,
       .max = 1024.0,
       .choices = {},
       .whole = true}};
  for (ParamSpec& param : light_params()) params.push_back(std::move(param));
  return params;
}

}  // namespace

extern const AssignerDescriptor deferred_descriptor;
const AssignerDescriptor deferred_descriptor{
    .name = "deferred",
    .summary =
        "no lists: each light's sphere is drawn over the picture and shades the pixels that pass its depth test; "
        "pixels "
        "and bytes of that are counted, a grid's cells do not matter",
    .source = "Hargreaves and Harris 2004, Deferred Shading; the baseline of Persson 2015",
    .kinds = {grid::Kind::frustum},
    .needs = {.depth = true},
    .at_surfaces = true,
    .draws_lights = true,
    .own_without_grid = true,
    .params = deferred_params(),
    .make_own = make_structure_assigner<Deferred>,
};

}  // namespace clusterbench::assign
