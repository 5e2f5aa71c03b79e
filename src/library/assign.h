#pragma once
// Light lists of clustered shading, made in an engine's frame: camera, viewport and lights in, lists or a shader's
// buffers out. Installed as <clusterbench/assign.h>; docs/embedding.md has an example.
//
// Lengths are metres, angles radians. Any right- or left-handed world will do. Nothing here throws, and nothing needs
// RTTI: a function that can fail returns false, and error() is one sentence that names the argument and what is
// allowed. This header needs C++20 and no other library.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace clusterbench::library {

// --- Lights ---

// A ball. position: world, at most 1e15 m from the origin along each axis. range: 0 (off) or more; +inf has no end.
struct PointLight {
  float position[3] = {};
  float range = 0.0f;
};

// The part of a ball in a cone around an axis. direction: from the light, of any length above 0. outer_angle: half the
// cone's opening, 0 to pi/2.
struct SpotLight {
  float position[3] = {};
  float range = 0.0f;
  float direction[3] = {0.0f, 0.0f, -1.0f};
  float outer_angle = 0.0f;
};

// Taken by box-bounds, box-refined, box-separating-axis, brute-force alone, and so on frustum grids.
// A decal or a probe: all center + a * half_axes[0] + b * half_axes[1] + c * half_axes[2] with a, b and c from -1 to 1.
struct Box {
  float center[3] = {};
  float half_axes[3][3] = {};
};

// A frame's lights. Indices in lists count points first, then spots, then boxes, from 0 through all of them.
struct Lights {
  std::span<const PointLight> points{};
  std::span<const SpotLight> spots{};
  std::span<const Box> boxes{};
};

// --- Camera ---

// How an engine writes its matrices.
struct Conventions {
  // The first four numbers are the first column, or the first row, of the matrix M of p' = M p. An engine that writes
  // row vectors, p' = p M, row by row (DirectXMath) has the same numbers as `columns`.
  enum class Order : std::uint8_t { columns, rows };
  // Clip depth at the near and the far plane: Vulkan, Direct3D and Metal; the same with reverse z; OpenGL.
  enum class Depth : std::uint8_t { zero_to_one, one_to_zero, minus_one_to_one };

  Order order = Order::columns;
  Depth depth = Depth::zero_to_one;
  bool looks_along_positive_z = false;  // the view space's camera; otherwise it looks along -z
  bool is_clip_y_down = false;          // Vulkan, unless its viewport or projection is flipped
};

// One camera of one frame.
struct View {
  int width = 0, height = 0;  // of the viewport, in pixels
  double eye[3] = {};
  // The axes of the picture in the world: each product of two axes within 1e-3 of 1 (an axis with itself) or 0. Their
  // numbers are taken as they are.
  double to_right[3] = {1.0, 0.0, 0.0}, to_top[3] = {0.0, 1.0, 0.0}, forward[3] = {0.0, 0.0, -1.0};
  bool is_orthographic = false;  // not with a distance grid, whose shells lie around an eye
  // The sides of the picture: slopes (offset / depth) of a perspective camera, -1e5 to 1e5; metres of an orthographic
  // one, -1e15 to 1e15.
  double left = -1.0, right = 1.0, bottom = -1.0, top = 1.0;
  // near is above 0 for a perspective camera, and at most 1e15 m away; far may be +inf for a perspective camera.
  double near_m = 0.1, far_m = 1000.0;
  // Needed by deferred, explicit, flagged, naive-mask, tile-slices, tiled, tiled-2.5d; others do not
  // look at them: width x height depths along `forward` in metres, row by row from the top left, +inf where there is no
  // surface; 0 or more for a perspective camera.
  std::span<const float> depths{};

  // Sets all but width, height and depths from 16 numbers of the view matrix (world to view: a rotation and a
  // translation, up to 1e-3) and 16 of the projection (perspective or orthographic; off-centre, jittered, reverse and
  // infinite ones, too). Null, or why these matrices are none; then the view is as before.
  [[nodiscard]] const char* set_matrices(const double* world_to_view, const double* projection,
                                         const Conventions& conventions = {}) noexcept;
  [[nodiscard]] const char* set_matrices(const float* world_to_view, const float* projection,
                                         const Conventions& conventions = {}) noexcept;
};

// --- Settings ---

// How space is cut into cells. docs/grids-and-lookups.md has pictures and formulas.
struct Grid {
  enum class Kind : std::uint8_t {
    frustum,   // tiles of the picture x slices of depth
    distance,  // tiles of the picture x shells of distance from the eye
    cascades,  // nested boxes of cubical cells in view space, each level twice the size
    world      // boxes along the world's axes
  };
  enum class Slicing : std::uint8_t {
    linear,
    exponential,
    exponential_first,  // the first slice is near_m..first_m, the others are exponential
    power,              // lambda: 0 linear .. 1 exponential
    list                // boundaries_m
  };

  Kind kind = Kind::frustum;
  // frustum, distance
  int columns = 0, rows = 0;              // tiles across and down the picture; 0: tiles of so many pixels
  int tile_width = 64, tile_height = 64;  // pixels; tiles at the right and the bottom edge are clipped
  Slicing slicing = Slicing::exponential_first;
  int slices = 16;
  double near_m = 0.0, far_m = 0.0;           // 0: the camera's; 0 with `list`
  double first_m = 5.0, lambda = 0.5;         // lambda is 0 to 1; each is looked at where the scheme has one
  std::span<const double> boundaries_m = {};  // of Slicing::list alone: ascending; `slices` is then their number - 1
  // cascades: cells of a level, multiples of 4, 4 and 2. world: cells of the whole box.
  int cells[3] = {16, 16, 16};
  int levels = 5;                     // cascades
  double finest_m = 0.5;              // cascades: edge of the finest cells
  double lo_m[3] = {}, hi_m[3] = {};  // world: the box
};

// A parameter of a method or a storage, by the names of docs/configuration.md.
struct Parameter {
  enum class Type : std::uint8_t { number, text, flag };

  std::string_view name;
  Type type = Type::number;
  double number = 0.0;
  std::string_view text = {};
  bool flag = false;

  Parameter(std::string_view of, double value) : name(of), number(value) {}
  Parameter(std::string_view of, int value) : name(of), number(value) {}
  Parameter(std::string_view of, const char* value) : name(of), type(Type::text), text(value) {}
  Parameter(std::string_view of, bool value) : name(of), type(Type::flag), flag(value) {}
};

// An engine's own threads. run() calls part(context, i) for 0 <= i < count, each once, on any thread at any time, and
// returns after all of them; update() fails if a part was skipped or called twice. Parts throw nothing and wait for
// nothing.
struct JobSystem {
  void* user = nullptr;
  void (*run)(void* user, std::uint32_t count, void (*part)(void* context, std::uint32_t i), void* context) = nullptr;
};

struct Settings {
  Grid grid{};
  std::string_view method = "exact-fast";          // of methods()
  std::span<const Parameter> method_parameters{};  // each once, without the number of threads
  // Writes the lists into buffers as a shader reads them: of storages(). Empty: no buffers. These methods leave a
  // structure of their own in place of lists, and take no storage:
  //   in buffers(): z-binning, tile-ranges, tile-spans, babylon-masks, babylon-as-shipped, tiled, tiled-2.5d, flagged,
  //   explicit, naive-mask;
  //   without buffers: tile-slices, deferred, naive-tile-size.
  // All others make lists, bvh too.
  std::string_view storage = {};
  std::span<const Parameter> storage_parameters{};  // each once; none without a storage
  // Threads that share a frame, 1 to 256; above 1 only for exact-fast. The lists do not depend on them.
  int threads = 1;
  JobSystem jobs{};  // its threads, in place of own ones; `threads` then says how many parts are worth while
  // Also lists per cell of a method that leaves a structure of its own. start() refuses it for those without buffers:
  // their samples depend on more than a cell of the grid. Methods that make lists have them in any case.
  bool wants_lists_of_structures = false;
};

// --- Results ---

struct Cells {
  int x = 0, y = 0, z = 0;
};

// One buffer of a storage or structure, little-endian, ready to be uploaded; docs/methods.md says how shaders read it.
// Those of tiled, tiled-2.5d and naive-mask have a header per tile in place of one per cell.
struct Buffer {
  const char* name = "";            // "indices", "headers", "words"
  std::uint32_t element_bytes = 0;  // of an index, a header, a word
  std::span<const std::byte> bytes{};
};

// What a shader needs to find a cell of a frustum or distance grid; depth is the distance from the eye in a distance
// grid. Outside of the viewport, whose edges are inside, beyond boundaries' last number and, with a perspective camera,
// at 0 or less there is no cell. Otherwise
//   tile = int(pixel * tile_scale), at most the last tile; pixels from the top left
//   slice = 0 where depth < first_m and first_slice is 1
//   slice = 0 in the form `log2` where depth is 0 or less (an orthographic camera's)
//   slice = int(clamp(f(depth) * scale + bias, 0, slices - 1)) for all other depths; bias contains first_slice
//   cell = (slice * rows + row of tiles) * columns + column
// In the form `search` slice is the last of 0 .. slices - 1 whose near boundary is not above depth, or 0.
struct Lookup {
  enum class Form : std::uint8_t {
    linear,  // f(depth) = depth
    log2,    // f(depth) = log2(depth)
    search   // no formula: search the boundaries
  };
  float tile_scale_x = 0.0f, tile_scale_y = 0.0f;
  Form form = Form::search;
  float scale = 0.0f, bias = 0.0f, first_m = 0.0f;
  int first_slice = 0;                  // 1: slice 0 lies before first_m, without a formula
  std::span<const float> boundaries{};  // metres; slices + 1
};

// --- Lists ---

// One camera's lists. An object is used by one thread at a time; different objects are independent. Everything that it
// returns is valid until its next start() or update().
class LightLists {
 public:
  LightLists() noexcept;
  ~LightLists();
  LightLists(LightLists&&) noexcept;
  LightLists& operator=(LightLists&&) noexcept;

  // Once, or again for other settings. Starts threads - 1 threads, unless they are lent. Refuses what would fail in
  // every update().
  [[nodiscard]] bool start(const Settings& settings) noexcept;
  // Every frame. Allocates nothing while viewport, projection and kinds of lights stay the same and there are not more
  // lights, or pairs of cell and light, than ever before (but for the exact decision of a light that touches a cell to
  // within rounding). A new viewport or projection, and the first spot or box, cost a build of the grid. After a
  // failure there are no lists, and the next frame is as any other.
  [[nodiscard]] bool update(const View& view, const Lights& lights) noexcept;
  // Why the last start() or update() returned false; "" if it did not, or there was none. data() ends with a 0.
  std::string_view error() const noexcept;

  Cells cells() const noexcept;
  // The lights of cell c are light_indices()[begins()[c]] .. light_indices()[begins()[c + 1] - 1]: points, then spots,
  // then boxes, each once. c = (z * cells.y + y) * cells.x + x, from the top left near corner. Empty for a method with
  // a structure of its own, unless they are asked for. All cells of a tile have the tile's list where a method has one
  // list per tile.
  std::span<const std::uint32_t> begins() const noexcept;
  std::span<const std::uint32_t> light_indices() const noexcept;
  std::span<const std::uint32_t> of(std::uint32_t cell) const noexcept;
  // The cell of a pixel (from the top left; centres at .5) at a depth along `forward`, in metres; -1: in none.
  std::int64_t cell_at(float pixel_x, float pixel_y, float depth) const noexcept;
  Lookup lookup() const noexcept;  // zeros for cascades and world

  // In the same order every frame; they hold this frame's content and no reserve.
  std::span<const Buffer> buffers() const noexcept;
  // Pairs that the storage had no room for (`fixed`).
  std::uint64_t dropped_pairs() const noexcept;
  // The memory that this object keeps, in bytes, after a failed update() too: lights as given and as converted, grid,
  // depths, lists, the method's own memory, the buffers and as much again for the storage or structure that they are
  // copied from.
  std::size_t memory_bytes() const noexcept;
  // How often the grid was built since start().
  std::uint64_t builds() const noexcept;

 private:
  struct State;
  bool make_state() noexcept;

  std::unique_ptr<State> state_;
  bool has_no_memory_ = false;  // for state_
};

// Names, in the order of docs/methods.md.
std::span<const std::string_view> methods() noexcept;
std::span<const std::string_view> storages() noexcept;

// What lists, buffers and tables may take each, in this process; 4 GiB at first. update() fails before it takes more,
// with an error that names this function.
void set_memory_limit(std::uint64_t bytes) noexcept;

// "0.1.0"
const char* version() noexcept;

}  // namespace clusterbench::library
