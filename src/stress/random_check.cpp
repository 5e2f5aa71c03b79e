// One setting of the random search, with all available checks.

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

#include "core/error.h"
#include "geom/filter/light_filter.h"
#include "geom/light_meets_cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/placement.h"
#include "geom/shapes/verdict.h"
#include "gpu/device/device.h"
#include "measure/samples/shading.h"
#include "measure/truth/truth.h"
#include "stress/random_search.h"
#include "stress/random_setting.h"
#include "stress/stress_run.h"

namespace clusterbench::stress {
namespace {

using geom::Verdict;

// Exact decisions take up to a millisecond: their number for each light of a setting with few lights.
constexpr std::size_t k_decisions_per_setting = 240, k_least_per_light = 4;
constexpr int k_points_per_cell = 12;

// A point of a cell by its position between the sides.
struct PointOf {
  double x, y, z;

  static double mix(double lo, double hi, double t) { return t == 0.0 ? lo : t == 1.0 ? hi : lo + t * (hi - lo); }
  Vec3d operator()(const geom::FrustumCell& c) const {
    const double depth = mix(c.depth0, c.depth1, z), scale = c.orthographic ? 1.0 : depth;
    return {mix(c.x0, c.x1, x) * scale, mix(c.y0, c.y1, y) * scale, -depth};
  }
  Vec3d operator()(const geom::ShellCell& c) const {
    const Vec3d ray{mix(c.x0, c.x1, x), mix(c.y0, c.y1, y), -1.0};
    return (mix(c.distance0, c.distance1, z) / glm::length(ray)) * ray;
  }
  Vec3d operator()(const geom::Box& c) const {
    return {mix(c.lo.x, c.hi.x, x), mix(c.lo.y, c.hi.y, y), mix(c.lo.z, c.hi.z, z)};
  }
};

// Whether a box contains a point, given relative to its middle, by more than a margin on every side. False for boxes
// with almost no volume.
bool box_holds_clearly(const std::array<Vec3d, 3>& half_axes, const Vec3d& from_middle, double margin) {
  const Mat3d axes(half_axes[0], half_axes[1], half_axes[2]);
  const double most = glm::length(half_axes[0]) * glm::length(half_axes[1]) * glm::length(half_axes[2]);
  constexpr double k_least_share = 1e-3;  // of the volume that orthogonal axes would have
  if (!(std::abs(glm::determinant(axes)) > k_least_share * most)) return false;
  const Mat3d inverse = glm::inverse(axes);
  const Vec3d at = inverse * from_middle;
  for (int axis = 0; axis < 3; ++axis) {
    const double a_metre = glm::length(Vec3d(inverse[0][axis], inverse[1][axis], inverse[2][axis]));
    constexpr double k_lost = 1e-9;
    if (!(1.0 - std::abs(at[axis]) > margin * a_metre + k_lost)) return false;
  }
  return true;
}

// Whether the volume contains the point by more than the rounding of double precision.
bool holds_clearly(const geom::LightVolume& volume, const Vec3d& p) {
  const double whole_range = geom::range_of(volume);
  const geom::LocalPoint apex = geom::local_point(geom::source_of(volume));
  const Vec3d v = p - apex.at;
  const double range = std::isinf(whole_range) ? 0.0 : whole_range;  // a point is never close to an infinite range
  const double margin = 1e-12 * (glm::length(p) + glm::length(apex.at) + range) + 4.0 * apex.rounding_error;
  if (const auto* box = std::get_if<geom::BoxVolume>(&volume))
    return box_holds_clearly(box->half_axes, glm::transpose(box->center.rotation) * v, margin);
  if (!(glm::length(v) < whole_range - margin)) return false;
  const auto* spot = std::get_if<geom::SpotVolume>(&volume);
  if (spot == nullptr) return true;
  const Vec3d axis = glm::normalize(spot->apex.rotation * spot->direction);
  const double along = glm::dot(v, axis), across = glm::length(v - along * axis);
  return std::sin(spot->half_angle_rad) * along - std::cos(spot->half_angle_rad) * across > margin;
}

// Like holds_clearly, for a point that a shader looks up in single precision, with an error of up to `margin`.
bool clearly_reaches(const scene::WorldLight& light, const grid::Sample& sample, double margin) {
  const Vec3d apex = light.position - sample.eye, v = sample.from_eye - apex;
  const double distance = glm::length(v);
  margin += 1e-12 * (glm::length(apex) + (std::isinf(light.range_m) ? 0.0 : light.range_m));
  if (!(distance < light.range_m - margin)) return false;
  if (light.type == scene::LightType::box) return box_holds_clearly(light.half_axes_m, v, margin);
  if (light.type != scene::LightType::spot) return true;
  const Vec3d axis = glm::normalize(light.direction);
  const double along = glm::dot(v, axis), across = glm::length(v - along * axis);
  return std::sin(light.outer_cone_rad) * along - std::cos(light.outer_cone_rad) * across > margin;
}

double largest_of(const std::vector<float>& boundaries) {
  return std::max(std::abs(boundaries.front()), std::abs(boundaries.back()));
}

// Pairs as bits.
class PairSet {
 public:
  PairSet(std::uint32_t cells, std::size_t lights) : lights_(lights), bits_(cells * lights) {}
  PairSet(const assign::Lists& lists, std::size_t lights) : PairSet(lists.cell_count(), lights) { add(lists); }
  void add(const assign::Lists& lists) {
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
      for (const std::uint32_t light : lists.of(cell)) bits_[cell * lights_ + light] = true;
  }
  bool has(std::uint32_t cell, std::uint32_t light) const { return bits_[cell * lights_ + light]; }

 private:
  std::size_t lights_;
  std::vector<bool> bits_;
};

std::string pair_text(std::uint32_t cell, std::uint32_t light) {
  return "cell " + std::to_string(cell) + ", light " + std::to_string(light);
}

class SettingCheck {
 public:
  SettingCheck(const Trial& trial, std::span<const StressMethod> methods) : trial_(trial), methods_(methods) {}

  SettingReport run() {
    ++report_.counts.settings;
    ++report_.counts.by_kind[static_cast<std::size_t>(trial_.grid.kind)];
    if (!has_boxes(trial_) &&
        std::none_of(methods_.begin(), methods_.end(), [&](const auto& method) { return is_checked(method); }))
      return std::move(report_);
    try {
      frame_ = frame_of(trial_);
      grid_ = grid_of(trial_, frame_);
      lights_ = view::lights_in(frame_, grid::space_of(grid_, frame_));
    } catch (const Error&) {
      ++report_.counts.refused;
      return std::move(report_);
    }
    if (pair_count() > k_most_setting_pairs) {
      ++report_.counts.refused;
      return std::move(report_);
    }
    truth_ = measure::find_truth(frame_, grid_, 1);
    count();
    if (frame_.lights.empty()) return std::move(report_);
    run_methods();
    if (truth_.undecided > 0)
      add(FaultKind::undecided, "", "the true lists leave " + std::to_string(truth_.undecided) + " pairs undecided", 0,
          lights_.points.count);
    check_truth();
    check_methods();
    check_shading();
    return std::move(report_);
  }

 private:
  struct Answer {
    const StressMethod* method;
    assign::Lists lists;
  };

  bool is_checked(const StressMethod& method) const {
    return method.conservative && !method.assigner->naive && supports_trial(method, trial_) && fits(method, grid_);
  }

  std::uint64_t pair_count() const { return std::uint64_t{grid_.cell_count()} * frame_.lights.size(); }

  void count() {
    SettingCounts& counts = report_.counts;
    counts.points += frame_.ranges().points.count;
    counts.spots += frame_.ranges().spots.count;
    counts.boxes += frame_.ranges().boxes.count;
    counts.pairs += pair_count();
    counts.true_pairs += truth_.lists.pair_count();
    counts.undecided += truth_.undecided;
  }

  void run_methods() {
    for (const StressMethod& method : methods_) {
      if (!is_checked(method)) continue;
      if (method.assigner->needs.depth && method.answer == assign::Answer::structure) {  // its cells are not the grid's
        check_occupied(method);
        continue;
      }
      Answer answer{&method, {}};
      try {
        assign::AssignerRun run = method.start();
        const depth::DepthImage depths = depths_for(*method.assigner, frame_);
        const assign::FrameInput input = input_of(frame_, lights_, depths);
        run.build(grid_);
        run.assign(input);
        answer.lists = run.cell_lists();
        run.assign(input);
        const assign::Lists& filled = run.filled_lists() ? *run.filled_lists() : answer.lists;
        if (!assign::lists_fault(filled, grid_.cell_count(), lights_).empty()) {
          add(FaultKind::lists, method.label, "what it gave are no lists", 0, 0);
          continue;
        }
        if (answer.lists != run.cell_lists())
          add(FaultKind::lists, method.label, "the same frame gave other lists", 0, 0);
      } catch (const std::exception& error) {
        add_error(method, error);
        continue;
      }
      report_.counts.compared_pairs += answer.lists.pair_count();
      answers_.push_back(std::move(answer));
    }
  }

  // Checks a method whose cells are the occupied parts of the grid's cells.
  void check_occupied(const StressMethod& method) {
    const depth::DepthImage depths = depths_for(*method.assigner, frame_);
    try {
      assign::AssignerRun run = method.start();
      run.build(grid_);
      run.assign(input_of(frame_, lights_, depths));
      const assign::Lists& lists = run.cell_lists();
      if (!assign::lists_fault(run.structure()->expanded(), lists.cell_count(), lights_).empty())
        return add(FaultKind::lists, method.label, "what it gave are no lists", 0, 0);
      const grid::OccupiedCells cells = run.structure()->occupied_cells();
      const measure::Truth truth = measure::find_truth(frame_, grid_, cells, 1);
      report_.counts.compared_pairs += lists.pair_count();
      report_.counts.undecided += truth.undecided;
      for (std::uint32_t cell = 0; cell < truth.lists.cell_count(); ++cell)
        for (const std::uint32_t light : truth.lists.of(cell))
          if (!std::ranges::binary_search(lists.of(cell), light) && is_met(light, cells.of(cell)))
            return add(FaultKind::loss, method.label, pair_text(cell, light) + " is true and not listed", cell, light);
    } catch (const std::exception& error) {
      add_error(method, error);
    }
  }

  bool is_met(std::uint32_t light, std::span<const geom::FrustumCell> parts) const {
    return std::ranges::any_of(parts, [&](const geom::FrustumCell& part) {
      return geom::decide_meets(lights_.volume(light), part) == Verdict::yes;
    });
  }

  // Decides again, pair by pair: pairs that the filter or a common point contradicts, pairs that the filter leaves
  // undecided, pairs at the border of the true cells, and further pairs that a method lists.
  void check_truth() {
    const std::size_t lights = frame_.lights.size();
    const PairSet truth(truth_.lists, lights);
    PairSet listed(grid_.cell_count(), lights);
    for (const Answer& answer : answers_) listed.add(answer.lists);
    const std::size_t most = std::max(k_least_per_light, k_decisions_per_setting / lights);
    for (std::uint32_t light = 0; light < lights; ++light) check_light(light, truth, listed, most);
  }

  void check_light(std::uint32_t light, const PairSet& truth, const PairSet& listed, std::size_t most) {
    const geom::LightVolume volume = lights_.volume(light);
    if (!(geom::range_of(volume) > 0.0)) return;
    const geom::LightFilter filter(volume);
    std::vector<std::uint32_t> contradicted, near;
    for (std::uint32_t cell = 0; cell < grid_.cell_count(); ++cell) {
      if (grid_.is_hole(cell)) continue;
      const bool is_true = truth.has(cell, light);
      const bool is_border = listed.has(cell, light) != is_true || has_other_neighbour(cell, light, truth);
      const Verdict verdict = filter.meets(grid_.cell(cell));
      const bool is_contradicted = verdict != Verdict::uncertain && (verdict == Verdict::yes) != is_true;
      if (is_contradicted || (is_border && !is_true && shares_a_point(volume, cell)))
        contradicted.push_back(cell);
      else if (is_border || verdict == Verdict::uncertain)
        near.push_back(cell);
    }
    contradicted.resize(std::min<std::size_t>(contradicted.size(), 20));
    for (const std::uint32_t cell : contradicted) decide_again(cell, light, truth);
    const std::size_t step = std::max<std::size_t>(1, (near.size() + most - 1) / most);
    for (std::size_t i = 0; i < near.size(); i += step) decide_again(near[i], light, truth);
  }

  bool has_other_neighbour(std::uint32_t cell, std::uint32_t light, const PairSet& truth) const {
    const Vec3i n = grid_.cells(), at = grid_.cell_at(cell);
    const std::uint32_t steps[] = {1, static_cast<std::uint32_t>(n.x), static_cast<std::uint32_t>(n.x * n.y)};
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] > 0 && truth.has(cell - steps[axis], light) != truth.has(cell, light)) return true;
      if (at[axis] + 1 < n[axis] && truth.has(cell + steps[axis], light) != truth.has(cell, light)) return true;
    }
    return false;
  }

  // Tests corners, the middle and some points between.
  bool shares_a_point(const geom::LightVolume& volume, std::uint32_t cell) {
    ++report_.counts.sampled;
    const geom::Cell shape = grid_.cell(cell);
    SplitMix64 random(cell);
    for (int i = 0; i < 9 + k_points_per_cell; ++i) {
      PointOf at{0.5, 0.5, 0.5};
      if (i < 8) at = {i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0};
      if (i > 8) at = {random.unit(), random.unit(), random.unit()};
      if (holds_clearly(volume, std::visit(at, shape))) return true;
    }
    return false;
  }

  void decide_again(std::uint32_t cell, std::uint32_t light, const PairSet& truth) {
    const geom::LightVolume volume = lights_.volume(light);
    const Verdict verdict = counted(geom::prove_meets(volume, grid_.cell(cell)), cell, light);
    const bool is_true = truth.has(cell, light);
    if (verdict != Verdict::uncertain && (verdict == Verdict::yes) != is_true)
      add(FaultKind::truth, "",
          pair_text(cell, light) + ": the true lists say " + (is_true ? "yes" : "no") + ", its own decision says " +
              (is_true ? "no" : "yes"),
          cell, light);
    if (verdict == Verdict::no && shares_a_point(volume, cell))
      add(FaultKind::truth, "", pair_text(cell, light) + ": decided as no, but a point lies in both", cell, light);
  }

  Verdict counted(Verdict verdict, std::uint32_t cell, std::uint32_t light) {
    ++report_.counts.decisions;
    if (verdict != Verdict::uncertain) return verdict;
    ++report_.counts.undecided;
    add(FaultKind::undecided, "", pair_text(cell, light) + " is neither proven nor refuted", cell, light);
    return verdict;
  }

  void check_methods() {
    const PairSet truth(truth_.lists, frame_.lights.size());
    for (const Answer& answer : answers_) {
      check_pairs(answer, truth);
      check_simd_variant(answer);
    }
  }

  // A pair that differs between method and truth is decided once more, so that an error of the truth is not reported as
  // one of the method.
  void check_pairs(const Answer& answer, const PairSet& truth) {
    const PairSet listed(answer.lists, frame_.lights.size());
    int checked = 0;
    for (std::uint32_t light = 0; light < frame_.lights.size(); ++light)
      for (std::uint32_t cell = 0; cell < grid_.cell_count(); ++cell) {
        const bool is_true = truth.has(cell, light), is_listed = listed.has(cell, light);
        if (is_true == is_listed || (is_listed && !answer.method->assigner->exact)) continue;
        constexpr int k_most = 12;
        if (++checked > k_most) return;
        const geom::LightVolume volume = lights_.volume(light);
        const Verdict verdict = counted(geom::decide_meets(volume, grid_.cell(cell)), cell, light);
        if (is_true && verdict == Verdict::yes)
          add(FaultKind::loss, answer.method->label, pair_text(cell, light) + " is true and not listed", cell, light);
        if (is_listed && verdict == Verdict::no)
          add(FaultKind::extra, answer.method->label, pair_text(cell, light) + " is listed and not true", cell, light);
      }
  }

  void check_simd_variant(const Answer& answer) {
    const std::string reference = reference_of(answer.method->label);
    for (const Answer& other : answers_) {
      if (reference.empty() || other.method->label != reference || other.lists == answer.lists) continue;
      const PairSet mine(answer.lists, frame_.lights.size()), its(other.lists, frame_.lights.size());
      for (std::uint32_t cell = 0; cell < grid_.cell_count(); ++cell)
        for (std::uint32_t light = 0; light < frame_.lights.size(); ++light)
          if (mine.has(cell, light) != its.has(cell, light))
            return add(FaultKind::simd_variant, answer.method->label,
                       pair_text(cell, light) + " is listed by " +
                           (mine.has(cell, light) ? answer.method->label : reference) + " only",
                       cell, light);
    }
  }

  // Samples in the view and in its lights, looked up as in a shader.
  void check_shading() {
    const std::vector<grid::Sample> samples = samples_to_shade();
    for (const grid::Sample& sample : samples) {
      const std::int64_t cell = grid::lookup(grid_, sample);
      const double margin = lost_by_lookup(sample);
      if (cell < 0) {
        check_left_out(sample, margin);
        continue;
      }
      for (std::uint32_t light = 0; light < frame_.lights.size(); ++light) {
        if (lights_.is_empty(light) || !clearly_reaches(frame_.lights[light], sample, margin)) continue;
        ++report_.counts.shaded;
        check_shaded_cell(static_cast<std::uint32_t>(cell), light);
      }
    }
  }

  void check_shaded_cell(std::uint32_t cell, std::uint32_t light) {
    for (const Answer& answer : answers_) {
      const auto list = answer.lists.of(cell);
      if (!std::binary_search(list.begin(), list.end(), light))
        add(FaultKind::shading, answer.method->label,
            pair_text(cell, light) + " is not listed, but the light reaches a point that is looked up there", cell,
            light);
    }
  }

  // A grid that follows lights must not end before a light that reaches a sample, unless the same grid without
  // following does, too.
  void check_left_out(const grid::Sample& sample, double margin) {
    const bool has_fit = trial_.grid.has_tiles() && trial_.grid.slices.fit;
    const bool is_around_lights = trial_.grid.kind == grid::Kind::world && trial_.grid.follow == grid::Follow::lights;
    if (!has_fit && !is_around_lights) return;
    if (!unfitted_) unfitted_ = unfitted_grid();
    if (!*unfitted_ || grid::lookup(**unfitted_, sample) < 0) return;
    for (std::uint32_t light = 0; light < frame_.lights.size(); ++light) {
      if (lights_.is_empty(light) || !clearly_reaches(frame_.lights[light], sample, margin)) continue;
      add(FaultKind::shading, "",
          "the grid follows the lights and ends before a sample that light " + std::to_string(light) + " reaches", 0,
          light);
    }
  }

  // nullopt if there is no such grid: around all lights its cells can be too thin, while those in view leave enough
  // room.
  std::optional<grid::Grid> unfitted_grid() const {
    Trial plain = trial_;
    plain.grid = trial_.grid.unfitted();
    plain.grid.follow = grid::Follow::nothing;
    try {
      return grid_of(plain, frame_);
    } catch (const Error&) {
      return std::nullopt;
    }
  }

  std::vector<grid::Sample> samples_to_shade() const {
    constexpr int k_in_view = 32, k_per_light = 3;
    const view::Projection& projection = frame_.projection;
    const double far = std::isfinite(projection.far_m) ? projection.far_m : 1e4 * std::max(projection.near_m, 1e-15);
    std::vector<grid::Sample> samples = measure::volume_samples(frame_, far, k_in_view, 1);
    SplitMix64 random(1);
    for (const scene::WorldLight& light : frame_.lights) {
      const Vec3d apex = frame_.view_space.rotation * (light.position - frame_.view_space.origin);
      for (int i = 0; i < k_per_light; ++i) {
        const double reach = std::min(light.range_m, far), x = random.between(-1.0, 1.0), y = random.between(-1.0, 1.0);
        const Vec3d point = apex + 0.7 * reach * Vec3d(x, y, random.between(-1.0, 1.0));
        const double depth = -point.z, scale = projection.orthographic ? 1.0 : depth;
        const double pixel_x =
            (point.x / scale - projection.left) / (projection.right - projection.left) * frame_.viewport.x;
        const double pixel_y =
            (projection.top - point.y / scale) / (projection.top - projection.bottom) * frame_.viewport.y;
        const bool is_in_picture = depth > projection.near_m && depth < projection.far_m && pixel_x >= 0.0 &&
                                   pixel_y >= 0.0 && pixel_x < frame_.viewport.x && pixel_y < frame_.viewport.y;
        if (is_in_picture) samples.push_back(measure::sample_at(frame_, pixel_x, pixel_y, depth));
      }
    }
    return samples;
  }

  // Upper bound of the single-precision error between a point and its cell: relative to the point, and to the whole
  // picture or all boundaries with which it is compared.
  double lost_by_lookup(const grid::Sample& sample) const {
    const view::Projection& projection = frame_.projection;
    double size = glm::length(sample.from_eye);
    if (grid_.kind() == grid::Kind::world) {
      const grid::WorldGrid& world = grid_.world();
      size += largest_of(world.x) + largest_of(world.y) + largest_of(world.z);
    } else if (grid_.kind() == grid::Kind::cascades) {
      const grid::CascadesGrid& cascades = grid_.cascades();
      size += double{cascades.edge_m(cascades.levels - 1)} * glm::length(Vec3d(cascades.cells));
    } else {
      const double scale = projection.orthographic ? 1.0 : -double{sample.view.z};
      size += scale * (std::abs(projection.left) + std::abs(projection.right) + std::abs(projection.bottom) +
                       std::abs(projection.top));
    }
    return 0x1p-18 * size;
  }

  void add_error(const StressMethod& method, const std::exception& error) {
    const std::size_t before = report_.faults.size();
    add(FaultKind::error, method.label, error.what(), 0, 0);
    if (report_.faults.size() > before)
      report_.faults.back().is_of_device = dynamic_cast<const gpu::DeviceError*>(&error) != nullptr;
  }

  void add(FaultKind kind, const std::string& method, const std::string& detail, std::uint32_t cell,
           std::uint32_t light) {
    constexpr scene::LightType k_types[] = {scene::LightType::point, scene::LightType::spot, scene::LightType::box};
    const bool has_light = lights_.size() > 0 && kind != FaultKind::error;
    const scene::LightType type = has_light ? k_types[lights_.type_of(light)] : scene::LightType::point;
    for (const SettingFault& fault : report_.faults)
      if (fault.kind == kind && fault.method == method && fault.type == type) return;
    report_.faults.push_back({kind, method, detail, cell, light, type});
  }

  const Trial& trial_;
  std::span<const StressMethod> methods_;
  view::Frame frame_;
  grid::Grid grid_;
  // set on first use: the grid that does not follow lights, if any
  std::optional<std::optional<grid::Grid>> unfitted_;
  view::LightArrays lights_;
  measure::Truth truth_;
  std::vector<Answer> answers_;
  SettingReport report_;
};

}  // namespace

const char* fault_kind_name(FaultKind kind) {
  constexpr const char* k_names[k_fault_kinds] = {"truth", "loss",  "extra",     "simd-variant",
                                                  "lists", "error", "undecided", "shading"};
  return k_names[static_cast<int>(kind)];
}

void SettingCounts::add(const SettingCounts& other) {
  settings += other.settings;
  refused += other.refused;
  for (std::size_t i = 0; i < by_kind.size(); ++i) by_kind[i] += other.by_kind[i];
  points += other.points;
  spots += other.spots;
  boxes += other.boxes;
  pairs += other.pairs;
  true_pairs += other.true_pairs;
  compared_pairs += other.compared_pairs;
  decisions += other.decisions;
  sampled += other.sampled;
  undecided += other.undecided;
  shaded += other.shaded;
}

// The label of a fast method is that of its reference with "-fast" after the name.
std::string reference_of(const std::string& label) {
  const std::string ending = "-fast";
  const std::size_t at = label.find(ending);
  return at == std::string::npos ? "" : label.substr(0, at) + label.substr(at + ending.size());
}

bool fits(const StressMethod& method, const grid::Grid& grid) {
  return !method.assigner->unfit || method.assigner->unfit(grid).empty();
}

bool supports_trial(const StressMethod& method, const Trial& trial) {
  return method.assigner->takes(trial.grid.kind) && (method.assigner->boxes || !has_boxes(trial)) &&
         (method.assigner->orthographic || !trial.scene.cameras[0].projection.orthographic);
}

SettingReport check_setting(const Trial& trial, std::span<const StressMethod> methods) {
  return SettingCheck(trial, methods).run();
}

}  // namespace clusterbench::stress
