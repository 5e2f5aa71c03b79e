#include "search/worst_case.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <set>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "gpu/device/device.h"
#include "measure/lists/lights_in_view_counts.h"
#include "search/best_frames.h"
#include "search/frame_rater.h"
#include "search/frames_in_turn.h"
#include "search/optimizer.h"
#include "search/search_progress.h"
#include "search/worst_case_request.h"

namespace clusterbench::search {
namespace {

constexpr int k_parts_of_path = 16, k_most_raters = 16;
// The same for any number of threads.
constexpr int k_global_searches = 4, k_local_searches = 4;

Box box_of(const LightRig& rig, const scene::CameraPath& path) {
  Box box{path.shots.front().pose.eye, path.shots.front().pose.eye};
  for (const scene::Shot& shot : path.shots) box.add(shot.pose.eye);
  for (std::size_t moment = 0; moment < rig.moments(); ++moment)
    for (std::size_t light = 0; light < rig.own_lights(); ++light)
      if (rig.reaches_something(moment, light)) box.add(rig.position(moment, light));
  return box;
}

class WorstCaseSearch {
 public:
  WorstCaseSearch(const config::Config& config, const run::Plan& plan, const run::CasePlan& case_plan,
                  const WorstCaseRequest& request, const WorstCaseListener& listener, const std::atomic<bool>& stop)
      : config_(config),
        plan_(plan),
        case_(case_plan),
        request_(request),
        path_(plan.scenes[case_plan.scene].paths[case_plan.camera]),
        rig_(plan.scenes[case_plan.scene].scene, path_, request.extra_ranges_m, request.move_m > 0.0),
        scene_box_(box_of(rig_, path_)),
        floor_(floor_of(plan.scenes[case_plan.scene].scene)),
        space_(eye_box(), scene_box_, rig_.moments(), request.extra_ranges_m.size(), floor_ ? &*floor_ : nullptr,
               request.eye_height_m, rotations_kept()),
        clock_(request.seconds, stop),
        stop_(stop),
        progress_(listener, frames_to_rate()),
        best_(kept(), near_m()),
        random_(request.random, [this](int i) { return random_frame(i, 1); }) {}

  double estimated_s() {
    constexpr int k_most_frames = 256;  // their costs differ
    constexpr double k_most_s = 0.25;
    FrameRater meter = rater();
    meter.rate(random_frame(0, 0).choice);  // also makes the shared data
    const SearchClock::time_point start = SearchClock::now();
    double passed_s = 0.0;
    int rated = 0;
    for (; rated < k_most_frames && passed_s < k_most_s; ++rated) {
      meter.rate(random_frame(rated, 0).choice);
      passed_s = std::chrono::duration<double>(SearchClock::now() - start).count();
    }
    const double recorded_s = passed_s / rated * static_cast<double>(path_.shots.size());
    const double others_s = passed_s / rated * (request_.evaluations + request_.random) / std::max(1, request_.threads);
    return recorded_s + (request_.seconds > 0.0 ? std::min(request_.seconds, others_s) : others_s);
  }

  WorstCase result() {
    measure_recorded();
    const bool moves = request_.move_m > 0.0 && rig_.own_lights() > 0;
    const int left_for_search = moves ? request_.evaluations - request_.evaluations / 3 : request_.evaluations;
    rate_recorded(std::max(1, left_for_search / 10));
    rate_sampled(left_for_search / 4);
    search_globally((left_for_search - used_) * 3 / 5);
    search_locally(left_for_search - used_);
    if (moves) move_lights(request_.evaluations - used_);
    out_.ended = clock_.ended();
    out_.evaluations = used_;
    out_.eyes = space_.eyes();
    out_.lights = scene_box_;
    out_.own_lights = rig_.own_lights();
    out_.moments = rig_.moments();
    out_.directions = rotations_kept().size();
    if (floor_) {
      out_.floor_triangles = floor_->triangles();
      out_.floor_area_m2 = floor_->area_m2();
    }
    if (best_.frames().empty() && clock_.has_failed()) throw gpu::DeviceError(clock_.failure());
    if (best_.frames().empty()) return std::move(out_);
    const double searched = best_.frames().front().value;
    compare_with_random();
    tell_path();
    warn_of_better(searched);
    out_.ended = clock_.ended();
    out_.device_failure = clock_.failure();
    return std::move(out_);
  }

 private:
  const scene::CameraProjection& projection() const { return path_.shots.front().projection; }
  FrameRater rater() const { return {config_, case_, request_.measure, rig_, projection()}; }
  // Each has a method of its own, with its memory.
  std::size_t threads() const { return static_cast<std::size_t>(std::clamp(request_.threads, 1, k_most_raters)); }
  int frames_to_rate() const { return static_cast<int>(path_.shots.size()) + request_.evaluations + request_.random; }

  std::optional<Walkable> floor_of(const scene::Scene& scene) const {
    if (!request_.walkable) return std::nullopt;
    if (scene.path.empty()) throw Error("", "--walkable", "a rig that was made has no triangles");
    const run::SceneData& data = plan_.scenes[case_.scene];
    std::optional<Box> within = request_.within;
    if (within) {
      within->lo.y -= request_.eye_height_m;
      within->hi.y -= request_.eye_height_m;
    }
    return Walkable(scene, data.geometry ? *data.geometry : scene::load_geometry(scene), within);
  }
  Box eye_box() const {
    if (floor_ && !request_.within) {
      const Vec3d height{0.0, request_.eye_height_m, 0.0};
      return {floor_->lo() + height, floor_->hi() + height};
    }
    Box box = request_.within ? *request_.within : scene_box_;
    if (!request_.keep_height) return box;
    const auto [lowest, highest] =
        std::ranges::minmax(path_.shots, {}, [](const scene::Shot& shot) { return shot.pose.eye.y; });
    box.lo.y = lowest.pose.eye.y;
    box.hi.y = highest.pose.eye.y;
    return box;
  }
  // The distinct rotations of the recorded path, in its order; empty if the camera may look anywhere.
  std::vector<Vec4d> rotations_kept() const {
    std::vector<Vec4d> kept;
    if (!request_.keep_direction) return kept;
    std::set<std::array<double, 4>> seen;
    for (const scene::Shot& shot : path_.shots) {
      const Vec4d rotation = rotation_of(shot.pose);
      if (seen.insert({rotation.x, rotation.y, rotation.z, rotation.w}).second) kept.push_back(rotation);
    }
    return kept;
  }
  double near_m() const {
    const Vec3d size = space_.eyes().hi - space_.eyes().lo;
    return 0.05 * std::sqrt(glm::dot(size, size));
  }

  // All frames of the path, or as many as fit into a quarter of the time limit: the rest is for other frames.
  int affordable_frames(const run::PathFrames& recorded) const {
    if (request_.seconds == 0.0) return recorded.count();
    constexpr double k_share = 0.25;
    const SearchClock::time_point start = SearchClock::now();
    values_along(config_, case_, request_.measure, recorded.only({0}), [] {});
    const double one_s = std::chrono::duration<double>(SearchClock::now() - start).count();
    return static_cast<int>(std::clamp(k_share * request_.seconds / one_s, 1.0, static_cast<double>(recorded.count())));
  }

  void measure_recorded() {
    const Vec2i viewport = config_.viewports[case_.viewport];
    const run::PathFrames recorded(plan_.scenes[case_.scene].scene, path_, viewport);
    progress_.begin("the recorded path");
    const std::vector<int> frames = run::evenly_spaced(affordable_frames(recorded), recorded.count());
    const std::vector<double> values = recorded_values(recorded, frames);
    const auto most = std::ranges::max_element(values);
    out_.recorded = {static_cast<int>(frames.size()), *most, frames[static_cast<std::size_t>(most - values.begin())]};
    const scene::CameraProjection& first = projection();
    const auto differs = [&](const scene::Shot& shot) {
      return view::make_projection(shot.projection, viewport) != view::make_projection(first, viewport);
    };
    if (std::ranges::any_of(path_.shots, differs))
      out_.warnings.emplace_back(
          "the camera's projection changes along its path; the search takes that of its first frame");
  }

  // Of these frames of the recorded path.
  std::vector<double> recorded_values(const run::PathFrames& recorded, const std::vector<int>& frames) {
    std::vector<double> values(frames.size());
    each_task(k_parts_of_path, [&](std::size_t part) {
      const auto begin = static_cast<std::ptrdiff_t>(part * frames.size() / k_parts_of_path),
                 end = static_cast<std::ptrdiff_t>((part + 1) * frames.size() / k_parts_of_path);
      if (begin == end || stop_) return;
      const run::PathFrames some = recorded.only({frames.begin() + begin, frames.begin() + end});
      std::ranges::copy(values_along(config_, case_, request_.measure, some, [this] { progress_.step(); }),
                        values.begin() + begin);
    });
    return values;
  }

  // A device that fails ends the search; what the tasks have found by then is kept. After a signal its work may have
  // been left behind, and has not failed.
  template <class Work>
  void each_task(std::size_t count, Work work) {
    ThreadPool(request_.threads).each(count, [&](std::size_t task) {
      try {
        work(task);
      } catch (const gpu::DeviceError& error) {
        if (!stop_) clock_.fail(error.message());
      } catch (...) {
        has_failed_ = true;
        throw;
      }
    });
  }

  // Rates this many frames; `frame_of(i)` gives each, `is_over()` ends it early. Returns the number of rated frames.
  template <class FrameOf, class IsOver>
  int rate_each(int count, BestFrames& best, FrameOf frame_of, IsOver is_over) {
    FramesInTurn frames(count, frame_of);
    rate_all(frames, is_over);
    frames.add_to(best);
    return frames.rated();
  }
  template <class IsOver>
  void rate_all(FramesInTurn& frames, IsOver is_over) {
    each_task(threads(), [&](std::size_t /*thread*/) {
      std::optional<FrameRater> meter;
      while (!has_failed_ && !is_over() && rate_next(frames, meter)) {
      }
    });
  }
  // False if no frame is left.
  bool rate_next(FramesInTurn& frames, std::optional<FrameRater>& meter) {
    const std::optional<int> frame = frames.next();
    if (!frame) return false;
    if (!meter) meter.emplace(rater());
    frames.rate(*frame, *meter);
    progress_.step();
    return true;
  }
  std::size_t kept() const {
    return std::max<std::size_t>(static_cast<std::size_t>(request_.frames), k_local_searches);
  }

  void end_stage(const char* name, int evaluations) {
    used_ += evaluations;
    if (evaluations > 0) out_.stages.push_back({name, evaluations, best_.frames().front().value});
  }

  // A recorded frame, or the nearest frame in the search space.
  RatedFrame recorded_frame(std::size_t frame) const {
    const scene::CameraPose& pose = path_.shots[frame].pose;
    const Vec4d rotation = rotation_of(pose);
    const std::size_t moment = rig_.moment_of(frame);
    RatedFrame out{0.0, space_.point_of(pose.eye, rotation, moment), {}};
    out.choice = space_.at(out.point);
    if (floor_ || !space_.eyes().holds(pose.eye)) return out;
    out.choice.eye = rounded_to_float(pose.eye);
    out.choice.rotation = rotation;
    return out;
  }

  void rate_recorded(int most) {
    progress_.begin("recorded frames");
    // The worst of all first, so that the search is never worse than it.
    std::vector<int> frames = run::evenly_spaced(most, static_cast<int>(path_.shots.size()));
    if (std::ranges::find(frames, out_.recorded.frame) == frames.end()) frames.front() = out_.recorded.frame;
    const auto frame_of = [&](int i) {
      return recorded_frame(static_cast<std::size_t>(frames[static_cast<std::size_t>(i)]));
    };
    end_stage("recorded",
              rate_each(static_cast<int>(frames.size()), best_, frame_of, [this] { return clock_.is_over(); }));
  }

  // The same number and seed give the same frame.
  RatedFrame random_frame(int number, std::uint64_t stream) const {
    SplitMix64 mixed(request_.seed * 2 + stream);
    SplitMix64 random(mixed.next() + static_cast<std::uint64_t>(number) * 0x9e3779b97f4a7c15u);
    SplitMix64 own(random.next());
    RatedFrame out{0.0, space_.random(own), {}};
    out.choice = space_.at(out.point);
    return out;
  }

  void rate_sampled(int count) {
    progress_.begin("random frames to start from");
    end_stage("sampled",
              rate_each(
                  count, best_, [this](int i) { return random_frame(i, 0); }, [this] { return clock_.is_over(); }));
  }

  // Searches that each rate frames one after the other. Threads that no search is left for rate frames to compare with
  // until the last search ends, unless they would take turns with it on a device.
  template <class Search>
  void each_search(std::size_t count, Search search) {
    std::atomic<std::size_t> next = 0, running = count;
    each_task(threads(), [&](std::size_t /*thread*/) {
      std::optional<FrameRater> meter;
      for (std::size_t i = next++; i < count; i = next++) {
        const AtEnd ended{running};
        if (!meter) meter.emplace(rater());
        search(i, *meter);
      }
      const bool helps = !run::method_of(config_, case_).on_device;
      while (helps && running > 0 && !has_failed_ && !stop_ && rate_next(random_, meter)) {
      }
    });
  }
  struct AtEnd {
    std::atomic<std::size_t>& running;
    explicit AtEnd(std::atomic<std::size_t>& counted) : running(counted) {}
    AtEnd(const AtEnd&) = delete;
    AtEnd& operator=(const AtEnd&) = delete;
    ~AtEnd() { --running; }
  };

  // Adds the searches' frames in the order of the searches.
  template <class Work>
  int run_searches(std::size_t count, Work work) {
    std::vector<BestFrames> found(count, BestFrames(kept(), near_m()));
    std::vector<int> used(count, 0);
    each_search(count, [&](std::size_t i, FrameRater& meter) {
      const Objective objective = [&](const std::vector<double>& point) {
        clock_.is_over();
        RatedFrame frame{0.0, point, space_.at(point)};
        frame.value = meter.rate(frame.choice);
        found[i].add(frame);
        ++used[i];
        progress_.step();
        return frame.value;
      };
      work(i, objective);
    });
    for (const BestFrames& frames : found) best_.add_all(frames);
    return std::accumulate(used.begin(), used.end(), 0);
  }

  void search_globally(int evaluations) {
    progress_.begin("global search");
    // A population is ten times as large as the number of dimensions; fewer than two populations are too few for a
    // search.
    const int least = 20 * (static_cast<int>(space_.dimensions()) + 1);
    const auto searches = static_cast<std::size_t>(std::min(evaluations / least, k_global_searches));
    if (searches == 0 || best_.frames().empty()) return;
    const std::vector<RatedFrame> starts = best_.frames();
    end_stage("global", run_searches(searches, [&](std::size_t task, const Objective& objective) {
                return maximise_globally(starts[task % starts.size()].point, share(evaluations, task, searches),
                                         request_.seed + task, objective, clock_.over());
              }));
  }

  static int share(int evaluations, std::size_t task, std::size_t tasks) {
    const auto all = static_cast<std::size_t>(evaluations);
    return static_cast<int>((task + 1) * all / tasks - task * all / tasks);
  }

  // Repeated with other step sizes while evaluations are left: the measures have plateaus.
  void search_locally(int evaluations) {
    progress_.begin("local search");
    const std::vector<RatedFrame> starts = best_.frames();
    if (starts.empty() || evaluations < 1) return;
    const std::size_t searches = std::min<std::size_t>(starts.size(), k_local_searches);
    end_stage("local", run_searches(searches, [&](std::size_t task, const Objective& objective) {
                return climb(starts[task], share(evaluations, task, searches), objective);
              }));
  }

  int climb(RatedFrame best, int evaluations, const Objective& objective) const {
    constexpr double k_steps[] = {0.05, 0.01, 0.2, 0.002};
    const Objective recording = [&](const std::vector<double>& point) {
      const double value = objective(point);
      if (value > best.value) {
        best.value = value;
        best.point = point;
      }
      return value;
    };
    int used = 0;
    for (std::size_t turn = 0; used < evaluations && !clock_.over(); ++turn) {
      const int now = maximise_locally(best.point, k_steps[turn % std::size(k_steps)], evaluations - used, recording,
                                       clock_.over());
      if (now == 0) break;
      used += now;
    }
    return used;
  }

  // Moves one light after another towards the eye, then anywhere in its ball; keeps moves that increase the measure.
  void move_lights(int evaluations) {
    progress_.begin("moving lights");
    std::vector<RatedFrame> frames = best_.frames();
    frames.resize(std::min(frames.size(), static_cast<std::size_t>(request_.frames)));
    if (frames.empty()) return;
    std::vector<int> used(frames.size(), 0);
    each_search(frames.size(), [&](std::size_t i, FrameRater& meter) {
      move_lights_of(frames[i], share(evaluations, i, frames.size()), request_.seed + i, meter, used[i]);
    });
    for (const RatedFrame& frame : frames) best_.add(frame);
    end_stage("moved lights", std::accumulate(used.begin(), used.end(), 0));
  }

  // `used`: receives the number of rated frames.
  void move_lights_of(RatedFrame& frame, int evaluations, std::uint64_t seed, FrameRater& meter, int& used) {
    SplitMix64 random(seed);
    for (std::size_t light = 0; light < rig_.own_lights(); ++light)
      frame.choice.moved.emplace_back(light, rig_.position(frame.choice.moment, light));
    const auto keep_if_better = [&](const FrameChoice& tried) {
      const double value = meter.rate(tried);
      ++used;
      progress_.step();
      if (value <= frame.value) return;
      frame.value = value;
      frame.choice = tried;
    };
    for (std::size_t turn = 0; used < evaluations && !clock_.is_over(); ++turn) {
      const std::size_t light = turn % rig_.own_lights();
      const Vec3d home = rig_.position(frame.choice.moment, light);
      Vec3d position = home + within(frame.choice.eye - home, request_.move_m);
      if (turn >= rig_.own_lights()) position = home + in_ball(random, request_.move_m);
      FrameChoice tried = frame.choice;
      tried.moved[light].second = rounded_to_float(position);
      keep_if_better(tried);
    }
    std::erase_if(frame.choice.moved,
                  [&](const auto& entry) { return entry.second == rig_.position(frame.choice.moment, entry.first); });
  }

  static Vec3d within(const Vec3d& way, double most_m) {
    const double length = std::sqrt(glm::dot(way, way));
    return length > most_m ? way * (most_m / length) : way;
  }
  static Vec3d in_ball(SplitMix64& random, double radius_m) {
    Vec3d point;
    do point = {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
    while (glm::dot(point, point) > 1.0);
    return point * radius_m;
  }

  // A device that fails here, or for good before, leaves the values as they were found.
  void tell_path() {
    if (clock_.has_failed()) gpu::close_device();  // of which no task has anything left
    try {
      make_path();
    } catch (const gpu::DeviceError& error) {
      if (!stop_) clock_.fail(error.message());
      out_.frames.clear();
      out_.buffers.clear();
      out_.theoretical_max.reset();
      for (std::size_t i = 0; i < told_frames(); ++i)
        out_.frames.push_back({best_.frames()[i].choice, best_.frames()[i].value});
    }
  }
  std::size_t told_frames() const { return std::min(best_.frames().size(), static_cast<std::size_t>(request_.frames)); }

  void make_path() {
    const std::size_t count = told_frames();
    out_.path_scene = rig_.scene(count, projection());
    for (std::size_t i = 0; i < count; ++i) rig_.set_frame(out_.path_scene, i, best_.frames()[i].choice);
    const scene::CameraPath path = path_of(out_.path_scene, config_.scenes[case_.scene].camera);
    const run::PathFrames frames(out_.path_scene, path, config_.viewports[case_.viewport]);
    count_dark_lights(frames.frame(0));
    const std::vector<double> values = values_along(config_, case_, request_.measure, frames);
    for (std::size_t i = 0; i < count; ++i) out_.frames.push_back({best_.frames()[i].choice, values[i]});
    FrameRater meter = rater();
    meter.rate(out_.frames.front().choice);
    out_.theoretical_max = meter.theoretical_max();
    // it has lists, whatever the searched measure
    FrameRater lists(config_, case_, Measure::entries, rig_, projection());
    lists.rate(out_.frames.front().choice);
    out_.buffers = lists.buffers();
  }

  // The search goes to lights, lit or dark.
  void count_dark_lights(const view::Frame& worst) {
    measure::LightsInView counts;
    measure::add_frame(counts, worst);
    out_.lights_in_view = counts.most;
    out_.dark_in_view = counts.most - counts.seen();
    if (out_.dark_in_view > 0)
      out_.warnings.push_back("of " + number_of(out_.lights_in_view, "light") + " in view in the worst frame " +
                              (out_.dark_in_view == out_.lights_in_view ? "all" : std::to_string(out_.dark_in_view)) +
                              " are dark (intensity 0 or black)");
  }

  // Frames here that are worse than the search's result become the result.
  void compare_with_random() {
    progress_.begin("random frames to compare with");
    rate_all(random_, [this] { return stop_.load() || clock_.has_failed(); });
    out_.random.frames = random_.rated();
    if (out_.random.frames == 0) return;
    BestFrames found(kept(), near_m());
    random_.add_to(found);
    out_.random.max = found.frames().front().value;
    out_.random.mean = random_.sum() / out_.random.frames;
    best_.add_all(found);
  }

  void warn_of_better(double searched) {
    const double worst = out_.frames.front().value;
    const bool is_most = out_.theoretical_max && worst >= *out_.theoretical_max;  // the maximum is reached
    if (out_.random.frames > 0 && out_.random.max > searched)
      out_.warnings.emplace_back(
          "a random frame is worse than what the search found, and is taken in its place: allow more --evaluations");
    else if (out_.random.frames > 0 && out_.random.max == searched && !is_most)
      out_.warnings.emplace_back("a random frame is as bad as what the search found");
    if (out_.recorded.max > worst)
      out_.warnings.emplace_back(
          "a recorded frame is worse than what the search found: it may not choose that frame, or needs more "
          "--evaluations");
  }

  const config::Config& config_;
  const run::Plan& plan_;
  const run::CasePlan& case_;
  const WorstCaseRequest& request_;
  const scene::CameraPath& path_;
  LightRig rig_;
  Box scene_box_;
  std::optional<Walkable> floor_;
  SearchSpace space_;
  Clockwork clock_;
  const std::atomic<bool>& stop_;
  SearchProgress progress_;
  BestFrames best_;
  FramesInTurn random_;                   // to compare with
  std::atomic<bool> has_failed_ = false;  // for good, and not the device alone
  WorstCase out_;
  int used_ = 0;
};

}  // namespace

WorstCase find_worst_case(const config::Config& config, const run::Plan& plan, const run::CasePlan& case_plan,
                          const WorstCaseRequest& request, const WorstCaseListener& listener,
                          const std::atomic<bool>& stop) {
  check_request(plan.scenes[case_plan.scene], request);
  try {
    return WorstCaseSearch(config, plan, case_plan, request, listener, stop).result();
  } catch (const gpu::DeviceError&) {
    gpu::close_device();
    throw;
  }
}

double estimated_search_s(const config::Config& config, const run::Plan& plan, const run::CasePlan& case_plan,
                          const WorstCaseRequest& request) {
  check_request(plan.scenes[case_plan.scene], request);
  const std::atomic<bool> stop{false};
  const WorstCaseListener no_listener;
  return WorstCaseSearch(config, plan, case_plan, request, no_listener, stop).estimated_s();
}

}  // namespace clusterbench::search
