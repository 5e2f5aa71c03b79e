// A state is a world (projection, picture, grid) with lights that touch a chosen cell: a contact on the cell's surface
// and a light against it. Each light is tried at several positions: touching; moved away by some roundoffs (a
// conservative method still lists it: the distance is the margin that the search minimises); and, for methods without
// guarantees, pushed into the cell by parts of its range. Children differ in one number; they stay if their margin is
// no larger. The best worlds have children, too.

#include "stress/lost_light_search.h"

#include <algorithm>
#include <cmath>

#include "assign/contract/method_error.h"
#include "core/clock.h"
#include "core/error.h"
#include "geom/light_meets_cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"
#include "gpu/device/device.h"
#include "measure/truth/truth.h"
#include "os/call_notes.h"
#include "stress/contact.h"

namespace clusterbench::stress {
namespace {

constexpr double k_pi = 3.14159265358979323846;

// Roundoffs (2^-24 of the light's reach) by which a light is moved away from its cell; and parts of its range by which
// it is pushed in.
constexpr double k_away[] = {32, 24, 16, 12, 8, 6, 4, 3, 2, 1};
constexpr double k_into[] = {1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.3};

struct World {
  double near_m, far_ratio, fov_rad, aspect, shift;
  int tiles_x, tiles_y, slices, scheme;
  grid::Kind kind;
};

// A light against a cell: turn picks the generator of a cone.
struct Touch {
  std::uint32_t cell = 0;
  std::uint64_t contact = 0;  // seed of the contact
  double range = 1.0, angle = 0.5, turn = 0.0, along = 0.5;
  bool is_spot = false;
  double nudge = 0.0;  // roundoffs, of the centre, across the contact
};

double log_between(SplitMix64& random, double lo, double hi) {
  return lo * std::exp(random.unit() * std::log(hi / lo));
}

World random_world(SplitMix64& random, const assign::AssignerDescriptor& row) {
  World world{};
  world.near_m = log_between(random, 1e-3, 1.0);
  world.far_ratio = log_between(random, 20.0, 1e7);
  world.fov_rad = log_between(random, 0.01, 3.0);
  world.aspect = log_between(random, 0.2, 5.0);
  world.shift = random.between(-0.9, 0.9);
  world.tiles_x = 1 + static_cast<int>(random.below(14));
  world.tiles_y = 1 + static_cast<int>(random.below(9));
  world.slices = 2 + static_cast<int>(random.below(14));
  world.scheme = static_cast<int>(random.below(3));
  world.kind = row.kinds[random.below(row.kinds.size())];
  return world;
}

World mutated(World world, SplitMix64& random, const assign::AssignerDescriptor& row) {
  const World other = random_world(random, row);
  switch (random.below(7)) {
    case 0:
      world.near_m = other.near_m;
      break;
    case 1:
      world.far_ratio = other.far_ratio;
      break;
    case 2:
      world.fov_rad = other.fov_rad;
      break;
    case 3:
      world.aspect = other.aspect;
      break;
    case 4:
      world.shift = other.shift;
      break;
    case 5:
      world.slices = other.slices;
      break;
    default:
      world.tiles_x = other.tiles_x;
      break;
  }
  return world;
}

Trial trial_of(const World& world) {
  Rig rig;
  rig.projection().yfov_rad = world.fov_rad;
  rig.projection().near_m = world.near_m;
  const double far = world.near_m * world.far_ratio;
  rig.projection().far_m = far;
  const double top = std::tan(world.fov_rad / 2.0), right = top * world.aspect;
  rig.projection().sides = scene::ProjectionSides{-right * (1.0 - world.shift), right * (1.0 + world.shift), -top, top};
  rig.show({1000, std::clamp(static_cast<int>(1000 / world.aspect), 20, 4000)});
  constexpr grid::Scheme k_schemes[] = {grid::Scheme::linear, grid::Scheme::exponential,
                                        grid::Scheme::exponential_first};
  const double first = world.near_m * std::sqrt(world.far_ratio) * 0.5;
  grid::GridSpec spec = frustum_grid({world.tiles_x, world.tiles_y}, k_schemes[world.scheme], world.slices,
                                     world.near_m, far, std::max(first, 1.01 * world.near_m));
  spec.kind = world.kind;
  spec.finest_m = std::ldexp(1.0, static_cast<int>(std::floor(std::log2(far))) - 6);
  spec.levels = 3;
  spec.cells = world.kind == grid::Kind::cascades ? Vec3i{8, 8, 6} : Vec3i{10, 5, 8};
  spec.has_bounds = world.kind == grid::Kind::world;
  spec.bounds_lo_m = Vec3d(-far, -0.3 * far, -far);
  spec.bounds_hi_m = Vec3d(0.7 * far, 0.2 * far, far);
  return rig.on(spec);
}

Touch random_touch(const grid::Grid& grid, SplitMix64& random, double far, bool spots) {
  Touch touch;
  touch.cell = random_cell(grid, random);
  touch.contact = random.next();
  touch.range = log_between(random, 1e-4 * far, 3.0 * far);
  touch.angle = random.below(3) == 0 ? log_between(random, 1e-4, 1.5) : random.between(0.01, 1.56);
  touch.turn = random.between(0.0, 2.0 * k_pi);
  touch.along = random.between(0.0, 0.98);
  touch.is_spot = spots && random.below(3) == 0;
  return touch;
}

Touch mutated(Touch touch, const grid::Grid& grid, SplitMix64& random, double far, bool spots) {
  const Touch other = random_touch(grid, random, far, spots);
  switch (random.below(7)) {
    case 0:
      touch.cell = other.cell;
      break;
    case 1:
      touch.contact = other.contact;
      break;
    case 2:
      touch.range = other.range;
      break;
    case 3:
      touch.range *= 1.0 + random.between(-1e-3, 1e-3);
      break;
    case 4:
      touch.turn = other.turn;
      break;
    case 5:
      touch.along = other.along;
      break;
    default:
      touch.nudge += random.between(-4.0, 4.0);
      break;
  }
  return touch;
}

// Unit vector across n, turned by an angle.
Vec3d across(const Vec3d& n, double turn) {
  const Vec3d other = std::abs(n.x) < 0.7 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  const Vec3d a = glm::normalize(glm::cross(n, other)), b = glm::cross(n, a);
  return std::cos(turn) * a + std::sin(turn) * b;
}

// The light in the grid's space, touching its cell and then moved outward.
scene::WorldLight light_of(const Touch& touch, const Contact& contact, double moved_m) {
  scene::WorldLight light;
  light.range_m = touch.range;
  light.position = contact.point + touch.range * contact.outward;
  if (touch.is_spot) {
    const Vec3d generator = across(contact.outward, touch.turn);
    light.type = scene::LightType::spot;
    light.outer_cone_rad = touch.angle;
    light.direction = glm::normalize(std::cos(touch.angle) * generator + std::sin(touch.angle) * contact.outward);
    light.position = contact.point - touch.along * touch.range * generator;
  }
  light.position += moved_m * contact.outward;
  const double size = glm::length(light.position) + touch.range;
  light.position += touch.nudge * 0x1p-24 * size * across(contact.outward, touch.turn + 0.5 * k_pi);
  return light;
}

// Lights at the positions of one touch, from the farthest away to the deepest in.
class Ladder {
 public:
  explicit Ladder(bool conservative) {
    for (const double roundoffs : k_away) steps_.push_back({roundoffs, 0.0});
    steps_.push_back({-0x1p-16, 0.0});  // certainly touching
    touching_ = steps_.size() - 1;
    if (!conservative)
      for (const double part : k_into) steps_.push_back({0.0, -part});
  }

  std::size_t size() const { return steps_.size(); }
  std::size_t touching() const { return touching_; }
  double roundoffs(std::size_t step) const { return steps_[step].roundoffs; }
  double moved_m(std::size_t step, const Touch& touch, const Contact& contact) const {
    const double reach =
        std::abs(contact.point.x) + std::abs(contact.point.y) + std::abs(contact.point.z) + 2.0 * touch.range;
    return steps_[step].roundoffs * 0x1p-24 * reach + steps_[step].of_range * touch.range;
  }

 private:
  struct Step {
    double roundoffs, of_range;
  };
  std::vector<Step> steps_;
  std::size_t touching_;
};

// One world with its population of touches.
class Climb {
 public:
  Climb(const StressMethod& method, const World& world, const Ladder& ladder)
      : method_(method), ladder_(ladder), trial_(trial_of(world)), run_(method.start()) {
    frame_ = frame_of(trial_);
    grid_ = grid_of(trial_, frame_);
    space_ = grid::space_of(grid_, frame_);
    far_m_ = world.near_m * world.far_ratio;
    if (fits()) run_.build(grid_);
  }

  bool fits() const { return stress::fits(method_, grid_); }

  void start(std::size_t population, SplitMix64& random) {
    touches_.clear();
    for (std::size_t i = 0; i < population; ++i) touches_.push_back(random_touch(grid_, random, far_m_, true));
    lost_steps_ = measured(touches_);
  }

  // One generation. Returns the number of tries.
  std::uint64_t step(SplitMix64& random) {
    std::vector<Touch> children;
    for (const Touch& touch : touches_) children.push_back(mutated(touch, grid_, random, far_m_, true));
    const std::vector<std::size_t> lost = measured(children);
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (lost[i] < lost_steps_[i]) continue;
      touches_[i] = children[i];
      lost_steps_[i] = lost[i];
    }
    return children.size();
  }

  std::size_t best() const { return *std::max_element(lost_steps_.begin(), lost_steps_.end()); }

  // Tests lights that are not listed although they certainly touch, and keeps the deepest true loss.
  void collect(SearchResult& result) const {
    for (std::size_t i = 0; i < touches_.size(); ++i) {
      if (lost_steps_[i] > ladder_.touching()) decide_loss(touches_[i], lost_steps_[i], result);
    }
  }

 private:
  // The number of ladder steps that are not listed, from the outermost in.
  std::vector<std::size_t> measured(const std::vector<Touch>& touches) {
    view::Frame frame = frame_;
    frame.lights.clear();
    for (const bool spots : {false, true})
      for (const Touch& touch : touches)
        if (touch.is_spot == spots) add_lights(touch, frame);
    frame.count_types();
    run_.assign({frame, view::lights_in(frame, space_)});
    lists_ = &run_.cell_lists();

    std::vector<std::size_t> lost(touches.size(), 0);
    std::uint32_t first = 0;
    for (const bool spots : {false, true})
      for (std::size_t i = 0; i < touches.size(); ++i) {
        if (touches[i].is_spot != spots) continue;
        lost[i] = not_listed(touches[i].cell, first);
        first += static_cast<std::uint32_t>(ladder_.size());
      }
    return lost;
  }

  void add_lights(const Touch& touch, view::Frame& frame) const {
    const Contact contact = contact_of(touch);
    for (std::size_t step = 0; step < ladder_.size(); ++step)
      frame.lights.push_back(in_world(light_of(touch, contact, ladder_.moved_m(step, touch, contact))));
  }

  Contact contact_of(const Touch& touch) const {
    SplitMix64 random(touch.contact);
    return random_contact(grid_.cell(touch.cell), random);
  }

  scene::WorldLight in_world(scene::WorldLight light) const {
    light.position = glm::transpose(space_.rotation) * light.position + space_.origin;
    light.direction = glm::transpose(space_.rotation) * light.direction;
    light.rig_index = 0;
    return light;
  }

  std::size_t not_listed(std::uint32_t cell, std::uint32_t first_light) const {
    const auto list = lists_->of(cell);
    for (std::size_t step = ladder_.size(); step > 0; --step)
      if (!std::binary_search(list.begin(), list.end(), first_light + static_cast<std::uint32_t>(step - 1)))
        return step;
    return 0;
  }

  // Decides whether the innermost unlisted light is truly in the cell, and how deep.
  void decide_loss(const Touch& touch, std::size_t lost_steps, SearchResult& result) const {
    const Contact contact = contact_of(touch);
    const scene::WorldLight lost = in_world(light_of(touch, contact, ladder_.moved_m(lost_steps - 1, touch, contact)));
    // As in a scene file: the axis is a node's rotation, rounded.
    Rig rig = rig_of(lost);
    Trial replay = rig.on(trial_.grid, "found by the search");
    replay.viewport = trial_.viewport;
    replay.scene.cameras = trial_.scene.cameras;
    const view::Frame frame = frame_of(replay);
    const geom::LightVolume volume = view::volume_of(frame.lights[0], space_);
    const geom::Verdict verdict = geom::decide_meets(volume, grid_.cell(touch.cell));
    if (verdict == geom::Verdict::no || is_listed(frame, touch.cell)) return;
    if (verdict == geom::Verdict::uncertain) {
      ++result.undecided;
      return;
    }
    ++result.misses;
    const double depth = 1.0 - measure::relative_distance(frame, grid_, touch.cell, 0);
    if (!result.deepest || depth > result.deepest->depth)
      result.deepest = Loss{replay.label, touch.cell, 0, depth, replay};
  }

  static Rig rig_of(const scene::WorldLight& light) {
    Rig rig;
    if (light.type == scene::LightType::spot)
      rig.spot(light.position, light.direction, light.range_m, light.outer_cone_rad);
    else
      rig.point(light.position, light.range_m);
    return rig;
  }

  bool is_listed(const view::Frame& frame, std::uint32_t cell) const {
    assign::AssignerRun run = method_.start();
    run.build(grid_);
    run.assign({frame, view::lights_in(frame, space_)});
    return !run.cell_lists().of(cell).empty();
  }

  const StressMethod& method_;
  const Ladder& ladder_;
  Trial trial_;
  view::Frame frame_;
  grid::Grid grid_;
  view::Space space_;
  double far_m_ = 0.0;
  assign::AssignerRun run_;
  const assign::Lists* lists_ = nullptr;  // of the cells
  std::vector<Touch> touches_;
  std::vector<std::size_t> lost_steps_;
};

class HillClimb : public LostLightSearch {
 public:
  HillClimb(const StressMethod& method, const StressRequest& request)
      : method_(method),
        request_(request),
        ladder_(method.conservative),
        random_(request.seed),
        world_(random_world(random_, *method.assigner)) {
    result_.method = method.label;
  }

  bool is_over() const override { return has_failed() || has_enough(searched_ns_); }
  bool has_failed() const override { return !result_.fault.empty(); }

  double done() const override {
    if (is_over()) return 1.0;
    const double tries = static_cast<double>(result_.tries) / static_cast<double>(request_.tries);
    return request_.seconds > 0.0 ? std::max(tries, 1e-9 * searched_ns_ / request_.seconds) : tries;
  }

  void climb(const std::atomic<bool>& stop) override {
    os::note_setting("--cases '^H31$' --seed " + std::to_string(request_.seed) + ", method " + method_.label);
    const double start = wall_ns();
    try {
      climb_from(start, stop);
    } catch (const assign::MethodError& error) {
      result_.fault = error.message();
    } catch (const gpu::DeviceError& error) {
      if (!stop) result_.fault = error.message();  // a signal leaves a device's work behind
    }
    searched_ns_ += wall_ns() - start;
  }

  SearchResult result() const override {
    SearchResult result = result_;
    // Steps 0 .. best_ - 1 are not listed: the first listed step is the margin.
    result.least_margin = best_ >= ladder_.touching() ? 0.0 : ladder_.roundoffs(best_);
    return result;
  }

 private:
  static constexpr std::size_t k_population = 48;
  static constexpr int k_generations = 24;

  bool has_enough(double searched_ns) const {
    return result_.tries >= request_.tries || (request_.seconds > 0.0 && searched_ns >= 1e9 * request_.seconds);
  }

  void climb_from(double start, const std::atomic<bool>& stop) {
    const World next =
        random_.below(3) == 0 ? random_world(random_, *method_.assigner) : mutated(world_, random_, *method_.assigner);
    Climb climb(method_, next, ladder_);
    result_.tries += k_population;
    if (!climb.fits()) return;
    climb.start(k_population, random_);
    for (int i = 0; i < k_generations && !stop && !has_enough(searched_ns_ + wall_ns() - start); ++i)
      result_.tries += climb.step(random_);
    climb.collect(result_);
    if (climb.best() < best_) return;
    best_ = climb.best();
    world_ = next;
  }

  const StressMethod& method_;
  const StressRequest& request_;
  const Ladder ladder_;
  SplitMix64 random_;
  World world_;           // the best one
  std::size_t best_ = 0;  // steps of the ladder that are not listed there
  double searched_ns_ = 0.0;
  SearchResult result_;
};

}  // namespace

std::unique_ptr<LostLightSearch> lost_light_search(const StressMethod& method, const StressRequest& request) {
  return std::make_unique<HillClimb>(method, request);
}

}  // namespace clusterbench::stress
